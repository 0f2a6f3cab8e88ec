# SPDX-License-Identifier: MIT
"""The parameters of the flow and depth tracker: that they come back from a file, and that the
paper's own form runs.
"""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tricue import FlowDepthTracker, Frame, Status, Track
from tricue.scenes import WalkScene
from tricue.track.flow_depth.cues import CueMap, Cues
from tricue.track.flow_depth.verify import estimate_in_frame

Params = FlowDepthTracker.Params


PAPER = Params.paper()
CHANGED = [
    each.name
    for each in dataclasses.fields(Params)
    if getattr(PAPER, each.name) != getattr(Params(), each.name)
]


def assert_sane(tracks: list[Track]) -> None:
    """Finite boxes with an area, scores in [0, 1], finite positions, positive definite covariances."""
    for track in tracks:
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1
        if track.position is not None:
            assert np.isfinite(track.position).all()
            assert np.linalg.eigvalsh(track.covariance).min() > 0


def test_the_order_of_cues_does_not_matter(walk_on):
    """Both cues are both cues, whichever is named first."""
    assert walk_on(cues=("disparity", "flow")) == walk_on(cues=["flow", "disparity"]) == walk_on()


@pytest.mark.parametrize("params", [Params(), PAPER, Params(cues=("flow",), vergence=-3.5)], ids=str)
def test_a_file_brings_them_back(params, tmp_path: Path):
    """Parameters written to TOML and read again are equal, the cues too."""
    params.to_toml(tmp_path / "params.toml")
    assert Params.from_toml(tmp_path / "params.toml") == params


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("cues = []\n", "cues: expected 'flow', 'disparity' or both"),
        ("bins = 4\n", "bins: expected at least 8"),
    ],
)
def test_a_file_is_checked_as_keywords_are(text, message, tmp_path: Path):
    """What keywords may not be, files may not say either, and their errors name the file."""
    (tmp_path / "params.toml").write_text(text)
    with pytest.raises(ValueError, match=rf"params.toml: {message}"):
        Params.from_toml(tmp_path / "params.toml")


def test_the_paper_has_no_stage_of_ours():
    """As printed there is no pyramid, no window around a pixel's disparity, no preference for the expected
    peak, no prominence, no surround, no memory, no cleaning of pixels; blocks and windows are the paper's.
    """
    p = PAPER
    assert (p.flow_levels, p.disparity_levels, p.disparity_radius) == (1, 1, 0)
    assert min(p.flow_change, p.disparity_change, p.max_disparity_step) >= 100
    stages = p.min_prominence, p.surround_weight, p.density_memory
    assert stages == (p.min_neighbors, p.min_region_share, p.outlier_share) == (0, 0, 0)
    assert not p.velocity_smoothing
    forms = p.histogram_region, p.block_rules, p.target_window, p.complete_occlusion
    assert forms == ("window", "printed", "pixels", "disparity")


@pytest.mark.parametrize("name", [*CHANGED, "all"])
def test_the_papers_form_runs(name, walk_on):
    """Each choice of the paper, and all of them at once, gives sane tracks that differ from the usual, and
    begin TRACKED.
    """
    tracks = walk_on(params=PAPER) if name == "all" else walk_on(**{name: getattr(PAPER, name)})
    assert_sane(tracks)
    assert tracks[0].status is Status.TRACKED
    if name not in WITHOUT_EFFECT:
        assert tracks != walk_on()


def test_the_papers_peak_is_the_highest_from_the_start(overtaken: WalkScene):
    """Section 4.2: the velocity is the highest peak of the histogram, also before a mean velocity is known:
    where 55 % of the window move by 2.6 cells, it isn't that of the others, who stand still.
    """
    tracker = FlowDepthTracker(dataclasses.replace(PAPER, cues=("flow",)))
    tracker.init(overtaken.frames[0], overtaken.boxes[0])
    state = tracker._state
    assert not state.has_mean_velocity
    x0, _, x1, _ = state.temporal_window
    values = np.zeros((120, 160), np.float32)
    values[:, round(x0 + 0.45 * (x1 - x0)) :] = 2.6
    u, v = CueMap(values, np.ones_like(values)), CueMap(np.zeros_like(values), np.ones_like(values))
    model = estimate_in_frame(tracker._k, state, Cues((0, 0, 160, 120), (u, v), None), tracker.params)
    assert model.peaks == pytest.approx((2.6, 0.0), abs=0.1)


def test_the_papers_peak_is_the_highest_however_far_it_is(overtaken: WalkScene):
    """Section 4.2: the disparity is the highest peak of the histogram, also where one that is 0.2 % lower is
    just where the disparity was.
    """
    tracker = FlowDepthTracker(dataclasses.replace(PAPER, cues=("disparity",)))
    tracker.init(overtaken.frames[0], overtaken.boxes[0])
    state = tracker._state
    x0, _, x1, _ = state.temporal_window
    left = np.arange(160) < (x0 + x1) / 2
    inside = (np.arange(160) + 0.5 >= x0) & (np.arange(160) + 0.5 < x1)
    values = np.where(left, state.disparity, state.disparity + 8)
    weights = np.where(left, 1 / (left & inside).sum(), 1.002 / (~left & inside).sum())
    planes = (np.tile(each.astype(np.float32), (120, 1)) for each in (values, weights))
    model = estimate_in_frame(
        tracker._k, state, Cues((0, 0, 160, 120), None, CueMap(*planes)), tracker.params
    )
    assert model.peaks == pytest.approx((state.disparity + 8,), abs=0.3)


@pytest.mark.parametrize("depth", [False, True])
def test_the_paper_follows_until_the_overtaking(depth, overtakings, follow):
    """As printed, the target is held as long as nothing hides it, before a stereo pair and a depth camera."""
    scene = overtakings(3, 55, depth=depth)
    frames = scene.frames[: scene.events.hiding]
    tracks = follow(FlowDepthTracker(PAPER, rig=scene.rig), frames, scene.boxes[0])
    assert {track.status for track in tracks} == {Status.TRACKED}
    overlaps = [track.box.iou(box) for track, box in zip(tracks, scene.boxes, strict=False)]
    assert np.mean(np.array(overlaps) > 0.5) > 0.9


def test_the_papers_pixels_leave_out_the_feet(overtakings):
    """Section 5: hardly any of the feet are extracted, because the velocity is taken to be uniform."""
    scene = overtakings(3, 55)
    tracker = FlowDepthTracker(PAPER, rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    shares = []
    for index in range(1, scene.events.hiding):
        tracker.update(scene.frames[index])
        _, y0, _, y1 = scene.boxes[index].xyxy
        down = (np.arange(120)[:, None] + 0.5 - y0) / (y1 - y0)
        target = scene.masks[index] > 0
        shares.append([(tracker.mask[target & part] > 0).mean() for part in (down > 0.85, down < 0.55)])
    feet, upper = np.mean(shares, axis=0)
    assert feet < 0.1
    assert upper > 3 * feet


WITHOUT_EFFECT = {"resolution", "depth_camera_scale", "min_posterior_one_cue", "thickness", "lost_after"}
"""In a stereo pair of 160 columns, by both cues, nothing hidden for seconds, alone among the defaults."""


EXTREMES: list[dict[str, Any]] = [
    {"resolution": 32},
    {"resolution": 10**9},
    {"vergence": 44},
    {"vergence": -44},
    {"sigma": 0.5, "flow_levels": 1},
    {"sigma": 8, "flow_levels": 6, "disparity_levels": 6},
    {"min_angle": 1},
    {"min_angle": 0, "min_contrast": 0},
    {"min_contrast": 1e12},
    {"bins": 8},
    {"bins": 8, "smoothing": 8},
    {"bins": 512, "smoothing": 1e-9},
    {"min_prominence": 0.999},
    {"flow_half_range": 0.01, "disparity_half_range": 0.01},
    {"flow_half_range": 160, "disparity_half_range": 160},
    {"flow_change": 1e-9, "disparity_change": 1e-9},
    {"flow_change": 1e9, "disparity_change": 1e9},
    {"flow_change": 1e9, "disparity_change": 1e9, "flow_half_range": 100.0, "disparity_half_range": 100.0},
    {"surround_weight": 0.999999, "density_memory": 0.999},
    {"surround_weight": 0, "density_memory": 0},
    {"margin": 0},
    {"margin": 2},
    {"min_posterior": 1e-9},
    {"min_posterior": 1},
    {
        "min_posterior": 1e-9,
        "min_neighbors": 0,
        "min_block_share": 1e-9,
        "votes_to_add": 1,
        "min_pixels": 1e-9,
    },
    {"min_neighbors": 8},
    {"block_side": 1e-9},
    {"block_side": 1},
    {"min_block_share": 1},
    {"votes_to_add": 10**9, "votes_to_remove": 10**9},
    {"votes_to_add": 1, "votes_to_remove": 1},
    {"occluder_margin": 1e-9},
    {"occluder_margin": 1e9},
    {"disparity_tolerance": 1e-9, "thickness": 0},
    {"disparity_tolerance": 1e9, "thickness": 0.999},
    {"max_occluded_share": 1e-9},
    {"max_occluded_share": 1},
    {"min_pixels": 1, "min_pixels_to_redetect": 1},
    {"min_pixels": 1e-9, "min_pixels_to_redetect": 1e-9},
    {"unoccluded_lost_after": 0, "lost_after": 0},
    {"unoccluded_lost_after": 1e9, "lost_after": 1e9},
    {"rate": 1e-9},
    {"rate": 1e9},
    {"place_noise": 1e-6, "disparity_noise": 1e-6, "acceleration_noise": 1e-6},
    {"place_noise": 160, "disparity_noise": 160, "acceleration_noise": 1e6},
    {"cues": ("flow",), "min_posterior_one_cue": 1e-9},
    {"cues": ("disparity",), "min_posterior_one_cue": 1},
]


@pytest.mark.parametrize(
    "name", ["flow_half_range", "disparity_half_range", "place_noise", "disparity_noise"]
)
@pytest.mark.parametrize("value", [161, 1e9, 1e300])
def test_no_length_is_beyond_an_image(name, value):
    """A range or a noise wider than the whole image is refused by name, before a kernel refuses what comes of
    it.
    """
    with pytest.raises(ValueError, match=rf"^{name}: expected .*at most 160, got"):
        Params(**{name: value})


@pytest.mark.parametrize("extreme", EXTREMES, ids=str)
def test_extremes_give_finite_tracks(extreme, overtaken: WalkScene, follow):
    """Whatever the ranges allow gives sane tracks over frames with an occlusion, and over some without
    anything to see. Verged by far more than there is to see the box is refused by name.
    """
    tracker = FlowDepthTracker(rig=overtaken.rig, **extreme)
    try:
        tracks = follow(tracker, overtaken.frames[::2], overtaken.boxes[0])
    except ValueError as error:
        assert str(error).startswith("box: expected a target with a disparity")  # noqa: PT017
        assert {"vergence", "resolution"} & extreme.keys()
        return
    assert_sane(tracks)
    black = np.zeros_like(overtaken.frames[0].color)
    assert_sane([tracker.update(Frame(black, right=black)) for _ in range(5)])
    assert_sane([tracker.update(Frame(frame.color, right=frame.right)) for frame in overtaken.frames[:3]])
