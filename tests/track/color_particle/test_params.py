# SPDX-License-Identifier: MIT
"""The parameters of the color particle tracker: what is refused, and that they come back from a file."""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tricue
from tricue import ColorParticleTracker, FusedTracker

Params = ColorParticleTracker.Params
FIELDS = {field.name: field for field in dataclasses.fields(Params)}

REFUSED: dict[str, tuple[Any, ...]] = {
    "particles": (1, 0, -5, 100_001),
    "observation": ("ranks", "", "RANK-SPATIAL"),
    "likelihood": ("square", ""),
    "sharpness": (0, -1.0),
    "grid": ((1, 12), (12, 65), (12,), (12, 12, 12)),
    "grid_reach": (0, -1, 4.1),
    "color_weight": (-0.1,),
    "ring": ((0.9, 1.8), (1.3, 8.1), (1.3,)),
    "ring_samples": (0,),
    "skin_threshold": (-1.1, 1.1),
    "skin_share": (-0.1, 1.0),
    "max_step": (-1,),
    "max_step_sizes": (-0.1,),
    "velocity_rate": (-0.1, 1.1),
    "position_noise": (-0.1,),
    "velocity_noise": (-0.1,),
    "size_noise": (-0.1,),
    "aspect_noise": (-0.1,),
    "size_pull": (-0.1, 1.1),
    "size_rate": (-0.1, 1.1),
    "size_range": ((0, 4), (-1, 4), (0.3,)),
    "resample_below": (-0.1, 1.1),
    "likelihood_drop": (-0.1,),
    "wide_search_spread": (0, -0.1),
    "learning_rate": (-0.1, 1.1),
    "color_rate": (-0.1, 1.1),
    "first_frame_weight": (-0.1, 1.1),
    "min_score_to_learn": (-0.1, 1.1),
    "min_score": (-0.1, 1.1),
    "lost_after": (-0.1,),
    "min_score_to_redetect": (-0.1, 1.1),
    "rate": (0, -1),
}


def test_every_field_has_its_bad_values():
    """The table above names every field there is: a new one must be tried too."""
    assert set(REFUSED) == set(FIELDS)


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in REFUSED.items() for value in values]
)
def test_values_out_of_range_are_named(name, value):
    """A value out of range is a ValueError that begins with the field's name and shows the value."""
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        ColorParticleTracker(**{name: value})


@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize("value", [..., "many", float("nan"), True, b"1", [None, None]], ids=repr)
def test_values_of_another_kind_are_named(name, value):
    """Whatever isn't a value of the field's type, NaN included, is an error that begins with its name."""
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        ColorParticleTracker(**{name: value})


@pytest.mark.parametrize(
    "name", [n for n, f in FIELDS.items() if isinstance(f.default, float) or n == "sharpness"]
)
def test_numbers_are_finite(name):
    """An infinite number is a ValueError that begins with the field's name, whatever its range."""
    for value in (float("inf"), -float("inf")):
        with pytest.raises(ValueError, match=f"^{name}: expected"):
            ColorParticleTracker(**{name: value})


@pytest.mark.parametrize(("name", "pair"), [("ring", (1.8, 1.3)), ("size_range", (4.0, 0.3))])
def test_pairs_out_of_order_are_named(name, pair):
    """An outer radius under the inner, or a largest size under the smallest, is refused by name."""
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        ColorParticleTracker(**{name: pair})


def test_unknown_names_are_errors():
    """A misspelt parameter is a TypeError that proposes the right one."""
    with pytest.raises(TypeError, match=r"^particle: unknown parameter of .*did you mean particles"):
        ColorParticleTracker(particle=50)


def test_params_and_keywords_are_the_same(run):
    """Parameters by params=, by keywords and through create() give one track; both ways at once are an
    error.
    """
    assert run(params=Params(particles=50)) == run(particles=50)
    tracker = tricue.create("color-particle", seed=3, particles=50)
    assert isinstance(tracker, ColorParticleTracker)
    assert (tracker.seed, tracker.params) == (3, Params(particles=50))
    with pytest.raises(TypeError, match=r"^params: expected alone, got also particles"):
        ColorParticleTracker(params=Params(), particles=50)
    with pytest.raises(TypeError, match=r"^params: expected ColorParticleParams, got dict"):
        ColorParticleTracker(params={})


@pytest.mark.parametrize(
    ("seed", "error"), [(-1, ValueError), (None, TypeError), ("a", TypeError), (0.5, TypeError)]
)
def test_seeds_are_whole_numbers(seed, error):
    """A seed that is no whole number from 0 up is named: None, which would mean chance, too."""
    with pytest.raises(error, match=r"^seed: expected"):
        ColorParticleTracker(seed=seed)
    assert ColorParticleTracker(seed=np.int64(5)).seed == 5


@pytest.mark.parametrize("name", ["", "cuda", None, []])
def test_kernels_are_native_or_reference(name):
    """Another set of kernels is a ValueError that names both."""
    with pytest.raises(ValueError, match=r"^kernels: expected 'native' or 'reference'"):
        ColorParticleTracker(kernels=name)


@pytest.mark.parametrize(
    "params", [Params(), Params(particles=7, sharpness=12.5, grid=(5, 9), observation="lookup")]
)
def test_a_file_brings_them_back(params, tmp_path: Path):
    """Parameters written to TOML and read again are equal, the None of sharpness too."""
    params.to_toml(tmp_path / "params.toml")
    assert Params.from_toml(tmp_path / "params.toml") == params


def test_every_parameter_says_its_unit_and_source():
    """Each field has a unit and a source, and its default passes its own check."""
    assert all(field.metadata["unit"] and field.metadata["source"] for field in FIELDS.values())
    assert Params(**{name: field.default for name, field in FIELDS.items()}) == Params()


@pytest.mark.parametrize(
    "extreme",
    [
        {"particles": 2},
        {"grid": (2, 2)},
        {"grid": (64, 64)},
        {"grid_reach": 4, "ring": (1, 8)},
        {"max_step": 0, "max_step_sizes": 0},
        {"position_noise": 0, "velocity_noise": 0, "size_noise": 0, "aspect_noise": 0},
        {"size_range": (1e-9, 1e9), "size_noise": 2.0},
        {"skin_share": 0.99, "skin_threshold": -1},
        {"sharpness": 1e9, "color_weight": 1e9},
        {"sharpness": 1e-9, "color_weight": 0, "likelihood": "linear"},
        {"likelihood_drop": 0, "wide_search_spread": 50.0},
        {"learning_rate": 1, "color_rate": 1, "first_frame_weight": 1, "min_score_to_learn": 0},
        {"min_score": 1, "lost_after": 0.0, "min_score_to_redetect": 0},
        {"resample_below": 0, "size_pull": 1, "size_rate": 1, "velocity_rate": 1},
        {"resample_below": 1, "velocity_rate": 0},
    ],
    ids=str,
)
def test_extremes_give_finite_tracks(extreme, run):
    """Whatever the ranges allow gives finite boxes with an area and scores in [0, 1], over 36 frames."""
    for track in run(**extreme):
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1


@pytest.mark.parametrize("tracker", [ColorParticleTracker, FusedTracker])
def test_frames_until_lost_are_deprecated(tracker):
    """A whole number is taken for frames, as in version 0.1.0, with a warning that tells the seconds."""
    with pytest.warns(DeprecationWarning, match=r"^lost_after: .*give seconds: 0.3 instead of 9"):
        assert tracker(lost_after=9).params.lost_after == pytest.approx(0.3)
