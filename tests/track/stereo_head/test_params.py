# SPDX-License-Identifier: MIT
"""The parameters of the stereo head tracker: what is refused, that they come back from a file, and that the
paper's own forms run.
"""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tricue
from tricue import Frame, Status, StereoHeadTracker, Track
from tricue.scenes import StereoScene

Params = StereoHeadTracker.Params
FIELDS = {field.name: field for field in dataclasses.fields(Params)}

REFUSED: dict[str, tuple[Any, ...]] = {
    "resolution": (15, 0, -1),
    "search": ((-1, 4), (8, 65), (8,), (8, 4, 2)),
    "bins": ((0, 16, 8), (16, 65, 8), (16, 16), (64, 64, 64)),
    "max_chroma": (0, 256),
    "compensate_light": (),
    "ring": (1, 0.5, 4.1),
    "ring_weight": (-0.1,),
    "depth_weight": (-0.1,),
    "depth_ring": (-0.1,),
    "disparity_tolerance": (0, -0.1),
    "hair": (-0.1, 1.1),
    "first_frame_weight": (-0.1, 1.1),
    "learning_rate": (-0.1, 1.1),
    "learn": ("Coherent", "", "none"),
    "min_intersection_to_learn": (-0.1, 1.1),
    "disparities": ((0, 4), (4, 65), (4,), (4, 4, 4)),
    "window": (0, -1, 4, 17),
    "uniqueness": (-1, 101),
    "prefilter": (),
    "ellipse_margin": (-0.1, 1.1),
    "disparity_statistic": ("mode", ""),
    "fuse": (),
    "motion": ("acceleration", ""),
    "acceleration_noise": (0, -0.1),
    "max_speed": (0, -1.0),
    "noise_model": ("cubic", ""),
    "disparity_noise": (0, -0.1),
    "place_noise": (0, -0.1),
    "color_noise": (0, -0.1),
    "feedback": (),
    "rate": (0, -30.0),
    "min_score": (-0.1, 1.1),
    "max_deviations": (0, -0.1),
    "search_frame_after": (-0.1,),
    "min_score_to_redetect": (-0.1, 1.1),
    "lost_after": (-0.1,),
    "near": (0, -1.0, 0.0009, 6.0, 9.0),
    "far": (0, -1.0),
}

PRINTED: dict[str, Any] = {
    "ring_weight": 0,
    "depth_weight": 0,
    "compensate_light": False,
    "learn": "all",
    "learning_rate": 0.1,
    "first_frame_weight": 0,
    "ellipse_margin": 0,
    "disparity_statistic": "mean",
    "motion": "constant",
    "noise_model": "polynomial",
    "disparity_noise": 1,
    "feedback": True,
}


def assert_sane(tracks: list[Track]) -> None:
    """Finite boxes with an area, scores in [0, 1], finite positions, positive definite covariances."""
    for track in tracks:
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1
        assert np.isfinite(track.position).all()
        assert np.linalg.eigvalsh(track.covariance).min() > 0


def test_every_field_has_its_bad_values():
    """The table above names every field there is: a new one must be tried too."""
    assert set(REFUSED) == set(FIELDS)


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in REFUSED.items() for value in values]
)
def test_values_out_of_range_are_named(name, value):
    """A value out of range is a ValueError that begins with the field's name, before any frame."""
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        StereoHeadTracker(**{name: value})


@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize("value", [..., "many", float("nan"), b"1", [None, None]], ids=repr)
def test_values_of_another_kind_are_named(name, value):
    """Whatever isn't a value of the field's type, NaN included, is an error that begins with its name."""
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        StereoHeadTracker(**{name: value})


@pytest.mark.parametrize("name", [n for n, f in FIELDS.items() if not isinstance(f.default, bool)])
def test_true_is_no_number(name):
    """True is no number, and no pair or word."""
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        StereoHeadTracker(**{name: True})


@pytest.mark.parametrize("name", [n for n, f in FIELDS.items() if isinstance(f.default, float)])
def test_numbers_are_finite(name):
    """An infinite number is a ValueError that begins with the field's name, whatever its range."""
    for value in (float("inf"), -float("inf")):
        with pytest.raises(ValueError, match=f"^{name}: expected"):
            StereoHeadTracker(**{name: value})


@pytest.mark.parametrize(("near", "far"), [(3.0, 3.0), (3.0, 2.0), (6.0, 6.0)])
def test_near_is_under_far(near, far):
    """A range that is empty or upside down is refused by the name of its lower end."""
    with pytest.raises(ValueError, match=r"^near: expected under far, .*got"):
        StereoHeadTracker(near=near, far=far)


def test_unknown_names_are_errors():
    """A misspelt parameter is a TypeError that proposes the right one."""
    with pytest.raises(TypeError, match=r"^disparity: unknown parameter of .*did you mean disparit"):
        StereoHeadTracker(disparity=(1, 2))


def test_params_and_keywords_are_the_same(covered: StereoScene, cover_up):
    """Parameters by params=, by keywords and through create() give one track; both ways at once are an
    error.
    """
    assert cover_up(params=Params(window=7)) == cover_up(window=7)
    tracker = tricue.create("stereo-head", seed=3, window=7, rig=covered.rig)
    assert isinstance(tracker, StereoHeadTracker)
    assert (tracker.seed, tracker.params, tracker.rig) == (3, Params(window=7), covered.rig)
    with pytest.raises(TypeError, match=r"^params: expected alone, got also window"):
        StereoHeadTracker(params=Params(), window=7)
    for other in ({}, tricue.ColorParticleTracker.Params()):
        with pytest.raises(TypeError, match=r"^params: expected StereoHeadParams, got "):
            StereoHeadTracker(params=other)


@pytest.mark.parametrize(
    ("seed", "error"), [(-1, ValueError), (None, TypeError), ("a", TypeError), (0.5, TypeError)]
)
def test_seeds_are_whole_numbers(seed, error):
    """A seed that is no whole number from 0 up is named, though it changes nothing."""
    with pytest.raises(error, match=r"^seed: expected"):
        StereoHeadTracker(seed=seed)
    assert StereoHeadTracker(seed=np.int64(5)).seed == 5


@pytest.mark.parametrize("name", ["", "cuda", None, []])
def test_kernels_are_native_or_reference(name):
    """Another set of kernels is a ValueError that names both."""
    with pytest.raises(ValueError, match=r"^kernels: expected 'native' or 'reference'"):
        StereoHeadTracker(kernels=name)


@pytest.mark.parametrize(
    "params",
    [Params(), Params(**PRINTED), Params(bins=(8, 8, 4), search=(2, 0), near=0.1, far=20, fuse=False)],
)
def test_a_file_brings_them_back(params, tmp_path: Path):
    """Parameters written to TOML and read again are equal, tuples, words and truth values too."""
    params.to_toml(tmp_path / "params.toml")
    assert Params.from_toml(tmp_path / "params.toml") == params


@pytest.mark.parametrize(
    ("text", "message"),
    [("near = 3\nfar = 2\n", "near: expected under far"), ("window = 4\n", "window: expected an odd")],
)
def test_a_file_is_checked_as_keywords_are(text, message, tmp_path: Path):
    """Checks beyond a range hold for files, and their errors name the file."""
    (tmp_path / "params.toml").write_text(text)
    with pytest.raises(ValueError, match=rf"params.toml: {message}"):
        Params.from_toml(tmp_path / "params.toml")


def test_every_parameter_says_its_unit_and_source():
    """Each field has a unit and a source, and its default passes its own check."""
    assert all(field.metadata["unit"] and field.metadata["source"] for field in FIELDS.values())
    assert Params(**{name: field.default for name, field in FIELDS.items()}) == Params()


def test_the_printed_form_is_the_one_described():
    """The docstring's list of the paper's choices is the one that is tried here."""
    text = " ".join((Params.__doc__ or "").split())
    for name, value in PRINTED.items():
        shown = f'{name}="{value}"' if isinstance(value, str) else f"{name}={value}"
        assert f"``{shown}``" in text


@pytest.mark.parametrize("name", [*PRINTED, "fuse", "all"])
def test_the_printed_form_runs(name, cover_up):
    """Each choice of the paper, and all of them at once, gives sane tracks that differ from the usual, and
    begin TRACKED.
    """
    tracks = cover_up(**(PRINTED if name == "all" else {name: {**PRINTED, "fuse": False}[name]}))
    assert_sane(tracks)
    assert tracks[0].status is Status.TRACKED
    assert tracks != cover_up()


@pytest.mark.parametrize("name", [*PRINTED, "fuse"])
def test_one_choice_of_the_paper_still_follows(name, heads, follow):
    """With one of the paper's choices alone a head in swinging light is on the whole still followed: the
    choice is an ablation, not a fault.
    """
    scene = heads(0)
    tracker = StereoHeadTracker(rig=scene.rig, **{name: {**PRINTED, "fuse": False}[name]})
    tracks = follow(tracker, scene.frames, scene.boxes[0])
    overlaps = [track.box.iou(box) for track, box in zip(tracks, scene.boxes, strict=True)]
    assert np.mean(overlaps) > 0.5


@pytest.mark.parametrize(
    "extreme",
    [
        {"resolution": 16},
        {"resolution": 10**9},
        {"search": (0, 0)},
        {"search": (64, 64)},
        {"bins": (1, 1, 1)},
        {"bins": (64, 64, 15)},
        {"max_chroma": 1},
        {"max_chroma": 255},
        {"ring": 1.0001},
        {"ring": 4},
        {"ring_weight": 1e9, "depth_weight": 0},
        {"ring_weight": 0, "depth_weight": 1e9, "depth_ring": 1e9},
        {"disparity_tolerance": 1e-9},
        {"disparity_tolerance": 1e9},
        {"hair": 1, "first_frame_weight": 1},
        {"hair": 0, "first_frame_weight": 0, "learning_rate": 0},
        {"learning_rate": 1, "min_intersection_to_learn": 0, "first_frame_weight": 0},
        {
            "learning_rate": 1,
            "min_intersection_to_learn": 0,
            "first_frame_weight": 0,
            "feedback": True,
            "learn": "all",
        },
        {"min_intersection_to_learn": 1},
        {"disparities": (1, 1)},
        {"disparities": (64, 64)},
        {"window": 1},
        {"window": 15},
        {"window": 15, "prefilter": False},
        {"uniqueness": 0},
        {"uniqueness": 100},
        {"ellipse_margin": 1},
        {"acceleration_noise": 1e-9},
        {"acceleration_noise": 1e6},
        {"max_speed": 1e-9},
        {"max_speed": 1e6},
        {"max_speed": 1e6, "motion": "constant"},
        {"disparity_noise": 1e-9, "place_noise": 1e-9},
        {"disparity_noise": 1e6, "place_noise": 1e6},
        {"disparity_noise": 1e6, "noise_model": "polynomial"},
        {"color_noise": 1e-9, "feedback": True},
        {"color_noise": 1e9, "feedback": True},
        {"rate": 1e-9},
        {"rate": 1e9},
        {"min_score": 0, "max_deviations": 1e9},
        {"min_score": 1, "max_deviations": 1e-9},
        {"search_frame_after": 0, "min_score_to_redetect": 0},
        {"search_frame_after": 1e9},
        {"lost_after": 0},
        {"lost_after": 1e9},
        {"near": 0.001},
        {"far": 20},
        {"far": 1e9},
        {"near": 1.0, "far": 1.0001},
    ],
    ids=str,
)
def test_extremes_give_finite_tracks(extreme, covered: StereoScene, follow):
    """Whatever the ranges allow gives sane tracks over frames with an occlusion, and over ten without
    anything to see. A range in which the head isn't, and matches so strict or so poor that hardly a pixel
    agrees with another, are refused at the start, by the box's name.
    """
    tracker = StereoHeadTracker(rig=covered.rig, **extreme)
    try:
        tracks = follow(tracker, covered.frames[::2], covered.boxes[0])
    except ValueError as error:
        assert str(error).startswith("box: expected a head with a disparity")  # noqa: PT017
        assert {"near", "far", "disparity_tolerance", "window"} & extreme.keys()
        return
    assert_sane(tracks)
    black = np.zeros_like(covered.frames[0].color)
    assert_sane([tracker.update(Frame(black, right=black)) for _ in range(10)])
    assert_sane([tracker.update(Frame(frame.color, right=frame.right)) for frame in covered.frames[:3]])
