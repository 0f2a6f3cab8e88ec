# SPDX-License-Identifier: MIT
"""The Kalman filter of Moreno et al. 2002, section 4: position, the model's mean color, the intersection."""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams

Floats = NDArray[np.float64]

MEASURED = (
    7  # numbers of (7): X, Y, Z, three colors, the intersection; velocity, where it is there, comes after
)
COLOR_DRIFT = 2.0  # levels a frame, standard deviation of the model's mean
INTERSECTION_DRIFT, INTERSECTION_NOISE = 1.0, 0.1  # section 4.1: unity; ours
SLOWED = 0.9  # of the velocity, a frame without a measurement


class HeadFilter(NamedTuple):
    """mean (7,) or (10,): X, Y, Z, metres; mean color, levels; (1); velocity, m/s. And its covariance."""

    mean: Floats
    covariance: Floats

    @property
    def position(self) -> Floats:
        """(3,) metres."""
        return self.mean[:3]

    @property
    def color(self) -> Floats:
        """(3,) mean of the model's colors."""
        return self.mean[3:6]

    @property
    def uncertainty(self) -> Floats:
        """(3, 3) of the position."""
        return self.covariance[:3, :3]


def start(measured: Floats, noise: Floats, p: StereoHeadParams) -> HeadFilter:
    """At rest at a measurement (7,), whose covariance (7, 7) is that of the noise."""
    if p.motion == "constant":
        return HeadFilter(measured, noise)
    covariance = np.zeros((10, 10))
    covariance[:MEASURED, :MEASURED] = noise
    covariance[MEASURED:, MEASURED:] = p.fastest**2 / 3 * np.eye(3)
    return HeadFilter(np.concatenate([measured, np.zeros(3)]), covariance)


def predict(k: Kernels, state: HeadFilter, seconds: float, p: StereoHeadParams) -> HeadFilter:
    """(6), or with the velocity that the head has."""
    speed = p.fastest if p.motion == "constant" else p.agility
    dynamics = _dynamics(len(state.mean), seconds, speed)
    mean, covariance = k.kalman_predict(state.mean, state.covariance, *dynamics)
    mean[2] = min(max(mean[2], p.near), p.far)
    return HeadFilter(mean, covariance)


def deviations(predicted: HeadFilter, measured: Floats, noise: Floats) -> float:
    """How far a measurement (7,) is from the expected position: its Mahalanobis distance."""
    off = (measured[:3] - predicted.position).tolist()
    xx, xy, xz, _, yy, yz, _, _, zz = (predicted.uncertainty + noise[:3, :3]).ravel().tolist()
    # By Cholesky's three steps, by hand: numpy.linalg takes longer than the whole correction.
    a = xx**0.5
    b, c = xy / a, xz / a
    d = (yy - b * b) ** 0.5
    e = (yz - b * c) / d
    f = (zz - c * c - e * e) ** 0.5
    u = off[0] / a
    v = (off[1] - b * u) / d
    w = (off[2] - c * u - e * v) / f
    return math.sqrt(u * u + v * v + w * w)


def correct(k: Kernels, predicted: HeadFilter, measured: Floats, noise: Floats) -> HeadFilter:
    """(8): with a measurement (7,) and its covariance (7, 7)."""
    chosen = np.eye(MEASURED, len(predicted.mean))
    mean, covariance, *_ = k.kalman_update(predicted.mean, predicted.covariance, measured, chosen, noise)
    return HeadFilter(mean, covariance)


def coasted(predicted: HeadFilter) -> HeadFilter:
    """Without a measurement: it slows down."""
    mean = predicted.mean.copy()
    mean[MEASURED:] *= SLOWED
    return HeadFilter(mean, predicted.covariance)


@lru_cache(maxsize=16)
def _dynamics(size: int, seconds: float, most: float) -> tuple[Floats, Floats]:
    """F and Q of a state of 7 numbers, that moves at most so many m/s, or 10, by at most so many m/s²."""
    transition, noise = np.eye(size), np.zeros((size, size))
    places, velocities = np.arange(3), np.arange(MEASURED, size)
    noise[range(3, MEASURED), range(3, MEASURED)] = [COLOR_DRIFT**2] * 3 + [INTERSECTION_DRIFT**2]
    if size == MEASURED:
        noise[places, places] = (most * seconds) ** 2  # "the maximum displacement that we expect"
        return transition, noise
    transition[places, velocities] = seconds
    power = most**2
    noise[places, places] = power * seconds**4 / 4
    noise[places, velocities] = noise[velocities, places] = power * seconds**3 / 2
    noise[velocities, velocities] = power * seconds**2
    return transition, noise
