# SPDX-License-Identifier: MIT
"""That the velocity of a missed target fades by time in slow video."""

import numpy as np
import pytest
from tricue import DepthParticleTracker, Frame, StereoHeadTracker
from tricue.track.base.coasting import velocity_kept


@pytest.mark.parametrize("rate", [15.0, 30.0])
@pytest.mark.parametrize("start", [0.0, 1.7e9])
def test_a_frame_keeps_the_share(rate, start):
    """Bit for bit, also where timestamps are rounded."""
    seconds = (start + 7 / rate) - (start + 6 / rate)
    assert velocity_kept(0.85, seconds, rate) == 0.85


def test_a_short_frame_keeps_no_more():
    """A long frame keeps less, in the proportion of the times; a short one as much."""
    assert velocity_kept(0.5, 0.3, 10.0) == 0.125
    assert velocity_kept(0.5, 0.05, 10.0) == 0.5


@pytest.mark.parametrize("frames", [1, 2, 5])
def test_a_missed_person_moves_on_by_the_time(frames, walkers, follow):
    """After a second without the person the velocity is the same, as one frame or as 15."""
    scene = walkers[0]
    speeds = []
    for count in (15, frames):
        tracker = DepthParticleTracker(intrinsics=scene.intrinsics)
        follow(tracker, scene.frames[:20], scene.boxes[0])
        last, nothing = scene.frames[19], np.full_like(scene.frames[19].depth, np.nan)
        for index in range(count):
            tracker.update(Frame(depth=nothing, timestamp=last.timestamp + (index + 1) / count))
        speeds.append(np.linalg.norm(tracker._state.motion.velocity))
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-2)


@pytest.mark.parametrize("frames", [1, 2, 10])
def test_a_missed_head_moves_on_by_the_time(frames, heads, follow):
    """After a second without the head the velocity is the same, as one frame or as 30."""
    scene = heads(0)
    speeds = []
    for count in (30, frames):
        tracker = StereoHeadTracker(rig=scene.rig)
        follow(tracker, scene.frames[:20], scene.boxes[0])
        last, black = scene.frames[19], np.zeros_like(scene.frames[19].color)
        for index in range(count):
            tracker.update(Frame(black, right=black, timestamp=last.timestamp + (index + 1) / count))
        speeds.append(np.linalg.norm(tracker._state.filter.mean[7:]))
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-2)
