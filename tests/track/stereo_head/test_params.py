# SPDX-License-Identifier: MIT
"""The parameters of the stereo head tracker: that they come back from a file, and that the
paper's own forms run.
"""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from tricue import Frame, Status, StereoHeadTracker, Track
from tricue.scenes import StereoScene, head

Params = StereoHeadTracker.Params


PAPER = dataclasses.asdict(Params.paper())
PRINTED = {name: value for name, value in PAPER.items() if value != getattr(Params(), name)}
"""What the paper's form changes."""
UNSEEN = {
    *("color_noise", "color_drift", "intersection_noise"),
    *("min_intersection_to_learn", "learning_gate", "max_deviations", "search", "min_head_cells"),
}
"""What doesn't show in this scene, of 160 columns, unless other choices are the paper's, too."""


def assert_sane(tracks: list[Track]) -> None:
    """Finite boxes with an area, scores in [0, 1], finite positions, positive definite covariances."""
    for track in tracks:
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1
        assert np.isfinite(track.position).all()
        assert np.linalg.eigvalsh(track.covariance).min() > 0


@pytest.mark.parametrize(
    "params",
    [
        Params(),
        Params.paper(),
        Params(head_colors=((3, 0.25), (700, 1.0))),
        Params(bins=(8, 8, 4), search=(2, 0), near=0.1, far=20, fuse=False),
    ],
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


def test_the_printed_form_has_no_stage_of_ours():
    """Section 5's search and range; sums of absolute differences in whole pixels, their mean (3)-(5);
    constant position (6), the polynomial of one pixel (9); nothing that the paper doesn't have.
    """
    p = Params.paper()
    assert (p.resolution, p.min_head_cells, p.search, p.disparities) == (160, 0, (8, 2), (4, 4))
    assert (p.prefilter, p.uniqueness, p.subpixel, p.disparity_statistic) == (False, 0, False, "mean")
    assert (p.motion, p.noise_model, p.disparity_noise) == ("constant", "polynomial", 1)
    assert (p.learn, p.learning_gate, p.feedback, p.fuse) == ("all", "absolute", True, True)
    ours = (p.ring_weight, p.depth_weight, p.first_frame_weight, p.ellipse_margin, p.hair, p.min_score)
    assert not any(ours)
    assert not p.compensate_light
    assert min(p.max_deviations, p.search_frame_after) > 1e6


def test_one_number_stands_for_three_colors():
    """The noise of the mean color, given as one number, is that of all three; a file has all three."""
    assert Params(color_noise=3).color_noise == (3.0, 3.0, 3.0)
    assert Params(color_drift=0.5).color_drift == (0.5, 0.5, 0.5)


@pytest.mark.parametrize("name", [*sorted(PRINTED.keys() - UNSEEN), "fuse", "all"])
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


@pytest.mark.parametrize("subpixel", [True, False])
def test_a_range_wider_than_the_image(subpixel: bool, follow):
    """In cells of 40 pixels, 64 cells are more disparities than one search can have: those that the image has
    are among them.
    """
    scene = head(0, 4, "640x480")
    ranges = {"resolution": 16, "disparities": (64, 64), "subpixel": subpixel}
    assert_sane(follow(StereoHeadTracker(rig=scene.rig, **ranges), scene.frames, scene.boxes[0]))
