# SPDX-License-Identifier: MIT
"""What the color particle tracker does where the target is gone, and when it comes back."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, ColorParticleTracker, Status
from tricue.evaluation import metrics
from tricue.scenes import face_over_clutter
from tricue.track.color_particle.state import MIN_MISSED_FRAMES

Image = NDArray[np.uint8]
RNG = np.random.default_rng(0)
SHAPE = (240, 320, 3)
BLANK: dict[str, Callable[[], Image]] = {
    "black": lambda: np.zeros(SHAPE, np.uint8),
    "white": lambda: np.full(SHAPE, 255, np.uint8),
    "noise": lambda: RNG.integers(0, 256, SHAPE, np.uint8),
}
HERE = [(100 + 3.0 * i, 90.0) for i in range(12)]
THERE = (220.0, 20.0)
START = Box(100, 90, 50, 63)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("blank", BLANK)
def test_a_frame_without_target_is_reported(blank, seed, stage, follow):
    """Black, white and noise frames give a score under 0.3 and OCCLUDED at the first, LOST at the fifth,
    never TRACKED.
    """
    tracker = ColorParticleTracker(seed=seed)
    follow(tracker, stage(HERE), START)
    tracks = [tracker.update(BLANK[blank]()) for _ in range(40)]
    assert [track.status for track in tracks] == 4 * [Status.OCCLUDED] + 36 * [Status.LOST]
    assert max(track.score for track in tracks) < 0.3


@pytest.mark.parametrize(("lost_after", "frames"), [(0.0, MIN_MISSED_FRAMES), (0.15, 5), (0.41, 13)])
def test_lost_after_the_seconds_of_its_parameter(lost_after, frames, stage, follow):
    """At 30 frames/s the status is LOST from the frame that completes the seconds on, and never
    before MIN_MISSED_FRAMES frames.
    """
    tracker = ColorParticleTracker(lost_after=lost_after)
    follow(tracker, stage(HERE), START)
    statuses = [tracker.update(BLANK["black"]()).status for _ in range(15)]
    assert statuses.index(Status.LOST) == frames - 1
    assert Status.TRACKED not in statuses


def test_a_short_loss_is_bridged(stage, follow):
    """After three black frames a face that hasn't gone far is TRACKED at once, within 6 px."""
    tracker = ColorParticleTracker(seed=0)
    follow(tracker, stage(HERE), START)
    for _ in range(3):
        assert tracker.update(BLANK["black"]()).status is Status.OCCLUDED
    x, y = HERE[-1]
    track = tracker.update(stage([(x + 6, y)])[0])
    assert track.status is Status.TRACKED
    assert np.hypot(track.box.x - x - 6, track.box.y - y) < 6


@pytest.mark.parametrize("background", ["coffee", "cat", "motorcycle"])
@pytest.mark.parametrize("gone", [10, 100])
def test_redetected_elsewhere(background, gone, stage, follow):
    """A face that comes back 150 px away after 10 or 100 lost frames is detected within 15 frames.

    The model isn't unlearned meanwhile. The search is random, and prefers no detection to a wrong one: of
    three seeds one must detect the face, and none may be TRACKED anywhere else.
    """
    found = 0
    for seed in range(3):
        tracker = ColorParticleTracker(seed=seed)
        follow(tracker, stage(HERE, background), START)
        for _ in range(gone):
            tracker.update(BLANK["noise"]())
        last = [tracker.update(frame) for frame in stage(15 * [THERE], background, seed=0)][-1]
        near = np.hypot(last.box.x - THERE[0], last.box.y - THERE[1]) < 6
        assert near or last.status is Status.LOST
        found += last.status is Status.TRACKED
    assert found >= 1


@pytest.mark.parametrize("background", ["coffee", "cat", "motorcycle", "retina", "immunohistochemistry"])
def test_a_lost_face_is_not_detected_in_a_background(background, stage, follow):
    """Once lost, the target isn't detected in 60 frames of clutter alone."""
    tracker = ColorParticleTracker(seed=0)
    follow(tracker, stage(HERE, background), START)
    for _ in range(8):
        tracker.update(BLANK["black"]())
    statuses = {tracker.update(frame).status for frame in stage(60 * [None], background)}
    assert statuses == {Status.LOST}


def test_a_target_that_is_gone_is_not_tracked(stage, follow):
    """Where the face has left and only the background stays, it isn't TRACKED after a second, and in the end
    LOST, but for chance: in 7 of 320 runs something in the background was followed. The cat isn't among the
    backgrounds: it has a face of its own, which is followed.
    """
    followed = 0
    for background in ("coffee", "motorcycle", "retina", "immunohistochemistry"):
        for seed in range(4):
            tracker = ColorParticleTracker(seed=seed)
            follow(tracker, stage(HERE, background), START)
            tracks = [tracker.update(frame) for frame in stage(150 * [None], background)]
            statuses = [track.status for track in tracks]
            followed += Status.TRACKED in statuses[30:] or statuses[-1] is not Status.LOST
    assert followed <= 1


@pytest.mark.parametrize(("min_lead", "expected"), [(0.0, Status.TRACKED), (80.0, Status.OCCLUDED)])
def test_tracked_only_with_a_lead_over_what_is_beside(min_lead, expected, stage, follow):
    """No lead is as large as the highest min_lead asks."""
    tracker = ColorParticleTracker(seed=0, min_lead=min_lead)
    tracks = follow(tracker, stage(HERE), START)
    assert tracks[-1].status is expected


def test_with_no_time_without_lead_a_target_with_a_lead_is_followed(stage, follow):
    """``max_time_without_lead=0`` searches at the first frame without a lead, not in those with one."""
    tracker = ColorParticleTracker(max_time_without_lead=0.0)
    track = follow(tracker, stage(HERE), START)[-1]
    assert track.status is Status.TRACKED
    assert track.score > 0.8


def test_what_is_doubtful_is_not_learned(stage, follow):
    """Nor is it LOST before max_time_without_lead."""
    frames = stage(HERE)
    tracker = ColorParticleTracker(seed=0, min_lead=1000.0, max_time_without_lead=5 / 30 - 0.001)
    follow(tracker, frames[:1], START)
    learned = tracker._state.appearance
    statuses = [tracker.update(frame).status for frame in frames[1:6]]
    assert statuses == 4 * [Status.OCCLUDED] + [Status.LOST]
    np.testing.assert_array_equal(tracker._state.appearance.model.maps, learned.model.maps)


def test_the_box_of_a_lost_target_stays(stage, follow):
    """While the target is searched, the box stays where it was last estimated."""
    tracker = ColorParticleTracker(seed=0)
    follow(tracker, stage(HERE), START)
    tracks = [tracker.update(BLANK["black"]()) for _ in range(20)]
    assert {track.box for track in tracks[5:]} == {tracks[4].box}


@pytest.mark.parametrize(("step", "expected"), [(3, Status.TRACKED), (25, Status.OCCLUDED)])
@pytest.mark.parametrize("seed", range(4))
def test_what_is_a_little_like_the_target_is_not_tracked_far_off(seed, step, expected, stage, follow):
    """A face that fades to half within a frame is TRACKED 3 px from where it was, but not 25 px from it."""
    tracker = ColorParticleTracker(seed=seed)
    follow(tracker, stage(HERE), START)
    face, background = stage([(HERE[-1][0] + step, HERE[-1][1]), None])
    track = tracker.update(((face.astype(int) + background) // 2).astype(np.uint8))
    assert track.status is expected
    assert abs(track.box.x - HERE[-1][0] - step) < 6


def test_a_cover_is_not_followed_nor_what_is_beside_it(rendered, follow):
    """Noise covers a moving face for eight frames, once the tracker has seen it to and fro: in at least 18 of
    20 runs it is LOST, never TRACKED off the face, and found again.
    """
    right = 0
    for number in range(2):
        scene = rendered(face_over_clutter, seed=number, frames=24)
        order = 3 * [*range(24), *range(22, 0, -1)]
        frames, boxes = [np.array(scene.frames[i].color) for i in order], np.array(scene.boxes)[order]
        noise = np.random.default_rng(0)
        for index in range(54, 62):
            x, y, width, height = np.rint(boxes[index]).astype(int)
            frames[index][y : y + height, x : x + width] = noise.integers(0, 256, (height, width, 3))
        for seed in range(10):
            tracks = follow(ColorParticleTracker(seed=seed), frames, boxes[0])
            overlap = metrics.overlaps([track.box for track in tracks], boxes)
            tracked = np.array([track.status is Status.TRACKED for track in tracks])
            never_off = tracks[61].status is Status.LOST and not (tracked & (overlap < 0.1)).any()
            right += never_off and tracked[-20:].all() and overlap[-20:].mean() > 0.5
    assert right >= 18


def test_init_ends_a_search(stage, follow):
    """A new init on a lost tracker starts wholly anew: its track is a fresh tracker's, bit for bit."""
    frames = stage(HERE)
    lost = ColorParticleTracker(seed=4)
    follow(lost, frames + 10 * [BLANK["black"]()], START)
    assert follow(lost, frames, START) == follow(ColorParticleTracker(seed=4), frames, START)
