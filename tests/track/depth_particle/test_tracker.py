# SPDX-License-Identifier: MIT
"""That the depth particle tracker follows people, reports when they are hidden, and reads the same
measurements in every layout and encoding.
"""

import gc
import tracemalloc
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, DepthParticleTracker, Frame, Intrinsics, Status, Track
from tricue.scenes import DepthScene, crossing, walker
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.projection import project_box

WITHIN = 3  # frames, until an occlusion is reported
BACK = 5  # frames, until somebody is followed again
HIDDEN, SEEN = 0.15, 0.5  # visible share
ROOM = Intrinsics.from_fov(176, 144, 47.5, 39.5)

LAYOUTS: dict[str, Callable[[NDArray[np.float32]], NDArray[np.generic]]] = {
    "NaN": lambda depth: depth.copy(),
    "0": lambda depth: np.nan_to_num(depth, nan=0.0),
    "infinity": lambda depth: np.where(np.isnan(depth), np.float32(np.inf), depth),
    "negative": lambda depth: np.where(np.isnan(depth), np.float32(-1), depth),
    "float64": lambda depth: depth.astype(np.float64),
    "Fortran": np.asfortranarray,
}


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


@pytest.mark.parametrize("name", LAYOUTS)
def test_all_encodings_of_no_measurement_are_the_same(name, passing: DepthScene, follow, pass_by):
    """NaN, 0, infinity, below 0, float64 and another memory order give the same track bit for bit."""
    frames = [Frame(depth=LAYOUTS[name](f.depth), timestamp=f.timestamp) for f in passing.frames]
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics, seed=5)
    assert follow(tracker, frames, passing.boxes[0]) == pass_by(seed=5)


@pytest.mark.parametrize(("dtype", "scale"), [(np.uint16, 0.001), (np.uint16, 0.0002), (np.int32, 0.001)])
def test_integers_with_a_scale_are_meters(dtype, scale, passing: DepthScene, follow):
    """Integers with depth_scale give the track of the same meters as floats, bit for bit."""
    counts = [np.rint(np.nan_to_num(f.depth) / scale).astype(dtype) for f in passing.frames]
    ours, theirs = (
        follow(DepthParticleTracker(intrinsics=passing.intrinsics, seed=5), frames, passing.boxes[0])
        for frames in (
            [Frame(depth=each, depth_scale=scale) for each in counts],
            [Frame(depth=each.astype(np.float32) * np.float32(scale)) for each in counts],
        )
    )
    assert ours == theirs


def test_color_beside_the_depth_changes_nothing(passing: DepthScene, follow, pass_by):
    """A color channel, of another size too, is ignored."""
    picture = np.random.default_rng(0).integers(0, 256, (20, 30, 3), np.uint8)
    frames = [Frame(color=picture, depth=f.depth, timestamp=f.timestamp) for f in passing.frames]
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics, seed=5)
    assert follow(tracker, frames, passing.boxes[0]) == pass_by(seed=5)


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


@pytest.mark.parametrize("rate", [15, 30])
def test_timestamps_are_the_rate(rate, passing: DepthScene, follow):
    """Frames with timestamps 1 / rate apart give the track of frames without any at that rate.

    With i / rate, differences are off by a rounding of i / rate, 2.2e-16 s of 2.4 s at most: a share of 7e-15
    of a frame. It goes into drift and noise as meters (velocity and position_noise times seconds), and from
    there, as in a step on other kernels, into log weights that are 200 times as steep a meter at most, which
    is 1e-12 px a frame, carried on over 36 frames: 1e-9 px, unless a resampled index or a sample crosses its
    border, a chance of about 1e-4.
    """
    bare = [Frame(depth=frame.depth) for frame in passing.frames]
    timed = [Frame(depth=f.depth, timestamp=i / rate) for i, f in enumerate(passing.frames)]
    ours, theirs = (
        follow(DepthParticleTracker(intrinsics=passing.intrinsics, seed=2, rate=r), frames, passing.boxes[0])
        for frames, r in ((bare, rate), (timed, 7))
    )
    # The first frame has no time before it, and no step to take.
    assert np.abs(np.subtract([t.box for t in ours], [t.box for t in theirs])).max() <= 1e-9
    assert [t.status for t in ours] == [t.status for t in theirs]


def test_time_matters(passing: DepthScene, follow):
    """At another rate the same frames give another track: somebody's speed is in meters a second."""
    boxes = [
        follow(DepthParticleTracker(seed=2, rate=rate), [Frame(depth=f.depth) for f in passing.frames], None)[
            -1
        ].box
        for rate in (5, 15)
    ]
    assert boxes[0] != boxes[1]


@pytest.mark.parametrize(
    "stamps", [(0.0, 0.0, 0.0), (2.0, 1.0, 0.0), (None, 0.5, None), (0.0, 1e9, 2e9)], ids=str
)
def test_irregular_timestamps_are_accepted(stamps, passing: DepthScene, follow):
    """Times that stand still, run back, come now and then, or leap by years leave the target followed."""
    frames = [Frame(depth=f.depth, timestamp=t) for f, t in zip(passing.frames, stamps, strict=False)]
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics)
    tracks = follow(tracker, frames, passing.boxes[0])
    assert overlaps(tracks, passing.boxes[:3]).min() > 0.5


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


def stand(x: float, z: float, shape: str = "upright") -> Frame:
    """A flat person, 0.5 m wide and 1.7 m tall, x meters aside and z in front, in an empty room 7 m deep. It
    is upright, or leans, so that it fills one half of its box, below a diagonal, or is wide, 0.7 m.
    """
    depth = np.full((144, 176), np.float32(7.4))
    columns, rows = (np.arange(side) + 0.5 - side / 2 for side in (176, 144))
    right, down = np.meshgrid(columns * z / ROOM.fx - x, rows * z / ROOM.fy)
    inside = (np.abs(right) < (0.35 if shape == "wide" else 0.25)) & (np.abs(down) < 0.85)
    depth[inside & ((shape != "leaning") | (down / 1.7 > right / 0.5))] = z
    return Frame(depth=depth)


def person_at(x: float, z: float) -> Box:
    """The box of that person."""
    return project_box(np.array([x, 0.0, z, 0.5, 1.7]), ROOM.vector)


def test_a_missed_target_goes_on_as_it_went():
    """Somebody who walks at 1 m/s to the side and nearer, and then isn't there, is expected farther on that
    way, less and less far a frame, and never nearer than anybody can be.
    """
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False, near=3.1, particles=500)
    places = np.array([(-0.5 + 0.06 * i, 4.0 - 0.04 * i) for i in range(20)])
    tracker.init(stand(*places[0]), person_at(*places[0]))
    seen = [tracker.update(stand(*place)) for place in places[1:]]
    empty = Frame(depth=np.full((144, 176), np.float32(7.4)))
    missed = [tracker.update(empty) for _ in range(15)]
    assert {track.status for track in seen} == {Status.TRACKED}
    assert Status.TRACKED not in {track.status for track in missed}
    steps = np.diff([track.position for track in (seen[-1], *missed)], axis=0)
    assert steps[0] == pytest.approx([0.06, 0.0, -0.04], abs=0.02)
    assert (np.diff(steps[:, 0]) < 0).all()
    assert (steps[:, 0] > 0).all()
    depths = np.array([track.depth for track in missed])
    assert depths.min() == 3.1


def test_the_place_of_a_missed_target_is_as_uncertain_as_its_motion():
    """In a second who stood still may have gone position_noise meters, 0.5, to the side, less up or down."""
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False, lost_after=9.0)
    tracker.init(stand(0.0, 3.0), person_at(0.0, 3.0))
    empty = Frame(depth=np.full((144, 176), np.float32(7.4)))
    last = [tracker.update(empty) for _ in range(15)][-1]
    x, y, z = np.sqrt(np.diag(last.covariance))
    assert (x, z) == pytest.approx((0.5, 0.5), abs=0.05)
    assert 0.1 < y < 0.25


def test_at_the_start_a_position_is_known_to_a_centimeter():
    """Of a target that was just given the covariance is neither 0 nor that of one that is searched."""
    track = DepthParticleTracker(intrinsics=ROOM, floor=False).init(stand(0.0, 3.0), person_at(0.0, 3.0))
    np.testing.assert_allclose(np.sqrt(np.diag(track.covariance)), 0.01)


def test_what_is_usual_is_learned_slowly():
    """Of somebody of whom a fifth is no longer measured, one frame changes the usual share by less than a
    fifth of that; after sixty, it and the usual likelihood are those of such frames in the mean.
    """
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False, gap_passes=0)
    tracker.init(stand(0.0, 3.0), person_at(0.0, 3.0))
    depth = stand(0.0, 3.0).depth.copy()
    depth[np.random.default_rng(0).random(depth.shape) < 0.2] = np.nan
    fg = Foreground(depth, tracker._state.camera, 1, (0, 0, 176, 144))
    usual, seen = [tracker._state.mean_inside], []
    for _ in range(60):
        tracker.update(Frame(depth=depth))
        state = tracker._state
        usual.append(state.mean_inside)
        found = state.model.observe(tracker._k, fg, state.motion.state)
        seen.append((found.inside, found.log_likelihood))
    assert 0.96 < usual[1] < usual[0] == 1
    inside, likelihood = np.mean(seen[-20:], axis=0)
    assert state.mean_inside == pytest.approx(inside, abs=0.04)
    assert state.mean_log_likelihood == pytest.approx(likelihood, abs=0.5)


def test_of_who_is_partly_covered_nothing_is_learned():
    """Somebody a fifth of whom is covered is TRACKED, and neither size, shape nor depths are learned."""
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False)
    tracker.init(stand(0.0, 3.0), person_at(0.0, 3.0))
    before = tracker._state
    depth = stand(0.0, 3.0).depth.copy()
    left, top, _, bottom = (round(each) for each in person_at(0.0, 3.0).xyxy)
    depth[top:bottom, left - 20 : left + 8] = 1.5
    for _ in range(3):
        assert tracker.update(Frame(depth=depth)).status is Status.TRACKED
    after = tracker._state
    np.testing.assert_array_equal(after.model.histogram, before.model.histogram)
    np.testing.assert_array_equal(after.motion.mean_size, before.motion.mean_size)
    np.testing.assert_array_equal(after.signature.values, before.signature.values)
    assert after.mean_inside == before.mean_inside


def test_who_is_hardly_covered_has_no_occluder():
    """Of a target that isn't there any more, what covers a tenth of its place is no occluder: it is LOST."""
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False, lost_after=0.3)
    tracker.init(stand(0.0, 3.0), person_at(0.0, 3.0))
    depth = np.full((144, 176), np.float32(7.4))
    left, top, _, bottom = (round(each) for each in person_at(0.0, 3.0).xyxy)
    depth[top:bottom, left - 20 : left + 4] = 1.5
    tracks = [tracker.update(Frame(depth=depth)) for _ in range(8)]
    assert tracks[-1].status is Status.LOST
    assert tracker._state.occluder is None


def test_who_goes_behind_furniture_comes_out_again():
    """Furniture that was there before is no object, and hides somebody all the same: whoever goes behind it
    is OCCLUDED, be it for longer than lost_after, and TRACKED on the other side.
    """
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False, lost_after=0.2)
    tracker.init(stand(-0.9, 3.0), person_at(-0.9, 3.0))
    left, right = (round(each) for each in person_at(0.0, 2.0).xyxy[::2])
    statuses = []
    for x in np.arange(-0.9, 0.9, 0.06):
        depth = stand(x, 3.0).depth
        depth[:, left - 2 : right + 2] = 2.0
        statuses.append(tracker.update(Frame(depth=depth)).status)
    assert statuses[0] is statuses[-1] is Status.TRACKED
    assert set(statuses) == {Status.TRACKED, Status.OCCLUDED}
    assert statuses.count(Status.OCCLUDED) > 0.2 * tracker.params.rate


def test_shape_and_size_are_learned():
    """Of somebody who begins to lean the position gets to the centroid again, and who is wider from some
    frame on is known to be, within three seconds.
    """
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False, particles=500)
    tracker.init(stand(0.3, 3.0), person_at(0.3, 3.0))
    for _ in range(45):
        leaning = tracker.update(stand(0.3, 3.0, "leaning"))
    np.testing.assert_allclose(leaning.position, [0.3 - 0.5 / 6, 1.7 / 6, 3.0], atol=0.05)
    for _ in range(45):
        tracker.update(stand(0.3, 3.0, "wide"))
    width, height = tracker._state.motion.mean_size
    assert 0.58 < width < 0.75
    assert height == pytest.approx(1.7, abs=0.05)


@pytest.mark.parametrize("complete", [True, False])
def test_the_position_is_the_bodys_centroid(complete):
    """Of somebody who leans the position is the centroid, a sixth of the box beside its center and below it;
    without completion it is the box's center.
    """
    tracker = DepthParticleTracker(intrinsics=ROOM, floor=False, complete=complete)
    position = tracker.init(stand(0.3, 3.0, "leaning"), person_at(0.3, 3.0)).position
    expected = [0.3 - 0.5 / 6, 1.7 / 6, 3.0] if complete else [0.3, 0.0, 3.0]
    np.testing.assert_allclose(position, expected, atol=0.03)


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
