# SPDX-License-Identifier: MIT
"""That the depth particle tracker follows people, and reports when they are hidden."""

import gc
import tracemalloc
from collections.abc import Sequence

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, DepthParticleTracker, Frame, Intrinsics, Status, Track
from tricue.scenes import DepthScene, crossing, walker

WITHIN = 3  # frames, until an occlusion is reported
BACK = 5  # frames, until somebody is followed again
HIDDEN, SEEN = 0.15, 0.5  # visible share


def tracks_of(scene: DepthScene, follow, box: Box | None = None, **parameters) -> list[Track]:
    """Of a fresh tracker that knows the camera."""
    return follow(DepthParticleTracker(intrinsics=scene.intrinsics, **parameters), scene.frames, box)


def overlaps(tracks: Sequence[Track], boxes: Sequence[Box]) -> NDArray[np.float64]:
    """IoU, frame by frame."""
    return np.array([track.box.iou(box) for track, box in zip(tracks, boxes, strict=True)])


def assert_followed(tracks: Sequence[Track], scene: DepthScene) -> None:
    """The bounds of the task: mean IoU above 0.7, median error under 8 cm, 95th percentile under 25 cm."""
    off = np.linalg.norm([track.position for track in tracks] - scene.positions, axis=1)
    assert overlaps(tracks, scene.boxes).mean() > 0.7
    assert np.median(off) < 0.08
    assert np.percentile(off, 95) < 0.25


@pytest.fixture(scope="session")
def crossed(crossings: list[DepthScene], follow) -> list[tuple[DepthScene, list[Track]]]:
    """The crossings, each with its track from the true first box."""
    return [(scene, tracks_of(scene, follow, scene.boxes[0], seed=i)) for i, scene in enumerate(crossings)]


@pytest.mark.parametrize("seed", range(4))
def test_follows_a_walker(seed, walkers, follow):
    """Somebody who walks alone, crouches and raises the arms is followed from the true first box, and
    TRACKED in 95 % of the frames.
    """
    tracks = tracks_of(walkers[seed], follow, walkers[seed].boxes[0], seed=seed)
    assert_followed(tracks, walkers[seed])
    assert np.mean([track.status is Status.TRACKED for track in tracks]) >= 0.95


@pytest.mark.parametrize("seed", range(4))
def test_starts_without_a_box(seed, walkers, follow):
    """Without a box the one person in the room is found among the furniture, and followed as with one."""
    tracks = tracks_of(walkers[seed], follow, seed=seed)
    assert tracks[0].box.iou(walkers[seed].boxes[0]) > 0.5
    assert_followed(tracks, walkers[seed])


@pytest.mark.parametrize("seed", range(6))
def test_reports_an_occlusion(seed, crossed):
    """Within three frames of being hidden a target is OCCLUDED, and stays so as long as it is hidden."""
    scene, tracks = crossed[seed]
    hidden = scene.visible < HIDDEN
    assert hidden.any()
    for i in np.flatnonzero(hidden):
        if i >= WITHIN and hidden[i - WITHIN : i].all():
            assert tracks[i].status is Status.OCCLUDED


@pytest.mark.parametrize("seed", range(6))
def test_takes_the_right_person_up_again(seed, crossed):
    """Within five frames of being half visible a target is TRACKED, its box on it and on nobody else, and
    stays so: mean IoU above 0.6 until the end.
    """
    scene, tracks = crossed[seed]
    again = np.flatnonzero(scene.visible < HIDDEN)[-1]
    seen = again + int(np.argmax(scene.visible[again:] >= SEEN))
    assert scene.visible[seen] >= SEEN
    window = tracks[seen : seen + BACK + 1]
    assert Status.TRACKED in [track.status for track in window]
    last = tracks[seen + BACK]
    assert last.status is Status.TRACKED
    assert last.box.iou(scene.boxes[seen + BACK]) > 0.5
    others = [other.box for other in scene.others[seen + BACK]]
    assert last.box.iou(scene.boxes[seen + BACK]) > max(last.box.iou(box) for box in others)
    assert overlaps(tracks[seen + BACK :], scene.boxes[seen + BACK :]).mean() > 0.6


@pytest.mark.parametrize("seed", range(6))
def test_never_follows_who_is_in_front(seed, crossed):
    """In no frame is a TRACKED box on whoever crosses: with an IoU above 0.5 that is more than the target's
    own.
    """
    scene, tracks = crossed[seed]
    for track, box, (occluder, *_) in zip(tracks, scene.boxes, scene.others, strict=True):
        wrong = track.box.iou(occluder.box) > max(0.5, track.box.iou(box))
        assert not (track.status is Status.TRACKED and wrong)


@pytest.mark.parametrize("seed", range(6))
def test_never_stands_where_another_stands(seed, crossed):
    """In no frame is a TRACKED position nearer to anybody else than to the target."""
    scene, tracks = crossed[seed]
    for track, own, others in zip(tracks, scene.positions, scene.others, strict=True):
        nearest = min(np.linalg.norm(track.position - other.position) for other in others)
        assert track.status is not Status.TRACKED or np.linalg.norm(track.position - own) < nearest


@pytest.mark.parametrize("seed", range(6))
def test_covariance_is_valid(seed, crossed):
    """A covariance is symmetric and positive definite in every frame."""
    for track in crossed[seed][1]:
        np.testing.assert_array_equal(track.covariance, track.covariance.T)
        assert np.linalg.eigvalsh(track.covariance).min() > 0


@pytest.mark.parametrize("seed", range(6))
def test_covariance_grows_while_occluded(seed, crossed):
    """A hidden target's place gets less certain from frame to frame, and certain again when it is seen."""
    _, tracks = crossed[seed]
    variance = np.array([np.trace(track.covariance) for track in tracks])
    hidden = np.array([track.status is Status.OCCLUDED for track in tracks])
    in_a_row = np.flatnonzero(hidden[1:] & hidden[:-1]) + 1
    assert len(in_a_row) > 0
    assert (variance[in_a_row] > variance[in_a_row - 1]).all()
    assert np.median(variance[hidden]) > np.median(variance[~hidden])


def test_covariance_grows_while_a_prediction_slows_down():
    """It grows from frame to frame as well where somebody was hidden for two seconds and then isn't there."""
    scene = walker(seed=0, frames=10)
    tracker = DepthParticleTracker(intrinsics=scene.intrinsics)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:]:
        tracker.update(frame)
    near, nothing = (Frame(depth=np.full_like(frame.depth, meters)) for meters in (0.4, np.nan))
    variance = [np.trace(tracker.update(each).covariance) for each in [near] * 30 + [nothing] * 30]
    assert (np.diff(variance) > 0).all()


def test_covariance_grows_as_long_as_nobody_is_seen(walkers):
    """Who was last seen 30 seconds ago may be 10 m away; after an hour the place is unknown by 100 m."""
    scene = walkers[0]
    tracker = DepthParticleTracker(intrinsics=scene.intrinsics)
    tracker.init(Frame(depth=scene.frames[0].depth, timestamp=0), scene.boxes[0])
    nothing = np.full_like(scene.frames[0].depth, np.nan)
    tracks = [tracker.update(Frame(depth=nothing, timestamp=1 + i)) for i in range(3600)]
    deviations = np.sqrt([np.diag(tracks[seconds].covariance) for seconds in (0, 29, 3599)])
    assert (np.diff(deviations[:2], axis=0) > 4).all()
    assert deviations[1, 0] > 10
    np.testing.assert_allclose(deviations[2], 100)


def test_scores_follow_visibility(crossed):
    """The score is 0 while hidden, above 0.3 in half of the frames while TRACKED, and in [0, 1]."""
    for _, tracks in crossed:
        scores = np.array([track.score for track in tracks])
        tracked = np.array([track.status is Status.TRACKED for track in tracks])
        assert ((scores >= 0) & (scores <= 1)).all()
        assert np.median(scores[tracked]) > 0.3
        assert (scores[~tracked] == 0).all()


def test_no_person_is_detected_in_an_empty_room():
    """Without a box, and with a bare wall, a floor or nothing in front, the error begins with the box."""
    floor = np.full((144, 176), 7.0, np.float32)
    floor[80:] = (1.3 * 201 / (np.arange(80, 144) - 71.5))[:, None]
    for depth in (np.full((144, 176), 3.0), np.full((144, 176), np.nan), np.full((144, 176), 30.0), floor):
        with pytest.raises(ValueError, match=r"^box: expected .*nobody was found"):
            DepthParticleTracker().init(Frame(depth=depth))


def test_init_restarts(passing: DepthScene, follow, pass_by):
    """A second init forgets the first: its tracks are a fresh tracker's, also after another size."""
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics, seed=3)
    follow(tracker, passing.frames[10:25], passing.boxes[10])
    assert follow(tracker, passing.frames, passing.boxes[0]) == pass_by(seed=3)
    anywhere = DepthParticleTracker(seed=3)
    follow(anywhere, [Frame(depth=frame.depth[::2, ::2]) for frame in passing.frames[:5]], (20, 10, 30, 50))
    fresh = follow(DepthParticleTracker(seed=3), passing.frames, passing.boxes[0])
    assert follow(anywhere, passing.frames, passing.boxes[0]) == fresh


def test_no_position_without_intrinsics(walkers, follow):
    """Without intrinsics tracks have a box and a depth, no position and no covariance, and the person is
    followed.
    """
    scene = walkers[0]
    tracks = follow(DepthParticleTracker(seed=0), scene.frames, scene.boxes[0])
    assert {(track.position, track.covariance) for track in tracks} == {(None, None)}
    assert np.median([abs(t.depth - z) for t, z in zip(tracks, scene.positions[:, 2], strict=True)]) < 0.1
    assert overlaps(tracks, scene.boxes).mean() > 0.7


def test_positions_are_in_the_box(crossed):
    """The position projects into the box, within a tenth of its size."""
    for scene, tracks in crossed:
        for track in tracks:
            assert track.depth == track.position[2]
            x, y = scene.intrinsics.project(track.position) + 0.5
            assert abs(x - track.box.center[0]) < 0.6 * track.box.width
            assert abs(y - track.box.center[1]) < 0.6 * track.box.height


@pytest.mark.parametrize(
    "flaws", [{"missing": 0.3}, {"noise": 3.0}, {"missing": 0.0, "noise": 0.0}], ids=["gaps", "noise", "none"]
)
@pytest.mark.parametrize("seed", range(2))
def test_follows_with_a_worse_sensor(flaws, seed, follow):
    """With 30 % of the pixels missing, or three times the noise, the walker is still followed: mean IoU above
    0.6, median error under 12 cm; without any flaw as well as with the default sensor.
    """
    scene = walker(seed, **flaws)
    tracks = tracks_of(scene, follow, scene.boxes[0], seed=seed)
    if flaws.get("noise") == 0.0:
        assert_followed(tracks, scene)
    off = np.linalg.norm([track.position for track in tracks] - scene.positions, axis=1)
    assert overlaps(tracks, scene.boxes).mean() > 0.6
    assert np.median(off) < 0.12


def test_positions_follow_the_intrinsics(walkers, follow):
    """With half the focal length everything is twice as far aside, at the same depth."""
    scene = walkers[0]
    c = scene.intrinsics
    wide = Intrinsics(c.fx / 2, c.fy / 2, c.cx, c.cy, c.width, c.height)
    default, twice = (
        DepthParticleTracker(intrinsics=camera, floor=False).init(scene.frames[0], scene.boxes[0])
        for camera in (c, wide)
    )
    np.testing.assert_allclose(twice.position[2], default.position[2], rtol=1e-9)
    np.testing.assert_allclose(twice.position[:2], 2 * default.position[:2], rtol=1e-9)
    assert twice.box == pytest.approx(default.box)


def test_particles_and_objects_are_exposed(passing: DepthScene):
    """Particles and objects are none before init; then as many particles as set, spread around the box,
    and the target is one of the objects.
    """
    tracker = DepthParticleTracker(particles=37, intrinsics=passing.intrinsics)
    assert tracker.particles.shape == (0, 5)
    assert tracker.objects == []
    tracker.init(passing.frames[0], passing.boxes[0])
    track = tracker.update(passing.frames[1])
    assert tracker.particles.shape == (37, 5)
    lowest, highest = tracker.particles.min(axis=0), tracker.particles.max(axis=0)
    box = [*track.box.center, track.box.width, track.box.height]
    assert (lowest[:4] <= box).all()
    assert (box <= highest[:4]).all()
    assert max(track.box.iou(each) for each in tracker.objects) > 0.5


@pytest.mark.parametrize("company", [False, True], ids=["alone", "beside somebody"])
def test_lost_when_gone_and_tracked_when_back(company, walkers, follow):
    """Somebody whom nothing hides and who isn't there is OCCLUDED at first, LOST after lost_after seconds,
    and TRACKED within five frames of standing there again.
    """
    scene = crossing(1, frames=36) if company else walkers[0]
    tracker = DepthParticleTracker(intrinsics=scene.intrinsics, lost_after=0.45)
    follow(tracker, scene.frames[:10], scene.boxes[0])
    empty = Frame(depth=np.full_like(scene.frames[0].depth, 7.4))
    statuses = [tracker.update(empty).status for _ in range(12)]
    assert statuses == 6 * [Status.OCCLUDED] + 6 * [Status.LOST]
    back = [tracker.update(Frame(depth=scene.frames[9].depth)) for _ in range(BACK)]
    assert back[-1].status is Status.TRACKED
    assert back[-1].box.iou(scene.boxes[9]) > 0.5


def test_memory_stays_as_it_is(passing: DepthScene):
    """A thousand updates keep no more than 64 kB above what the first 140 left."""
    tracker = DepthParticleTracker(seed=0, particles=20)
    cycle = [Frame(depth=frame.depth) for frame in (*passing.frames, *reversed(passing.frames))]
    tracker.init(cycle[0], passing.boxes[0])

    def updates(rounds: int) -> int:
        for frame in rounds * cycle:
            tracker.update(frame)
        gc.collect()
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        before = updates(2)
        assert updates(14) - before < 64_000
    finally:
        tracemalloc.stop()
