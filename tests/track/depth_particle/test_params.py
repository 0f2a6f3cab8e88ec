# SPDX-License-Identifier: MIT
"""The parameters of the depth particle tracker: that they come back from a file, and that
the paper's own forms run.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import tricue
from tricue import DepthParticleTracker, Status, Track
from tricue.scenes import DepthScene
from tricue.track.depth_particle.measurement import NOT_MEASURED, Measurement
from tricue.track.depth_particle.motion import BodyMotion

Params = DepthParticleTracker.Params


PAPER = Params.paper()
CHOICES = (  # of the paper, each of which alone changes a track
    *("histogram", "likelihood", "contrast", "measurement", "floor", "edges", "leave_out_others"),
    *("motion", "sweeps", "size_prior", "human_filter", "complete", "grid"),
)


def assert_sane(tracks: list[Track]) -> None:
    """Finite boxes with an area, scores in [0, 1], finite positions, positive definite covariances."""
    for track in tracks:
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1
        assert np.isfinite(track.position).all()
        assert np.linalg.eigvalsh(track.covariance).min() > 0


@pytest.mark.parametrize("values", [{"bandwidth": 9.0}, {"near": 7.95}], ids=str)
def test_a_bandwidth_above_the_range_is_named(values):
    """A kernel wider than the range of depths is refused where it is set, not at the first frame."""
    with pytest.raises(ValueError, match=r"^bandwidth: expected"):
        DepthParticleTracker(**values)


@pytest.mark.parametrize(
    "params",
    [Params(), PAPER, Params(particles=7, grid=(5, 9), aspect=(1.5, 4), near=0.1, far=20)],
)
def test_a_file_brings_them_back(params, tmp_path: Path):
    """Parameters written to TOML and read again are equal, pairs and truth values too."""
    params.to_toml(tmp_path / "params.toml")
    assert Params.from_toml(tmp_path / "params.toml") == params


def test_a_file_is_checked_as_keywords_are(tmp_path: Path):
    """Checks that need two parameters hold for files, and their errors name the file."""
    (tmp_path / "params.toml").write_text("near = 3\nfar = 2\n")
    with pytest.raises(ValueError, match=r"params.toml: near: expected under far"):
        Params.from_toml(tmp_path / "params.toml")


def test_the_paper_has_no_stage_of_ours():
    """Every weight of ours is 0 and every stage of ours off; counts and ranges are those that are printed."""
    assert (PAPER.contrast, PAPER.measurement, PAPER.size_prior, PAPER.prominence) == (0, 0, 0, 0)
    assert not any([PAPER.floor, PAPER.edges, PAPER.complete, PAPER.leave_out_others, PAPER.coast])
    assert (PAPER.gap_passes, PAPER.sweeps, PAPER.max_fill) == (0, 1, 1)
    assert (PAPER.histogram, PAPER.likelihood, PAPER.motion) == ("absolute", "linear", "constant")
    assert PAPER.human_filter
    assert PAPER.depth_signature
    assert (PAPER.near, PAPER.far, PAPER.particles, PAPER.levels) == (0.3, 7.5, 100, 256)
    assert PAPER.speed_noise > 0  # K of (39)


def test_the_papers_location_is_the_expected_value(passing: DepthScene, pass_by):
    """As printed the position is the mean of the particles, the box's center; ours is the body's centroid."""
    camera, off = passing.intrinsics, {}
    for name, params in (("paper", PAPER), ("ours", Params())):
        tracks = pass_by(params=params)
        position = np.array([track.position for track in tracks])
        center = np.array([track.box.center for track in tracks]) - 0.5  # a pixel's center is a whole number
        rays = (center - (camera.cx, camera.cy)) / (camera.fx, camera.fy)
        off[name] = np.abs(position[:, :2] - rays * position[:, 2:]).max()
    assert off["paper"] < 1e-9
    assert off["ours"] > 0.02


def test_the_papers_noise_grows_with_the_last_step():
    """K of (39) grows with the speed of the last step, neither smoothed nor limited."""
    motion = BodyMotion.start(np.array([0, 0, 3, 0.6, 1.7]), np.array([True, True]))
    motion = motion.update(np.array([0.5, 0, 3, 0.6, 1.7]), PAPER, 0.1, True)
    np.testing.assert_allclose(motion.velocity, [5, 0, 0])


def test_nothing_is_in_front_for_the_paper(passing: DepthScene):
    """The paper knows no occluder: in its form every frame is TRACKED, also while the target is hidden."""
    tracker = DepthParticleTracker(params=PAPER, intrinsics=passing.intrinsics)
    tracker.init(passing.frames[0], passing.boxes[0])
    assert {tracker.update(frame).status for frame in passing.frames[1:]} == {Status.TRACKED}


def test_without_coasting_the_filter_goes_on(passing: DepthScene, follow):
    """Where nothing is measured any more, a target that isn't confirmed still is TRACKED, and its particles
    spread; the default tracker calls it missed.
    """
    nothing = tricue.Frame(depth=np.full_like(passing.frames[0].depth, np.nan))
    frames = [passing.frames[0], *[nothing] * 5]
    statuses, spreads = {}, {}
    for coast in (True, False):
        tracker = DepthParticleTracker(coast=coast, size_prior=0, intrinsics=passing.intrinsics)
        tracks = follow(tracker, frames, passing.boxes[0])
        statuses[coast] = {track.status for track in tracks[1:]}
        spreads[coast] = np.ptp(tracker.particles[:, 0])
    assert Status.TRACKED not in statuses[True]
    assert statuses[False] == {Status.TRACKED}
    assert spreads[True] == 0 < spreads[False]


def test_confidence_decides_what_is_learned(passing: DepthScene, follow):
    """The paper updates histograms "if estimation confidence is high": never, where it cannot be."""
    learned = {}
    for drop in (0.0, 1e9):
        params = replace(PAPER, likelihood_drop=drop, learning_rate=1.0)
        tracker = DepthParticleTracker(params=params, intrinsics=passing.intrinsics)
        tracker.init(passing.frames[0], passing.boxes[0])
        first = tracker._state.model.histogram
        empty = tricue.Frame(depth=np.where(np.isnan(passing.frames[0].depth), np.nan, np.float32(7.0)))
        tracker.update(empty)
        learned[drop] = not np.array_equal(tracker._state.model.histogram, first)
    assert learned == {0.0: False, 1e9: True}


def test_no_size_prior_means_none(walkers, follow):
    """Without the object and the size in the likelihood a rectangle of twice the size costs nothing."""
    scene = walkers[0]
    costs = {}
    for weight in (0.0, 1.0):
        tracker = DepthParticleTracker(
            size_prior=weight, contrast=0, likelihood="linear", intrinsics=scene.intrinsics
        )
        tracker.init(scene.frames[0], scene.boxes[0])
        state = tracker._state
        wide = np.stack([state.motion.state, state.motion.state * [1, 1, 1, 2, 2]])
        mean_size = state.motion.mean_size, tracker._size_deviation
        prior = tracker._k.rectangle_prior(wide, mean_size, NOT_MEASURED)
        costs[weight] = np.ptp(prior)
    assert costs[0.0] < 1e-100
    assert costs[1.0] > 5


def test_a_weight_multiplies_a_cost():
    """Four times the weight of the mean size, or of the object, makes what is off cost four times as much."""
    state = np.array([0, 0, 3, 0.6, 1.7])
    off = np.stack([state, state + [0.05, 0.05, -0.05, 0.03, 0.1], state + [2, 0, 0, 0, 0]])
    costs = []
    for weight in (1.0, 4.0):
        tracker = DepthParticleTracker(size_prior=weight)
        measured = Measurement.create(state, weight)
        prior = tracker._k.rectangle_prior(off, (state[3:], tracker._size_deviation), measured)
        costs.append(prior[0] - prior)
    assert (costs[0][1:] > 0.1).all()
    np.testing.assert_allclose(costs[1], 4 * costs[0])


@pytest.mark.parametrize("name", [*CHOICES, "all"])
def test_the_printed_form_runs(name, pass_by):
    """Each choice of the paper, and all of them at once, gives sane tracks that differ from the usual, and
    begin TRACKED.
    """
    tracks = pass_by(params=PAPER) if name == "all" else pass_by(**{name: getattr(PAPER, name)})
    assert_sane(tracks)
    assert tracks[0].status is Status.TRACKED
    assert tracks != pass_by()


@pytest.mark.parametrize(
    "name",
    [
        *("likelihood", "contrast", "measurement", "edges", "motion", "sweeps", "size_prior", "grid"),
        *("human_filter", "depth_signature", "complete", "coast"),
    ],
)
def test_one_choice_of_the_paper_still_follows(name, walkers, follow):
    """With one of the paper's milder choices alone a walker is on the whole still followed: the choice is an
    ablation, not a fault.
    """
    scene = walkers[0]
    tracker = DepthParticleTracker(intrinsics=scene.intrinsics, **{name: getattr(PAPER, name)})
    tracks = follow(tracker, scene.frames, scene.boxes[0])
    overlaps = [track.box.iou(box) for track, box in zip(tracks, scene.boxes, strict=True)]
    assert np.mean(overlaps) > 0.5


@pytest.mark.parametrize(
    "extreme",
    [
        {"particles": 2},
        {"grid": (2, 2)},
        {"grid": (64, 64)},
        {"near": 1e-9},
        {"far": 1e4},
        {"near": 2.4, "far": 5.0},
        {"resolution": 16},
        {"resolution": 10**9},
        {"rate": 1e-9},
        {"rate": 1e9},
        {"floor_clear": 0},
        {"floor_clear": 0.8},
        {"edge_gap": 0, "edge_slope": 0},
        {"edge_gap": 1e9, "edge_slope": 1e9},
        {"max_gap_share": 0, "gap_passes": 16},
        {"max_gap_share": 1, "gap_passes": 0},
        {"levels": 8, "bins": 4},
        {"levels": 4096, "bins": 4096},
        {"bandwidth": 1e-9},
        {"bandwidth": 1e-9, "prominence": 0, "levels": 4096},
        {"prominence": 1},
        {"min_area": 1e-9},
        {"min_area": 1e9},
        {"sharpness": 1e9, "contrast": 1e9, "measurement": 1e9},
        {"sharpness": 1e-9, "contrast": 0, "measurement": 0},
        {"histogram_reach": 1e-6},
        {"histogram_reach": 1e6},
        {"margin": 1e6},
        {"margin": 1.0001},
        {"object_share": 0},
        {"object_share": 0.999},
        {"max_speed": 1e9, "position_noise": 100.0, "velocity_rate": 1},
        {"max_speed": 1e-9, "position_noise": 0, "velocity_rate": 0},
        {"size_noise": 1e-9, "size_rate": 0},
        {"size_noise": 10.0, "size_rate": 1},
        {"learning_rate": 1},
        {"learning_rate": 0},
        {"learning_rate": 1, "histogram": "absolute"},
        {"occluder_margin": 1e-9, "max_covered": 0},
        {"occluder_margin": 1e9, "max_covered": 1},
        {"min_visible_share": 0, "likelihood_drop": 1e9},
        {"min_visible_share": 1, "likelihood_drop": 0},
        {"lost_after": 0},
        {"lost_after": 1e9},
    ],
    ids=str,
)
def test_extremes_give_finite_tracks(extreme, passing: DepthScene, pass_by):
    """Whatever the ranges allow gives sane tracks over 36 frames with an occlusion, and over ten without a
    measurement.
    """
    assert_sane(pass_by(**extreme))
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics, **extreme)
    tracker.init(passing.frames[0], passing.boxes[0])
    nothing = tricue.Frame(depth=np.full_like(passing.frames[0].depth, np.nan))
    assert_sane([tracker.update(nothing) for _ in range(10)])
    assert_sane([tracker.update(tricue.Frame(depth=frame.depth)) for frame in passing.frames[:3]])
