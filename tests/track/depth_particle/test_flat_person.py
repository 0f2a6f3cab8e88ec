# SPDX-License-Identifier: MIT
"""A flat person in an empty room: what the depth particle tracker learns of a target, and where it expects a
missed one.
"""

import numpy as np
import pytest
from tricue import Box, DepthParticleTracker, Frame, Intrinsics, Status
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.projection import project_box

ROOM = Intrinsics.from_fov(176, 144, 47.5, 39.5)


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
