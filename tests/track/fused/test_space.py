# SPDX-License-Identifier: MIT
"""The fused tracker's 3-D filter, against motions that are known."""

import numpy as np
import pytest
from tricue.track.fused.params import FusedParams
from tricue.track.fused.space import SURPRISING, Space

P = FusedParams()
START = np.array([0.4, -0.2, 2.0])
SPEED = np.array([0.9, 0.3, -0.6])  # m/s
NOISE = np.diag([0.01, 0.01, 0.03]) ** 2
SECONDS = 1 / 30


def test_starts_at_the_measured_point():
    """It begins at rest at the point, as sure of it as the measurement is, and gives out copies."""
    space = Space.start(START, NOISE, P)
    np.testing.assert_array_equal(space.position, START)
    np.testing.assert_array_equal(space.uncertainty, NOISE)
    np.testing.assert_array_equal(space.mean[3:], 0)
    space.position[:] = space.uncertainty[:] = 9
    np.testing.assert_array_equal(space.position, START)
    np.testing.assert_array_equal(space.uncertainty, NOISE)


def test_constant_velocity_is_followed(kernels):
    """Measured without error at constant velocity for 2 s it has the place to 2 mm, the velocity to 5 %, and
    foresees the next quarter of a second to 2 cm.
    """
    space = Space.start(START, NOISE, P)
    for index in range(1, 61):
        space = space.predicted(kernels, SECONDS, P)
        space = space.corrected(kernels, START + index * SECONDS * SPEED, NOISE)
    end = START + 60 * SECONDS * SPEED
    assert np.abs(space.position - end).max() < 2e-3
    np.testing.assert_allclose(space.mean[3:], SPEED, rtol=0.05)
    assert np.abs(space.predicted(kernels, 0.25, P).position - end - 0.25 * SPEED).max() < 0.02


def test_it_is_as_sure_as_it_is_right(kernels):
    """Of 400 targets with the noise and the accelerations that it believes in, the mean normalised squared
    error is 3 to within four standard deviations of a chi-square mean.
    """
    rng = np.random.default_rng(0)
    errors = []
    for _ in range(400):
        place, velocity = START.copy(), rng.normal(0, P.fastest / np.sqrt(3), 3)
        space = Space.start(rng.multivariate_normal(place, NOISE), NOISE, P)
        for _ in range(8):
            push = rng.normal(0, P.agility, 3)
            place = place + SECONDS * velocity + SECONDS**2 / 2 * push
            velocity = velocity + SECONDS * push
            space = space.predicted(kernels, SECONDS, P)
            space = space.corrected(kernels, rng.multivariate_normal(place, NOISE), NOISE)
        off = space.position - place
        errors.append(off @ np.linalg.solve(space.uncertainty, off))
    assert abs(np.mean(errors) - 3) < 4 * np.sqrt(6 / 400)


def test_covariance_grows_without_measurement(kernels):
    """Each unmeasured frame makes every direction less sure, and a measurement makes it surer again than
    itself.
    """
    space = Space.start(START, NOISE, P)
    for _ in range(30):
        later = space.predicted(kernels, SECONDS, P)
        assert np.linalg.eigvalsh(later.uncertainty - space.uncertainty).min() > 0
        space = later
    after = space.corrected(kernels, START, NOISE)
    assert np.linalg.eigvalsh(NOISE - after.uncertainty).min() > 0


def test_distance_is_in_standard_deviations():
    """A point is as far as its offset in deviations of the state and its own together."""
    space = Space.start(START, np.diag([0.03, 0.06, 0.08]) ** 2, P)
    noise = np.diag([0.04, 0.08, 0.06]) ** 2  # together 5, 10 and 10 cm
    assert space.distance(START, noise) == 0
    assert space.distance(START + [0.1, 0, 0], noise) == pytest.approx(2)
    assert space.distance(START + [0, -0.3, 0], noise) == pytest.approx(3)
    assert space.distance(START + [0.15, 0.4, 0], noise) == pytest.approx(5)


@pytest.mark.parametrize("off", [0.5, 2.0])
def test_a_surprise_is_believed(off, kernels):
    """A sure filter goes most of the way to a point that it didn't foresee, and is less sure after it than
    after one that it did.
    """
    space = Space.start(START, NOISE / 100, P)
    there = START + [off, 0.0, 0.0]
    assert space.distance(there, NOISE) > 10 * SURPRISING
    usual, surprised = (space.corrected(kernels, point, NOISE) for point in (START, there))
    assert surprised.position[0] - START[0] > 0.5 * off
    assert np.trace(surprised.uncertainty) > 10 * np.trace(usual.uncertainty)


def test_one_long_step_is_as_many_short_ones(kernels):
    """Without acceleration a second in one step is a second in thirty."""
    still = FusedParams(agility=1e-9)
    long = short = Space(np.concatenate([START, SPEED]), np.diag([0.1, 0.1, 0.1, 0.5, 0.5, 0.5]))
    long = long.predicted(kernels, 1.0, still)
    for _ in range(30):
        short = short.predicted(kernels, SECONDS, still)
    np.testing.assert_allclose(short.mean, long.mean, rtol=1e-9)
    np.testing.assert_allclose(short.covariance, long.covariance, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(long.position, START + SPEED, rtol=1e-12)


def test_slowed_keeps_the_place():
    """Coming to rest takes from the velocity alone; of 1 m/s under 1 cm/s is left after 30 frames."""
    moving = Space(np.concatenate([START, SPEED]), np.eye(6))
    slower = moving.slowed()
    np.testing.assert_array_equal(slower.position, START)
    assert (np.abs(slower.mean[3:]) < np.abs(SPEED)).all()
    assert (np.sign(slower.mean[3:]) == np.sign(SPEED)).all()
    for _ in range(30):
        slower = slower.slowed()
    assert np.abs(slower.mean[3:]).max() < 0.01


@pytest.mark.parametrize("seconds", [1e-6, 1 / 30, 1.0])
def test_covariance_stays_one(seconds, kernels):
    """After a thousand steps with and without measurement it is symmetric and positive definite."""
    space = Space.start(START, NOISE, P)
    for index in range(1000):
        space = space.predicted(kernels, seconds, P)
        if index % 7:
            space = space.corrected(kernels, START, NOISE)
    np.testing.assert_array_equal(space.covariance, space.covariance.T)
    assert np.linalg.eigvalsh(space.covariance).min() > 0
