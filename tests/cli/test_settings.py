# SPDX-License-Identifier: MIT
import dataclasses
from pathlib import Path
from typing import Literal

import pytest
from tricue.cli.settings import PAPER, make_tracker, papers, parse_settings, read_settings
from tricue.track.base.registry import names, tracker_class


@pytest.mark.parametrize("text", ["flow,disparity", "flow, disparity", "('flow', 'disparity')"])
def test_cues_are_words(text: str) -> None:
    """It proves that a parameter of words takes them with commas, or as Python writes them, and one alone."""
    assert make_tracker("flow-depth", None, [f"cues={text}"], 0, "native").params.cues == (
        "flow",
        "disparity",
    )
    assert make_tracker("flow-depth", None, ["cues=flow"], 0, "native").params.cues == ("flow",)


def test_settings_go_before_the_file(tmp_path: Path) -> None:
    """It proves that a setting overrides the file, the later of two the earlier, and the rest stays."""
    (tmp_path / "p.toml").write_text("particles = 50\nnear = 1.5\n")
    values = read_settings("depth-particle", tmp_path / "p.toml", ["particles=60", "particles=70"])
    assert (values["particles"], values["near"]) == (70, 1.5)
    made = make_tracker("depth-particle", tmp_path / "p.toml", ["particles=60"], 3, "reference")
    assert (made.params.particles, made.params.near, made.seed) == (60, 1.5, 3)  # type: ignore[attr-defined]


def test_settings_are_numbers_words_or_tuples() -> None:
    """It proves what text becomes: a number, a truth value, a tuple, or itself."""
    settings = ["a=1", "b=0.5", "c=true", "d=16,20", "e=word", "f=x=y"]
    assert parse_settings(settings) == {"a": 1, "b": 0.5, "c": True, "d": (16, 20), "e": "word", "f": "x=y"}


@pytest.mark.parametrize("setting", ["particles", "=3", "two words=3"])
def test_other_settings_are_refused(setting: str) -> None:
    """It proves that what isn't name=value is an error that shows it."""
    with pytest.raises(ValueError, match=rf"^--set: expected name=value, got '{setting}'$"):
        parse_settings([setting])


@pytest.mark.parametrize(
    ("setting", "option"),
    [
        ("seed=3", "--seed N"),
        ("kernels=reference", "--kernels NAME"),
        ("intrinsics=3", "--calibration FILE"),
        ("rig=3", "--calibration FILE"),
    ],
)
@pytest.mark.parametrize("base", [None, PAPER])
def test_what_has_an_option_is_told(setting: str, option: str, base: Literal["paper"] | None) -> None:
    """It proves that what isn't a parameter is refused with the option that sets it."""
    name = setting.partition("=")[0]
    with pytest.raises(TypeError, match=f"^--set {name}: expected a parameter, got what {option} sets$"):
        make_tracker("flow-depth", base, [setting], 0, "native")


@pytest.mark.parametrize("setting", ["seed=3", "kernels=reference"])
def test_a_third_partys_seed_has_an_option_too(setting: str) -> None:
    """It proves it of a class whose parameters aren't known."""
    with pytest.raises(TypeError, match=r"^--set (seed|kernels): expected a parameter, got what --"):
        make_tracker(f"{__name__}:Still", None, [setting], 0, "native")


@pytest.mark.parametrize("line", ["seed = 3", 'kernels = "reference"'])
def test_a_third_partys_seed_in_a_file_has_an_option_too(line: str, tmp_path: Path) -> None:
    """It proves that the message names the file, and what sets it."""
    path = tmp_path / "p.toml"
    path.write_text(f"step = 2\n{line}\n")
    with pytest.raises(TypeError, match=r"p.toml: (seed|kernels): expected a parameter, got what --"):
        read_settings(f"{__name__}:Still", path, [])


class Still:
    """A third party's."""

    def init(self, image: object, box: object) -> None:
        self.box = box

    def update(self, image: object) -> object:
        return self.box


@pytest.mark.parametrize("name", names())
def test_unknown_names_are_told_with_the_parameters(name: str) -> None:
    """It proves that the list has the parameters, and not what has an option of its own."""
    with pytest.raises(TypeError, match=r"^zzz: unknown parameter of .*; expected one of ") as caught:
        make_tracker(name, None, ["zzz=3"], 0, "native")
    listed = str(caught.value).partition("expected one of ")[2].split(", ")
    assert listed == [f.name for f in dataclasses.fields(tracker_class(name).Params)]


def test_a_byte_order_mark_is_no_part_of_a_file(tmp_path: Path) -> None:
    """It proves that TOML of an editor that begins files with one is read."""
    (tmp_path / "p.toml").write_text("particles = 50\n", encoding="utf-8-sig")
    assert read_settings("color-particle", tmp_path / "p.toml", [])["particles"] == 50


@pytest.mark.parametrize(
    ("text", "asked", "owners"),
    [
        ("skin_threshold = 0.2\n", "fused", "color-particle"),
        ("skin_threshold = 0.2\nparticles = 50\n", "fused", "color-particle"),
        ("particles = 50\n", "fused", "color-particle or depth-particle"),
        ("ring_samples = 20\n", "stereo-head", "color-particle"),
    ],
)
def test_a_file_for_another_tracker_is_told(text: str, asked: str, owners: str, tmp_path: Path) -> None:
    """The error names the file and the trackers that have all of its parameters."""
    (tmp_path / "p.toml").write_text(text)
    told = rf"p\.toml: expected parameters of {asked}, got those for --tracker {owners}$"
    with pytest.raises(TypeError, match=told):
        read_settings(asked, tmp_path / "p.toml", [])


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("skin_threshold = 0.2\nzzz = 1\n", "unknown parameter of FusedParams"),  # no tracker has both
        ('lost_after = "long"\n', "lost_after: expected a number"),  # known, of the wrong type
    ],
)
def test_other_mistakes_in_a_file_are_told_as_such(text: str, told: str, tmp_path: Path) -> None:
    """No other tracker is named if none has all parameters, or if the names are right."""
    (tmp_path / "p.toml").write_text(text)
    with pytest.raises(TypeError, match=told):
        read_settings("fused", tmp_path / "p.toml", [])


@pytest.mark.parametrize(
    ("settings", "asked", "told"),
    [
        (
            ["particles=50"],
            "fused",
            "--set particles: .* of fused, .* --tracker color-particle or depth-particle$",
        ),
        (["ring_samples=20", "rate=25"], "stereo-head", "--set ring_samples: .* --tracker color-particle$"),
        (["particlez=50"], "color-particle", "particlez: unknown parameter.*did you mean particles"),
    ],
)
def test_a_setting_for_another_tracker_is_told(settings: list[str], asked: str, told: str) -> None:
    """Unless no tracker has it: then it's the name that is wrong."""
    with pytest.raises(TypeError, match=told):
        read_settings(asked, None, settings)


@pytest.mark.parametrize("name", papers())
def test_a_printed_tracker_is_its_preset_and_nothing_else(name: str) -> None:
    """All parameters are those of Params.paper(); a setting overrides one of them."""
    printed = tracker_class(name).Params.paper()
    assert make_tracker(name, PAPER, [], 0, "native").params == printed != tracker_class(name).Params()
    field = next(f.name for f in dataclasses.fields(printed) if f.name in ("lost_after", "rate"))
    made = make_tracker(name, PAPER, [f"{field}=7.5"], 0, "native")
    assert made.params == dataclasses.replace(printed, **{field: 7.5})


def test_trackers_without_a_paper_have_nothing_printed() -> None:
    """The fused one follows no paper, nor does a third party's class."""
    assert set(papers()) == {"color-particle", "depth-particle", "flow-depth", "stereo-head"}
    with pytest.raises(ValueError, match="fused follows no paper; those that do: color-particle, depth-"):
        read_settings("fused", PAPER, [])


@pytest.mark.parametrize("text", ["-" * 90_000, "(" * 90_000, "1" + "0" * 400], ids=["-", "(", "10^400"])
def test_what_no_parser_can_hold_is_refused_by_its_name(text: str) -> None:
    """Text nested too deeply for Python's parser is text; a number beyond floats is infinite."""
    with pytest.raises((TypeError, ValueError), match="min_score: expected"):
        make_tracker("fused", None, [f"min_score={text}"], 0, "native")


def test_tables_nested_too_deeply_name_their_file(tmp_path: Path) -> None:
    """A file on which Python's parser gives up is named."""
    (tmp_path / "p.toml").write_text("a = " + "[" * 100_000)
    with pytest.raises(ValueError, match=r"p\.toml: expected a TOML file, its values are nested too deeply"):
        make_tracker("fused", tmp_path / "p.toml", [], 0, "native")
