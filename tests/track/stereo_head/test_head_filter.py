# SPDX-License-Identifier: MIT
"""That the filter of the stereo head tracker is the one of its model: closed forms, and simulated heads."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from scipy import stats
from tricue import StereoHeadTracker
from tricue.track.stereo_head import head_filter
from tricue.track.stereo_head.head_filter import (
    COASTING_FACTOR,
    INTERSECTION_DRIFT,
    MEASUREMENT_SIZE,
    HeadFilter,
    coast,
    correct,
    initialize,
    mahalanobis_distance,
    predict,
)

Params = StereoHeadTracker.Params
P = Params()
WIDE = Params(far=100.0)  # in which no simulated head reaches an end,
MIDDLE = np.array([0.2, -0.1, 20.0, 5.0, -12.0, 300.0, 0.8])  # from here
CONSTANT = Params(motion="constant")
SECONDS = 1 / 30
VALUES = np.array([0.2, -0.1, 2.0, 5.0, -12.0, 300.0, 0.8])
ROOT = np.diag([0.004, 0.005, 0.03, 4.0, 4.0, 4.0, 0.1])
ROOT[2, :2] = 0.01, -0.008  # of a head aside, whose errors along the ray go together
NOISE = ROOT @ ROOT.T
DRIFTS = np.array([*P.color_drift, INTERSECTION_DRIFT])
RUNS, FRAMES = 150, 25
CHANCE = 1e-4  # of a test on simulated data to fail with another seed


def simulated(kernels, seed: int) -> Iterator[tuple[np.ndarray, HeadFilter, float]]:
    """The true states, what the filter makes of them at the last frame, and the last measurement's deviation:
    heads that move as the model says, measured with the noise that it is given.
    """
    rng = np.random.default_rng(seed)
    gain = np.array([SECONDS**2 / 2, SECONDS])
    for _ in range(RUNS):
        truth = np.concatenate(
            [MIDDLE - ROOT @ rng.standard_normal(7), WIDE.max_speed / 3**0.5 * rng.normal(size=3)]
        )
        state = initialize(MIDDLE, NOISE, WIDE)
        for _ in range(FRAMES):
            push = WIDE.acceleration_noise * rng.standard_normal(3)
            truth[:3] += SECONDS * truth[7:] + gain[0] * push
            truth[7:] += gain[1] * push
            truth[3:7] += DRIFTS * rng.standard_normal(4)
            measured = truth[:7] + ROOT @ rng.standard_normal(7)
            state = predict(kernels, state, SECONDS, WIDE)
            off = mahalanobis_distance(state, measured[:3], NOISE[:3, :3])
            state = correct(kernels, state, measured, NOISE, WIDE)
        yield truth, state, off


def within(total: float, degrees: int) -> bool:
    """Whether a sum of squares can be that of so many unit Gaussians."""
    return bool(stats.chi2.ppf(CHANCE / 2, degrees) < total < stats.chi2.ppf(1 - CHANCE / 2, degrees))


def test_starts_where_it_is_measured():
    """It starts at the measurement with its noise, at rest, with a velocity that a walk can have; the printed
    form has seven states and no velocity.
    """
    state = initialize(VALUES, NOISE, P)
    np.testing.assert_array_equal(state.mean, [*VALUES, 0, 0, 0])
    np.testing.assert_array_equal(state.covariance[:7, :7], NOISE)
    np.testing.assert_allclose(state.covariance[7:, 7:], P.max_speed**2 / 3 * np.eye(3))
    assert not state.covariance[:7, 7:].any()
    np.testing.assert_array_equal(state.position, VALUES[:3])
    np.testing.assert_array_equal(state.color, VALUES[3:6])
    np.testing.assert_array_equal(state.position_covariance, NOISE[:3, :3])
    printed = initialize(VALUES, NOISE, CONSTANT)
    assert (printed.mean.shape, printed.covariance.shape) == ((7,), (7, 7))


@pytest.mark.parametrize("seconds", [1 / 60, 1 / 30, 0.5])
def test_process_noise_is_that_of_an_acceleration(seconds, kernels):
    """What a step adds to certain knowledge is g g^T agility^2, g = (t^2 / 2, t): an acceleration that holds
    for the step, independent along each axis.
    """
    certain = HeadFilter(np.concatenate([VALUES, np.zeros(3)]), np.zeros((10, 10)))
    _, added = predict(kernels, certain, seconds, P)
    g = np.array([seconds**2 / 2, seconds]) * P.acceleration_noise
    for axis in range(3):
        own = [axis, MEASUREMENT_SIZE + axis]
        np.testing.assert_allclose(added[np.ix_(own, own)], np.outer(g, g), rtol=1e-12)
        added[np.ix_(own, own)] = 0
    np.testing.assert_allclose(np.diag(added)[3:7], DRIFTS**2, rtol=1e-12)
    np.testing.assert_array_equal(added - np.diag(np.diag(added)), 0)


def test_a_velocity_moves_the_head(kernels):
    """A step moves the position by velocity times seconds, colors and velocity not at all."""
    velocity = np.array([0.3, -0.6, 0.9])
    moving = HeadFilter(np.concatenate([VALUES, velocity]), np.eye(10))
    mean, _ = predict(kernels, moving, 0.1, P)
    np.testing.assert_allclose(mean[:3], VALUES[:3] + 0.1 * velocity, rtol=1e-14)
    np.testing.assert_array_equal(mean[3:], [*VALUES[3:], *velocity])


def test_printed_motion_only_spreads(kernels):
    """(6) leaves the mean, and adds to the position's variances the square of the greatest displacement."""
    mean, covariance = predict(kernels, initialize(VALUES, NOISE, CONSTANT), 0.1, CONSTANT)
    np.testing.assert_array_equal(mean, VALUES)
    expected = np.diag([(0.1 * CONSTANT.max_speed) ** 2] * 3 + (DRIFTS**2).tolist())
    np.testing.assert_allclose(covariance - NOISE, expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("z", "speed", "expected"), [(0.5, -9.0, P.near), (5.9, 9.0, P.far)])
def test_a_prediction_stays_in_the_working_range(z, speed, expected, kernels):
    """A head that rushes at the cameras, or away, is predicted at near, or at far, not behind them."""
    values = np.array([0, 0, z, *VALUES[3:], 0, 0, speed])
    assert predict(kernels, HeadFilter(values, np.eye(10)), 0.1, P).position[2] == expected


@pytest.mark.parametrize(("scale", "expected"), [(0.1, P.near), (-1.0, P.near), (4.0, P.far)])
def test_a_correction_stays_in_the_working_range(scale, expected, kernels):
    """Where the distance is all but unknown, X and Y, with which it goes together, would move it to the
    camera, behind it, or far away, though it is predicted and measured between near and far.
    """
    covariance = 1e-6 * np.eye(10)
    covariance[:3, :3] += 100 * np.outer(VALUES[:3], VALUES[:3])
    state = HeadFilter(np.concatenate([VALUES, np.zeros(3)]), covariance)
    measured = VALUES * [scale, scale, 1, 1, 1, 1, 1]
    noise = np.diag([1e-6, 1e-6, 1e6, 1, 1, 1, 1])
    assert correct(kernels, state, measured, noise, P).position[2] == expected


def test_deviations_have_their_closed_form():
    """With independent errors the deviation is the root of the sum of squares over the summed variances, and
    colors don't count.
    """
    state = initialize(VALUES, np.diag([0.01, 0.04, 0.09, 1, 1, 1, 1]), P)
    off = np.array([0.3, -0.5, 1.1, 99.0, 99.0, 99.0, 9.0])
    noise = np.diag([0.08, 0.21, 0.16, 1, 1, 1, 1])
    expected = math.sqrt(0.3**2 / 0.09 + 0.5**2 / 0.25 + 1.1**2 / 0.25)
    noise = noise[:3, :3]
    assert mahalanobis_distance(state, (VALUES + off)[:3], noise) == pytest.approx(expected, rel=1e-12)
    assert mahalanobis_distance(state, VALUES[:3], noise) == 0


@pytest.mark.parametrize("motion", ["velocity", "constant"])
def test_what_is_unknown_of_who_is_away_settles(motion, kernels):
    """However long a head is only predicted, its position is unknown by a hundred meters at most, and its
    velocity in proportion; what is unknown of its colors grows on.
    """
    p, deviations = Params(motion=motion), []
    state = initialize(VALUES, NOISE, p)
    for _ in range(300):
        state = predict(kernels, state, 60.0, p)
        deviations.append(np.sqrt(np.diag(state.covariance)))
    before, after = np.delete(deviations[199], range(3, 7)), np.delete(deviations[299], range(3, 7))
    assert after[:3].max() == pytest.approx(100)
    np.testing.assert_allclose(after, before, rtol=1e-3)
    assert (deviations[299][3:7] > 1.1 * deviations[199][3:7]).all()


@pytest.mark.parametrize("motion", ["velocity", "constant"])
def test_a_correction_weighs_by_noise(motion, kernels):
    """Equal variances meet half way with half of it; a useless measurement changes nothing, a perfect one
    all.
    """
    state = initialize(VALUES, np.eye(7), Params(motion=motion))
    there = VALUES + 1
    half = correct(kernels, state, there, np.eye(7), WIDE)
    np.testing.assert_allclose(half.mean[:7], VALUES + 0.5, rtol=1e-12)
    np.testing.assert_allclose(half.covariance[:7, :7], np.eye(7) / 2, rtol=0, atol=1e-12)
    np.testing.assert_allclose(
        correct(kernels, state, there, 1e12 * np.eye(7), WIDE).mean, state.mean, rtol=0, atol=1e-9
    )
    sure = correct(kernels, state, there, 1e-12 * np.eye(7), WIDE)
    np.testing.assert_allclose(sure.mean[:7], there, rtol=0, atol=1e-9)


def test_coasting_slows_down():
    """Without a measurement the velocity fades and nothing else changes, nor does the prediction itself."""
    moving = HeadFilter(np.concatenate([VALUES, [1.0, -2.0, 3.0]]), np.eye(10))
    slowed = coast(moving, SECONDS)
    np.testing.assert_array_equal(
        slowed.mean, [*VALUES, COASTING_FACTOR, -2 * COASTING_FACTOR, 3 * COASTING_FACTOR]
    )
    np.testing.assert_array_equal(slowed.covariance, moving.covariance)
    assert moving.mean[7] == 1
    np.testing.assert_array_equal(coast(initialize(VALUES, NOISE, CONSTANT), SECONDS).mean, VALUES)


def test_errors_are_as_large_as_it_says(kernels):
    """On heads that move as the model says, measured as it says, the normalized errors squared of position,
    velocity, colors and of all ten together are chi-square, and so are the surprises before.
    """
    found = list(simulated(kernels, 0))
    off = [truth - state.mean for truth, state, _ in found]
    for chosen in (slice(0, 3), slice(7, 10), slice(3, 6), slice(None)):
        squares = [
            each[chosen] @ np.linalg.solve(state.covariance[chosen, chosen], each[chosen])
            for each, (_, state, _) in zip(off, found, strict=True)
        ]
        assert within(sum(squares), RUNS * len(off[0][chosen]))
    assert within(sum(surprise**2 for *_, surprise in found), 3 * RUNS)


def test_errors_have_no_bias(kernels):
    """The mean error over these runs is 0 in each number, by its own deviation, 4 of a mean's at most."""
    off = [
        (truth - state.mean) / np.sqrt(np.diag(state.covariance)) for truth, state, _ in simulated(kernels, 1)
    ]
    assert np.abs(np.mean(off, axis=0)).max() < 4 / RUNS**0.5


def test_wrong_noise_would_be_seen(kernels, monkeypatch):
    """The check above has teeth: a filter that thinks heads half as agile doesn't pass it."""
    slow = Params(acceleration_noise=P.acceleration_noise / 2, far=WIDE.far)
    monkeypatch.setattr(head_filter, "predict", lambda k, state, seconds, _: predict(k, state, seconds, slow))
    squares = []
    rng = np.random.default_rng(2)
    for _ in range(RUNS):
        truth, state = np.concatenate([MIDDLE, np.zeros(3)]), initialize(MIDDLE, NOISE, WIDE)
        for _ in range(FRAMES):
            push = P.acceleration_noise * rng.standard_normal(3)
            truth[:3] += SECONDS * truth[7:] + SECONDS**2 / 2 * push
            truth[7:] += SECONDS * push
            state = head_filter.predict(kernels, state, SECONDS, WIDE)
            state = correct(kernels, state, truth[:7] + ROOT @ rng.standard_normal(7), NOISE, WIDE)
        off = truth[7:] - state.mean[7:]
        squares.append(off @ np.linalg.solve(state.covariance[7:, 7:], off))
    assert not within(sum(squares), 3 * RUNS)


def test_a_steady_walk_is_followed_without_lag(kernels):
    """Behind a head at constant speed the constant velocity lags under a hundredth of a frame after 60, the
    printed constant position several frames with the same noise of the disparity.
    """
    lags = []
    for p in (P, Params(motion="constant", max_speed=0.3)):
        state, speed = initialize(VALUES, NOISE, p), np.array([0.5, 0.2, 0.7])
        for frame in range(1, 61):
            measured = VALUES + np.concatenate([frame * SECONDS * speed, np.zeros(4)])
            state = correct(kernels, predict(kernels, state, SECONDS, p), measured, NOISE, p)
        lags.append(np.linalg.norm(measured[:3] - state.position) / (SECONDS * np.linalg.norm(speed)))
    assert lags[0] < 0.01
    assert lags[1] > 0.5


@pytest.mark.parametrize("motion", ["velocity", "constant"])
def test_covariances_stay_covariances(motion, kernels):
    """Through 300 frames, seen and missed, a covariance is symmetric and positive definite."""
    p = Params(motion=motion)
    state = initialize(VALUES, NOISE, p)
    for frame in range(300):
        state = predict(kernels, state, SECONDS, p)
        state = coast(state, SECONDS) if frame // 40 % 2 else correct(kernels, state, VALUES, NOISE, p)
        np.testing.assert_array_equal(state.covariance, state.covariance.T)
        assert np.linalg.eigvalsh(state.covariance).min() > 0
