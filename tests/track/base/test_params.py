# SPDX-License-Identifier: MIT
import math
import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
import tricue
from hypothesis import given
from hypothesis import strategies as st
from tricue.track.base.params import Params, parameter
from tricue.track.color_particle.params import ColorParticleParams


@dataclass(frozen=True, slots=True, kw_only=True)
class Example(Params):
    particles: int = parameter(100, unit="particles", source="section V", doc="how many", low=1, high=10_000)
    rate: float = parameter(0.1, unit="1/frame", source="experiment", low=0, below=1)
    noise: float = parameter(4.0, unit="px", source="equation (30)", above=0)
    limit: float | None = parameter(None, unit="px", source="section III", above=0)
    gated: bool = parameter(True, unit="", source="section III")
    model: str = parameter("spatial", unit="", source="section III", choices=("spatial", "sections"))
    form: Literal["linear", "exponential"] = parameter("exponential", unit="", source="equation (18)")
    label: str = parameter("", unit="", source="")
    grid: tuple[int, int] = parameter((16, 20), unit="samples", source="experiment", low=2)
    scales: tuple[float, ...] = parameter((0.9, 1.0), unit="", source="experiment", above=0)


examples = st.builds(
    Example,
    particles=st.integers(1, 10_000),
    rate=st.floats(0, 1, exclude_max=True),
    noise=st.floats(0, exclude_min=True, allow_nan=False, allow_infinity=False),
    limit=st.none() | st.floats(0, exclude_min=True, allow_infinity=False),
    gated=st.booleans(),
    model=st.sampled_from(("spatial", "sections")),
    form=st.sampled_from(("linear", "exponential")),
    label=st.text(st.characters(exclude_categories=["Cs"])),
    grid=st.tuples(*2 * [st.integers(2, 2**40)]),
    scales=st.lists(st.floats(1e-300, 1e300)).map(tuple),
)


@given(examples)
def test_toml_brings_everything_back(tmp_path_factory: pytest.TempPathFactory, params: Example) -> None:
    """It proves that any parameters, odd strings and extreme numbers too, survive a file to the bit."""
    path = tmp_path_factory.getbasetemp() / "params.toml"
    params.to_toml(path)
    assert Example.from_toml(path) == params


def test_toml_explains_each_value(tmp_path: Path) -> None:
    """It proves that the file that a user reads names the unit and the source of every value."""
    Example(particles=7).to_toml(tmp_path / "p.toml")
    lines = (tmp_path / "p.toml").read_text().splitlines()
    assert lines[0] == "particles = 7  # particles; section V"
    assert len(lines) == 9  # limit, None, is left out


def test_a_partial_file_keeps_the_defaults(tmp_path: Path) -> None:
    """It proves that a file may hold a few values only, and ints where floats are expected."""
    (tmp_path / "p.toml").write_text("particles = 7\nnoise = 3\n")
    assert Example.from_toml(tmp_path / "p.toml") == Example(particles=7, noise=3.0)


def test_numbers_are_kept_in_their_own_type() -> None:
    """It proves that ints become floats where floats are expected, and NumPy scalars plain Python numbers."""
    values: dict[str, Any] = {"particles": np.int64(5), "rate": np.float32(0.5), "grid": [4, 5]}
    params = Example(noise=3, scales=(1, 2), **values)
    assert [type(value) for value in (params.noise, params.particles, params.rate)] == [float, int, float]
    assert params.grid == (4, 5)
    assert params.scales == (1.0, 2.0)
    assert all(type(scale) is float for scale in params.scales)


def test_params_are_frozen_values() -> None:
    """It proves that parameters can't be changed, compare by value, hash and pickle."""
    params = Example(particles=7)
    with pytest.raises(FrozenInstanceError):
        params.particles = 8  # type: ignore[misc]
    assert pickle.loads(pickle.dumps(params)) == params
    assert len({params, Example(particles=7), Example()}) == 2


def test_describe_lists_every_parameter() -> None:
    """It proves that the table shows name, default, unit and source of each parameter, a line each."""
    lines = Example.describe().splitlines()
    assert lines[0].split() == ["name", "default", "unit", "source", "meaning"]
    assert [line.split()[0] for line in lines[1:]] == list(Example.__dataclass_fields__)
    assert lines[1].split() == ["particles", "100", "particles", "section", "V", "how", "many"]


BAD = [
    ({"particles": 0}, ValueError, "particles: expected at least 1 and at most 10000, got 0"),
    ({"particles": 10_001}, ValueError, "particles: expected at least 1 and at most 10000"),
    ({"particles": 3.0}, TypeError, "particles: expected an integer, got 3.0"),
    ({"particles": True}, TypeError, "particles: expected an integer, got True"),
    ({"particles": "7"}, TypeError, "particles: expected an integer, got '7'"),
    ({"particles": None}, TypeError, "particles: expected an integer, got None"),
    ({"rate": 1.0}, ValueError, "rate: expected at least 0 and below 1, got 1.0"),
    ({"rate": -0.1}, ValueError, "rate: expected at least 0 and below 1"),
    ({"rate": math.nan}, ValueError, "rate: expected a finite number, got nan"),
    ({"noise": 0}, ValueError, "noise: expected above 0, got 0.0"),
    ({"noise": False}, TypeError, "noise: expected a number, got False"),
    ({"limit": 0.0}, ValueError, "limit: expected above 0"),
    ({"limit": "far"}, TypeError, "limit: expected a number, got 'far'"),
    ({"gated": 1}, TypeError, "gated: expected True or False, got 1"),
    ({"model": "spacial"}, ValueError, "model: expected one of 'spatial', 'sections', got 'spacial'"),
    ({"model": 3}, TypeError, "model: expected a string, got 3"),
    ({"form": "cubic"}, ValueError, "form: expected one of 'linear', 'exponential', got 'cubic'"),
    ({"grid": 4}, TypeError, "grid: expected a tuple, got 4"),
    ({"grid": (4, 5, 6)}, ValueError, "grid: expected 2 values, got 3"),
    ({"grid": (4, 1)}, ValueError, "grid: expected at least 2, got 1"),
    ({"scales": (1.0, math.nan)}, ValueError, "scales: expected a finite number, got nan"),
    ({"scales": ("a",)}, TypeError, "scales: expected a number, got 'a'"),
    ({"partciles": 3}, TypeError, "partciles: unknown parameter of Example; did you mean particles?"),
    ({"zzz": 3}, TypeError, "zzz: unknown parameter of Example; expected one of particles, rate,"),
]


@pytest.mark.parametrize(("values", "error", "message"), BAD)
def test_bad_values_are_refused(values: dict[str, Any], error: type[Exception], message: str) -> None:
    """It proves that each bad value is an error that names the parameter, what was expected and what came."""
    with pytest.raises(error, match=f"^{message}"):
        Example(**values)


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("partciles = 3", TypeError, "partciles: unknown parameter of Example; did you mean particles?"),
        ("particles = 0", ValueError, "particles: expected at least 1"),
        ("particles = = 0", ValueError, "expected a TOML file"),
        ("[particles]\na = 1", TypeError, "particles: expected an integer, got {'a': 1}"),
        ("rate = nan", ValueError, "rate: expected a finite number, got nan"),
    ],
)
def test_bad_files_are_refused(tmp_path: Path, text: str, error: type[Exception], message: str) -> None:
    """It proves that an error in a parameter file names the file and the parameter."""
    (tmp_path / "p.toml").write_text(text)
    with pytest.raises(error, match=rf"^\S+p\.toml: {message}"):
        Example.from_toml(tmp_path / "p.toml")


@dataclass(frozen=True, slots=True, kw_only=True)
class RenamedParams(Params):
    max_step: float = parameter(40.0, unit="pixels", source="made up", low=0, was="reach")


def test_former_names_are_deprecated(tmp_path: Path) -> None:
    """A parameter is taken, read and loaded by its former name too, with a warning that tells the new one."""
    with pytest.warns(DeprecationWarning, match="^reach: deprecated, the parameter is max_step now"):
        params = RenamedParams(reach=3)
    assert params == RenamedParams(max_step=3.0)
    with pytest.warns(DeprecationWarning, match="^reach: deprecated"):
        assert params.reach == 3
    (tmp_path / "p.toml").write_text("reach = 7.0\n")
    with pytest.warns(DeprecationWarning, match="^reach: deprecated"):
        assert RenamedParams.from_toml(tmp_path / "p.toml").max_step == 7
    with pytest.raises(TypeError, match=r"^reach: expected once, got also max_step"):
        RenamedParams(reach=1, max_step=2)
    with pytest.raises(AttributeError, match="no attribute 'range'"):
        _ = params.range
    assert pickle.loads(pickle.dumps(params, 0)) == params


@pytest.mark.parametrize(
    "make",
    [
        lambda: ColorParticleParams(surprise=0.5),
        lambda: tricue.ColorParticleTracker(surprise=0.5),
        lambda: tricue.create("color-particle", surprise=0.5),
        lambda: tricue.create("color-particle", lost_after=3),
        lambda: RenamedParams(reach=3),
        lambda: RenamedParams().reach,
    ],
)
def test_deprecations_point_at_the_users_line(make: Callable[[], object]) -> None:
    """A warning names the file and line of the call, however many functions of the package are between."""
    with pytest.warns(DeprecationWarning, match="deprecated") as caught:
        make()
    assert [(each.filename, each.lineno) for each in caught] == [(__file__, make.__code__.co_firstlineno)]


@pytest.mark.parametrize("name", ["color-particle", "fused"])
@pytest.mark.parametrize("rate", [0, -1, float("nan"), "fast"])
def test_frames_of_a_wrong_rate_are_no_seconds(name: str, rate: Any) -> None:
    """The parameter that is wrong is named, though another one is converted by it."""
    with pytest.raises((TypeError, ValueError), match="rate: expected"):
        tricue.create(name, lost_after=5, rate=rate)
