# SPDX-License-Identifier: MIT
"""The fused tracker's Kalman filter in meters, against known motions."""

from types import SimpleNamespace

import numpy as np
import pytest
from tricue import Intrinsics
from tricue.track.fused.experts.depth import DEPTH_SAMPLES, DepthMeasurement
from tricue.track.fused.params import FusedParams
from tricue.track.fused.position_filter import (
    LATERAL_NOISE,
    MAX_INNOVATION,
    SHARED_DEPTH_ERROR,
    PositionFilter,
    back_project,
)
from tricue.track.fused.target import Target

P = FusedParams()
START = np.array([0.4, -0.2, 2.0])
SPEED = np.array([0.9, 0.3, -0.6])  # m/s
NOISE = np.diag([0.01, 0.01, 0.03]) ** 2
SECONDS = 1 / 30


def test_starts_at_the_measured_point():
    """It begins at rest at the point, with the covariance of the measurement, and returns copies."""
    estimate = PositionFilter.at_rest(START, NOISE, P)
    np.testing.assert_array_equal(estimate.position, START)
    np.testing.assert_array_equal(estimate.position_covariance, NOISE)
    np.testing.assert_array_equal(estimate.mean[3:], 0)
    estimate.position[:] = estimate.position_covariance[:] = 9
    np.testing.assert_array_equal(estimate.position, START)
    np.testing.assert_array_equal(estimate.position_covariance, NOISE)


def test_constant_velocity_is_followed(kernels):
    """Measured without error at constant velocity for 2 s the position is right to 2 mm, the velocity to 5 %,
    and it predicts the next quarter of a second to 2 cm.
    """
    estimate = PositionFilter.at_rest(START, NOISE, P)
    for index in range(1, 61):
        estimate = estimate.predict(kernels, SECONDS, P)
        estimate = estimate.correct(kernels, START + index * SECONDS * SPEED, NOISE)
    end = START + 60 * SECONDS * SPEED
    assert np.abs(estimate.position - end).max() < 2e-3
    np.testing.assert_allclose(estimate.mean[3:], SPEED, rtol=0.05)
    assert np.abs(estimate.predict(kernels, 0.25, P).position - end - 0.25 * SPEED).max() < 0.02


def test_the_covariance_is_that_of_the_error(kernels):
    """Of 400 targets with the noise and the accelerations of its model, the mean normalized squared error
    is 3 to within four standard deviations of a chi-square mean.
    """
    rng = np.random.default_rng(0)
    errors = []
    for _ in range(400):
        place, velocity = START.copy(), rng.normal(0, P.max_speed / np.sqrt(3), 3)
        estimate = PositionFilter.at_rest(rng.multivariate_normal(place, NOISE), NOISE, P)
        for _ in range(8):
            push = rng.normal(0, P.acceleration_noise, 3)
            place = place + SECONDS * velocity + SECONDS**2 / 2 * push
            velocity = velocity + SECONDS * push
            estimate = estimate.predict(kernels, SECONDS, P)
            estimate = estimate.correct(kernels, rng.multivariate_normal(place, NOISE), NOISE)
        off = estimate.position - place
        errors.append(off @ np.linalg.solve(estimate.position_covariance, off))
    assert abs(np.mean(errors) - 3) < 4 * np.sqrt(6 / 400)


def test_covariance_grows_without_measurement(kernels):
    """Each unmeasured frame widens every direction, and a measurement makes the covariance smaller than its
    own.
    """
    estimate = PositionFilter.at_rest(START, NOISE, P)
    for _ in range(30):
        later = estimate.predict(kernels, SECONDS, P)
        assert np.linalg.eigvalsh(later.position_covariance - estimate.position_covariance).min() > 0
        estimate = later
    after = estimate.correct(kernels, START, NOISE)
    assert np.linalg.eigvalsh(NOISE - after.position_covariance).min() > 0


def test_the_shared_error_lies_along_the_line_of_sight():
    """It adds a share of the depth spread to z's standard deviation, and nothing across the line of sight."""
    estimate = PositionFilter.at_rest(START, NOISE, P)
    shared = estimate.error_covariance(0.1) - NOISE
    assert shared[2, 2] == pytest.approx((SHARED_DEPTH_ERROR * 0.1) ** 2)
    across = np.linalg.svd(START[None])[2][1:]
    np.testing.assert_allclose(across @ shared, 0, atol=1e-12)
    np.testing.assert_array_equal(estimate.error_covariance(0.0), NOISE)


def test_the_shared_error_does_not_average_out(kernels):
    """After a hundred measurements z's standard deviation is hardly below that share, the filter's own is."""
    estimate = PositionFilter.at_rest(START, NOISE, P)
    for _ in range(100):
        estimate = estimate.predict(kernels, SECONDS, P).correct(kernels, START, NOISE)
    assert estimate.position_covariance[2, 2] < NOISE[2, 2]
    assert estimate.error_covariance(0.1)[2, 2] > (SHARED_DEPTH_ERROR * 0.1) ** 2
    assert estimate.expected_depth(0.0).sigma == pytest.approx(np.sqrt(estimate.covariance[2, 2]))


def test_distance_is_in_standard_deviations():
    """A point is as far as its offset in deviations of the state and its own together."""
    estimate = PositionFilter.at_rest(START, np.diag([0.03, 0.06, 0.08]) ** 2, P)
    noise = np.diag([0.04, 0.08, 0.06]) ** 2  # together 5, 10 and 10 cm
    assert estimate.distance(START, noise) == 0
    assert estimate.distance(START + [0.1, 0, 0], noise) == pytest.approx(2)
    assert estimate.distance(START + [0, -0.3, 0], noise) == pytest.approx(3)
    assert estimate.distance(START + [0.15, 0.4, 0], noise) == pytest.approx(5)


@pytest.mark.parametrize("off", [0.5, 2.0])
def test_a_large_innovation_widens_the_state(off, kernels):
    """A filter with a small covariance goes most of the way to a point that it didn't predict, and has a
    larger covariance after it than after one that it did.
    """
    estimate = PositionFilter.at_rest(START, NOISE / 100, P)
    there = START + [off, 0.0, 0.0]
    assert estimate.distance(there, NOISE) > 10 * MAX_INNOVATION
    small, large = (estimate.correct(kernels, point, NOISE) for point in (START, there))
    assert large.position[0] - START[0] > 0.5 * off
    assert np.trace(large.position_covariance) > 10 * np.trace(small.position_covariance)


def test_one_long_step_is_as_many_short_ones(kernels):
    """Without acceleration a second in one step is a second in thirty."""
    still = FusedParams(acceleration_noise=1e-9)
    long = short = PositionFilter(np.concatenate([START, SPEED]), np.diag([0.1, 0.1, 0.1, 0.5, 0.5, 0.5]))
    long = long.predict(kernels, 1.0, still)
    for _ in range(30):
        short = short.predict(kernels, SECONDS, still)
    np.testing.assert_allclose(short.mean, long.mean, rtol=1e-9)
    np.testing.assert_allclose(short.covariance, long.covariance, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(long.position, START + SPEED, rtol=1e-12)


def test_a_place_in_the_picture_tells_no_depth(kernels):
    """It moves the position to its ray and tells the velocity there; depth and its variance stay."""
    camera, estimate = (
        Intrinsics(300.0, 250.0, 159.5, 119.5, 320, 240),
        PositionFilter.at_rest(START, NOISE, P),
    )
    for index in range(1, 31):
        estimate = before = estimate.predict(kernels, SECONDS, P)
        column, row = camera.project([0.4 + 0.03 * index, -0.2, 2.0])
        target = Target(float(column) + 0.5, float(row) + 0.5, 20.0, 20.0)
        estimate = before.correct_bearing(kernels, target, camera)
        assert estimate.position[2] == before.position[2] == 2.0
        assert estimate.covariance[2, 2] == before.covariance[2, 2]
    assert estimate.position[:2] == pytest.approx([1.3, -0.2], abs=0.01)
    assert estimate.mean[3:] == pytest.approx([0.9, 0, 0], abs=0.1)
    assert np.linalg.eigvalsh(estimate.covariance).min() > 0


def test_slow_down_keeps_the_position():
    """Coming to rest takes from the velocity alone; of 1 m/s under 1 cm/s is left after 30 frames."""
    moving = PositionFilter(np.concatenate([START, SPEED]), np.eye(6))
    slower = moving.slow_down()
    np.testing.assert_array_equal(slower.position, START)
    assert (np.abs(slower.mean[3:]) < np.abs(SPEED)).all()
    assert (np.sign(slower.mean[3:]) == np.sign(SPEED)).all()
    for _ in range(30):
        slower = slower.slow_down()
    assert np.abs(slower.mean[3:]).max() < 0.01


@pytest.mark.parametrize("seconds", [1e-6, 1 / 30, 1.0])
def test_covariance_stays_valid(seconds, kernels):
    """After a thousand steps with and without measurement it is symmetric and positive definite."""
    estimate = PositionFilter.at_rest(START, NOISE, P)
    for index in range(1000):
        estimate = estimate.predict(kernels, seconds, P)
        if index % 7:
            estimate = estimate.correct(kernels, START, NOISE)
    np.testing.assert_array_equal(estimate.covariance, estimate.covariance.T)
    assert np.linalg.eigvalsh(estimate.covariance).min() > 0


@pytest.mark.parametrize("z", [1.0, 3.0])
def test_a_measured_point_has_the_noise_of_its_source(z, kernels):
    """On the optical axis, that of a depth averaged over the target's samples, and of a part of its side."""
    camera = Intrinsics(300.0, 250.0, 159.5, 119.5, 320, 240)
    source = SimpleNamespace(noise=lambda z, pixel_size: 0.01 * z * pixel_size)
    observation = SimpleNamespace(camera=camera, depth_source=source, k=kernels)
    target = Target(160.0, 120.0, 50.0, 50.0)
    point, covariance = back_project(observation, target, DepthMeasurement(z, 0.05, 1.0))
    assert point == pytest.approx([0, 0, z], abs=1e-9)
    lateral = LATERAL_NOISE * 50 * z
    deviations = lateral / 300, lateral / 250, 0.01 * z * 50 / DEPTH_SAMPLES
    np.testing.assert_allclose(covariance, np.diag(deviations) ** 2, rtol=1e-6, atol=1e-12)
