# SPDX-License-Identifier: MIT
"""That what jumps farther than the target does is less likely to be it."""

import itertools

import numpy as np
import pytest
from tricue import Box, Frame, FusedTracker, Status
from tricue.scenes import walker
from tricue.track.fused.motion import LOCALIZATION_ERROR, Motion
from tricue.track.fused.target import Target

SECONDS = 1 / 30
WEIGHT = 0.7


def target(x: float, y: float = 100.0, side: float = 40.0) -> Target:
    """With its middle there."""
    return Target(x, y, side, side)


def after(places: list[Target], seconds: float = SECONDS) -> Motion:
    """The motion through places, one a frame."""
    motion = Motion()
    for last, found in itertools.pairwise(places):
        motion = motion.follow(last, found, seconds)
    return motion


STEADY = after([target(100.0 + 8 * step) for step in range(10)])
SHAKEN = after([target(100.0 + 30 * (step % 2)) for step in range(10)])


def test_steady_motion_costs_nothing():
    """A target that goes on as before is where it would be, however fast it is."""
    assert STEADY.typical == pytest.approx(0, abs=1e-9)
    assert STEADY.penalty(target(172), target(180), SECONDS, WEIGHT) == 0


def test_a_jump_costs_by_the_weight():
    """Of one typical jump nothing, then the weight for each more."""
    still = after([target(100.0)] * 5)
    last, places = target(100), [target(100, 100 + 4.0 * count) for count in (1, 2, 5)]
    jumps = [still.penalty(last, each, SECONDS, WEIGHT) for each in places]
    assert LOCALIZATION_ERROR * 40 == 4
    assert jumps == pytest.approx([0, WEIGHT, 4 * WEIGHT])


def test_stopping_is_a_jump():
    """A fast target that stops isn't where it would be."""
    assert STEADY.penalty(target(172), target(172), SECONDS, WEIGHT) == pytest.approx(WEIGHT)


def test_a_target_that_jumps_all_the_time_may():
    """The same jump is much for a steady target, and nothing for one before a shaking camera."""
    last, found = target(100), target(100, 60)
    assert SHAKEN.penalty(last, found, SECONDS, WEIGHT) < 0.1
    assert STEADY.penalty(last, found, SECONDS, WEIGHT) > 6


def test_jumps_are_in_sides_of_the_target():
    """Seen from half as far the same motion has the same penalty."""
    near = after([target(200.0 + 16 * step, 200, 80) for step in range(10)])
    far_penalty = STEADY.penalty(target(172), target(200), SECONDS, WEIGHT)
    near_penalty = near.penalty(target(344, 200, 80), target(400, 200, 80), SECONDS, WEIGHT)
    assert near_penalty == pytest.approx(far_penalty)


def test_the_first_typical_jump_is_the_mean_of_all():
    """Each of the first jumps counts as much as the others."""
    places = [target(x) for x in (100, 100, 110, 110, 150)]
    velocities = np.diff([each.x for each in places])
    jumps = np.abs(np.diff(velocities)) / 40
    assert after(places).typical == pytest.approx(jumps.mean())


def test_time_counts():
    """Over a frame that was dropped the target moves twice as far."""
    assert STEADY.penalty(target(172), target(188), 2 * SECONDS, WEIGHT) == pytest.approx(0)
    assert STEADY.penalty(target(172), target(188), SECONDS, WEIGHT) > 0


def test_a_velocity_over_hardly_any_time_tells_nothing():
    """After a gap that is far longer, the target may be anywhere."""
    brief = STEADY.follow(target(172), target(180), SECONDS / 100)
    assert brief.penalty(target(180), target(188), SECONDS, WEIGHT) == 0
    assert brief.follow(target(180), target(188), SECONDS).typical == brief.typical


def test_nothing_is_known_at_first():
    """Nor after frames without the target, which may have gone anywhere; typical jumps stay known."""
    assert Motion().penalty(target(100), target(300), SECONDS, WEIGHT) == 0
    first = Motion().follow(target(100), target(110), SECONDS)
    assert first.penalty(target(110), target(300), SECONDS, WEIGHT) == 0
    missed = SHAKEN.interrupt()
    assert missed.penalty(target(100), target(300), SECONDS, WEIGHT) == 0
    again = missed.follow(target(300), target(310), SECONDS)
    assert (again.typical, again.jumps) == (SHAKEN.typical, SHAKEN.jumps)
    assert again.penalty(target(310), target(500), SECONDS, WEIGHT) > 0


def scene(place: int | None) -> Frame:
    """A card on a wall, and another one beside it, rather like it; the card is hidden without a place."""
    rng = np.random.default_rng(3)
    wall = np.kron(rng.integers(90, 150, (24, 32, 3)), np.ones((10, 10, 1))).astype(np.uint8)
    card = np.kron(rng.integers(0, 256, (5, 4, 3)), np.ones((8, 8, 1))).astype(np.uint8)
    other = np.clip(0.8 * card + 0.2 * rng.integers(0, 256, card.shape), 0, 255).astype(np.uint8)
    wall[100:140, 190:222] = other
    if place is not None:
        wall[100:140, place : place + 32] = card
    return Frame(wall)


@pytest.mark.parametrize("weight", [0.0, FusedTracker.Params().jump_weight])
def test_the_one_beside_it_is_not_taken_for_it(weight):
    """When the target vanishes, what is like it beside it is TRACKED instead only if jumps don't count."""
    tracker = FusedTracker(jump_weight=weight)
    tracker.init(scene(140), Box(140, 100, 32, 40))
    tracks = [tracker.update(scene(140)) for _ in range(20)]
    assert all(each.status is Status.TRACKED for each in tracks)
    assert (tracker.update(scene(None)).status is Status.TRACKED) == (weight == 0)


def mean_overlap(scene, times: list[float]) -> float:
    """Of a person in depth images with these timestamps, who is TRACKED all the time."""
    tracker = FusedTracker(intrinsics=scene.intrinsics)
    frames = [Frame(depth=each.depth, timestamp=time) for each, time in zip(scene.frames, times, strict=True)]
    tracker.init(frames[0], scene.boxes[0])
    tracks = [tracker.update(frame) for frame in frames[1:]]
    assert all(each.status is Status.TRACKED for each in tracks)
    return float(np.mean([each.box.iou(box) for each, box in zip(tracks, scene.boxes[1:], strict=True)]))


@pytest.mark.parametrize(("number", "interval"), [(5, 0.002), (5, 0.01), (8, 0.005)])
def test_depth_images_that_come_in_bursts_are_followed(number, interval):
    """The velocity over the time between two frames of a burst would put the person meters away."""
    scene = walker(2, 60, "tof")
    even = [n / 30 for n in range(60)]
    bursts = [n // number * number / 30 + interval * (n % number) for n in range(60)]
    assert mean_overlap(scene, bursts) > mean_overlap(scene, even) - 0.05


def test_frames_that_come_in_bursts_are_followed():
    """As from a network: every second frame has nearly the timestamp of the next."""
    tracker = FusedTracker()
    tracker.init(Frame(scene(10).color, timestamp=0.0), Box(10, 100, 32, 40))
    for index in range(1, 20):
        late = index + 0.98 * (index % 2)
        frame = Frame(scene(10 + 6 * index).color, timestamp=late / 30)
        assert tracker.update(frame).status is Status.TRACKED
