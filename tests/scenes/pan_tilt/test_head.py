# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.scenes import HeadLimits, SimulatedHead

LIMITS = HeadLimits(max_speed=1.0, max_acceleration=4.0, latency=0.1, max_pan=0.5, max_tilt=0.3)


def head() -> SimulatedHead:
    """A head that stands and looks ahead."""
    return SimulatedHead(LIMITS, np.zeros(2))


def test_a_command_takes_effect_late():
    """The head stands for the latency, and is at the speed asked for once it has accelerated."""
    one = head()
    one.drive(0.4, -0.2)
    one.move(0.099)
    assert not one.angles.any()
    one.move(0.151)  # 0.1 s of them at 4 rad/s²
    np.testing.assert_allclose(one.speeds, [0.4, -0.2])
    np.testing.assert_allclose(one.angles, [0.4 * 0.1, -0.2 * 0.125], atol=2e-3)


def test_limits_hold():
    """Speed, acceleration and angles."""
    one = head()
    one.drive(9.0, 0.0)
    before = 0.0
    for _ in range(100):
        one.move(0.01)
        assert abs(one.speeds[0] - before) <= 0.01 * LIMITS.max_acceleration + 1e-9
        assert one.speeds[0] <= LIMITS.max_speed
        before = one.speeds[0]
    assert one.angles[0] == pytest.approx(LIMITS.max_pan)


def test_the_last_command_counts():
    """A later command replaces an earlier one, after its own latency."""
    one = head()
    one.drive(0.4, 0.0)
    one.move(0.05)
    one.drive(0.0, 0.0)
    one.move(0.5)
    assert one.speeds[0] == pytest.approx(0)
    assert 0 < one.angles[0] < 0.05
