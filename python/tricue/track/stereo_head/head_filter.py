# SPDX-License-Identifier: MIT
"""The Kalman filter of Moreno et al. 2002, section 4: position, the model's mean color, the intersection."""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.base.coasting import velocity_kept
from tricue.track.base.position_limit import limit_covariance
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.stereo_geometry import Point

MEASUREMENT_SIZE = 7  # X, Y, Z, three colors, the intersection, as in equation (7); then the velocity, if any
INTERSECTION_DRIFT = 1.0  # standard deviation, section 4.1: unity
MOVING = np.array([0, 1, 2, 7, 8, 9])  # the position and, if a state has one, the velocity
COASTING_RATE = 30.0  # Hz
COASTING_FACTOR = 0.9  # of the velocity that is kept per frame without a measurement, at that rate


class HeadFilter(NamedTuple):
    """A Gaussian state: its mean, (7,) or (10,), and its covariance.

    The mean holds X, Y, Z, meters; the mean color, levels; the intersection (1); the velocity, m/s, if any.
    """

    mean: Floats
    covariance: Floats

    @property
    def position(self) -> Point:
        """The position in the left camera's frame, meters."""
        x, y, z = self.mean[:3].tolist()
        return x, y, z

    @property
    def color(self) -> Floats:
        """The mean color (3,) of the model."""
        return self.mean[3:6]

    @property
    def position_covariance(self) -> Floats:
        """The position's covariance (3, 3), square meters."""
        return self.covariance[:3, :3]


def initialize(measured: Floats, noise: Floats, p: StereoHeadParams) -> HeadFilter:
    """A filter at rest, started with a measurement (7,) and its covariance (7, 7)."""
    if p.motion == "constant":
        return HeadFilter(measured, noise)
    covariance = np.zeros((10, 10))
    covariance[:MEASUREMENT_SIZE, :MEASUREMENT_SIZE] = noise
    covariance[MEASUREMENT_SIZE:, MEASUREMENT_SIZE:] = p.max_speed**2 / 3 * np.eye(3)
    return HeadFilter(np.concatenate([measured, np.zeros(3)]), covariance)


def predict(k: Kernels, state: HeadFilter, seconds: float, p: StereoHeadParams) -> HeadFilter:
    """The prediction (6), or, with ``motion="velocity"``, by the velocity. Z stays between near and far, and
    the position's standard deviation below MAX_SIGMA.
    """
    limit = p.max_speed if p.motion == "constant" else p.acceleration_noise
    dynamics = _dynamics(len(state.mean), seconds, limit, p.color_drift)
    mean, covariance = k.kalman_predict(state.mean, state.covariance, *dynamics)
    _limit_distance(mean, p)
    return HeadFilter(mean, limit_covariance(covariance, MOVING[: len(mean) - MEASUREMENT_SIZE + 3]))


def mahalanobis_distance(predicted: HeadFilter, measured: Point, covariance: Floats) -> float:
    """The distance of a measured position, with its covariance (3, 3), from the predicted one, in standard
    deviations.
    """
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = predicted.position_covariance.tolist()
    (noise_xx, noise_xy, noise_xz), (_, noise_yy, noise_yz), (_, _, noise_zz) = covariance.tolist()
    (x, y, z), (there_x, there_y, there_z) = measured, predicted.position
    # The sum and Cholesky's three steps are written out, because NumPy is slower than the whole correction.
    a = math.sqrt(xx + noise_xx)
    b, c = (xy + noise_xy) / a, (xz + noise_xz) / a
    d = math.sqrt(yy + noise_yy - b * b)
    e = (yz + noise_yz - b * c) / d
    f = math.sqrt(zz + noise_zz - c * c - e * e)
    u = (x - there_x) / a
    v = (y - there_y - b * u) / d
    w = (z - there_z - c * u - e * v) / f
    return math.sqrt(u * u + v * v + w * w)


def correct(
    k: Kernels, predicted: HeadFilter, measured: Floats, noise: Floats, p: StereoHeadParams
) -> HeadFilter:
    """The correction, steps 3 to 5 of section 4.2.

    measured: (7,) the measurement, z of equation (8). noise: (7, 7) its covariance.

    Z stays between near and far: where distances are uncertain, X and Y, which depend on them, can move it
    beyond both the predicted and the measured one.
    """
    selection = _selection(len(predicted.mean))
    mean, covariance, *_ = k.kalman_update(predicted.mean, predicted.covariance, measured, selection, noise)
    _limit_distance(mean, p)
    return HeadFilter(mean, covariance)


def _limit_distance(mean: Floats, p: StereoHeadParams) -> None:
    """Move Z of a state's mean into the range from near to far."""
    z = mean.item(2)
    if not p.near <= z <= p.far:
        mean[2] = min(max(z, p.near), p.far)


@lru_cache(maxsize=2)
def _selection(size: int) -> Floats:
    """The matrix (7, size) that selects the measured part of a state."""
    return np.eye(MEASUREMENT_SIZE, size)


def coast(predicted: HeadFilter, seconds: float) -> HeadFilter:
    """The state after ``seconds`` without a measurement: the prediction, with a smaller velocity."""
    mean = predicted.mean.copy()
    mean[MEASUREMENT_SIZE:] *= velocity_kept(COASTING_FACTOR, seconds, COASTING_RATE)
    return HeadFilter(mean, predicted.covariance)


@lru_cache(maxsize=16)
def _dynamics(
    size: int, seconds: float, limit: float, color_drift: tuple[float, float, float]
) -> tuple[Floats, Floats]:
    """Transition F and process noise Q of a state with 7 or 10 numbers.

    limit: the maximum speed, m/s, with 7 numbers; the acceleration's standard deviation, m/s², with 10.
    """
    transition, noise = np.eye(size), np.zeros((size, size))
    positions, velocities = np.arange(3), np.arange(MEASUREMENT_SIZE, size)
    others = range(3, MEASUREMENT_SIZE)
    noise[others, others] = [*(each**2 for each in color_drift), INTERSECTION_DRIFT**2]
    if size == MEASUREMENT_SIZE:
        noise[positions, positions] = (limit * seconds) ** 2  # "the maximum displacement that we expect"
        return transition, noise
    transition[positions, velocities] = seconds
    power = limit**2
    noise[positions, positions] = power * seconds**4 / 4
    noise[positions, velocities] = noise[velocities, positions] = power * seconds**3 / 2
    noise[velocities, velocities] = power * seconds**2
    return transition, noise
