# SPDX-License-Identifier: MIT
"""How much a frame counts in the flow and depth tracker's running means, by its number of target pixels."""

from typing import Any

import pytest
from tricue.track.flow_depth.state import MEAN_RATE, MIN_LEARNED_FRAMES, FlowDepthState

UNUSED: Any = None


def state(**known: Any) -> FlowDepthState:
    """With these values; none other is read."""
    values = {**dict.fromkeys(FlowDepthState._fields), **FlowDepthState._field_defaults, **known}
    return FlowDepthState(**values)


def known(frames: int, velocity: tuple[float, float] = (0.0, 0.0)) -> FlowDepthState:
    """The target had 100 pixels and moved by (2, -1) in so many frames, and has a new velocity."""
    return state(mean_velocity=(2.0, -1.0), mean_pixels=100.0, learned_frames=frames, velocity=velocity)


def test_the_first_frames_have_one_mean():
    """Each counts as much as the others, whatever its number of pixels."""
    now = state()
    for velocity, count in (((1.0, 5.0), 10), ((2.0, 3.0), 60), ((6.0, 1.0), 20)):
        now = now._replace(velocity=velocity).with_means(count, UNUSED)
    assert now.mean_velocity == pytest.approx((3, 3))
    assert now.mean_pixels == pytest.approx(30)
    assert now.learned_frames == MIN_LEARNED_FRAMES


@pytest.mark.parametrize(("count", "share"), [(0, 0), (50, 0.25), (100, 1), (400, 1)])
def test_few_pixels_count_less_and_many_no_more(count, share):
    """Half as many as on average count a quarter; more than that don't count more than one frame."""
    found = known(40).with_means(count, UNUSED)
    rate = share * MEAN_RATE
    assert found.mean_velocity == pytest.approx((2 - 2 * rate, -1 + rate))
    assert found.mean_pixels == pytest.approx(100 + rate * (count - 100))


@pytest.mark.parametrize(("count", "weight"), [(0, 0), (25, 0.5), (50, 1), (400, 1)])
def test_a_velocity_of_few_pixels_is_nearer_to_the_mean(count, weight):
    """That of half as many pixels as on average counts in full, and so does one of more."""
    expected = 2 + weight * (6 - 2), -1 + weight * (3 + 1)
    assert known(40).smooth_velocity((6.0, 3.0), count) == pytest.approx(expected)


def test_there_is_no_mean_at_first():
    """Before enough frames were seen the measured velocity is taken as it is."""
    assert known(MIN_LEARNED_FRAMES).smooth_velocity((6.0, 3.0), 1) == (6, 3)
