# SPDX-License-Identifier: MIT
"""The target's position in meters: a Kalman filter over position and velocity in the camera's frame."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.camera.box import Box
from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels
from tricue.track.base.params import Params, parameter
from tricue.track.base.position_limit import limit_covariance
from tricue.track.fused.depth_sources import ExpectedDepth
from tricue.track.fused.experts.depth import DEPTH_SAMPLES, DepthMeasurement
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.target import Target

LATERAL_NOISE = 0.02  # standard deviation of the target's center, as a share of its side
MIN_POSITION_Z = 0.05  # meters in front of the camera
MAX_POSITION_SIGMA = 3.0  # meters, in the expected depth
LATERAL, AHEAD = [0, 1, 3, 4], [2, 5]  # indices of X, Y and their velocities, and of Z and its velocity
MOVING = np.arange(6)  # indices of position and velocity: the whole state
MAX_INNOVATION = 2.0  # standard deviations; a larger innovation widens the state's covariance
POSITION_MATRIX = np.eye(3, 6)  # the measurement matrix: from a state to the measured position
SHARED_DEPTH_ERROR = 0.6  # of the depth spread, standard deviation; fitted: docs/fused-figures.md
SHARED_LATERAL_ERROR = 0.05  # of the side of a track's box, standard deviation; fitted: docs/fused-figures.md
MISSED_MEAN_FACTORS = np.array([1, 1, 1, 0.8, 0.8, 0.8])  # of position and velocity, in a missed frame


@dataclass(frozen=True, kw_only=True)
class PositionParams(Params):
    """The parameters of the position in meters."""

    acceleration_noise: float = parameter(
        4.0,
        unit="m/s²",
        source=PROTOTYPE,
        above=0,
        high=1e6,
        doc="standard deviation of the acceleration",
        was="agility",
    )
    max_speed: float = parameter(
        2.0,
        unit="m/s",
        source=PROTOTYPE,
        above=0,
        high=1e6,
        doc="highest speed that is assumed at the first measurement",
        was="fastest",
    )


class PositionFilter(NamedTuple):
    """A Gaussian over position and velocity.

    mean: (6,) X, Y, Z in meters in the camera's frame (x right, y down, z forward), and their velocities in
    m/s. covariance: (6, 6).
    """

    mean: Floats
    covariance: Floats

    @classmethod
    def at_rest(cls, point: Floats, noise: Floats, p: PositionParams) -> "PositionFilter":
        """A state at rest at a measured point (3,) with covariance ``noise`` (3, 3)."""
        covariance = np.zeros((6, 6))
        covariance[:3, :3] = noise
        covariance[3:, 3:] = p.max_speed**2 / 3 * np.eye(3)
        return cls(np.concatenate([point, np.zeros(3)]), covariance)

    @property
    def position(self) -> Floats:
        """The position (3,), meters; a copy."""
        return np.array(self.mean[:3])

    @property
    def position_covariance(self) -> Floats:
        """The position's covariance (3, 3), m², as if measurement errors were independent; a copy."""
        return np.array(self.covariance[:3, :3])

    def error_covariance(self, spread: float) -> Floats:
        """The position's covariance (3, 3), m², including errors that consecutive frames share.

        spread: standard deviation of the target's depths, meters. Many frames show the same part of a thick
        target, and the same background is measured with it. The resulting error lies along the line of sight
        and doesn't average out, so it is added to the filter's.
        """
        x, y, z = self.mean[:3].tolist()
        depth = max(z, MIN_POSITION_Z)
        ray = x / depth, y / depth, z / depth
        shared = (SHARED_DEPTH_ERROR * spread) ** 2
        error: Floats = self.covariance[:3, :3] + np.array([[shared * (a * b) for b in ray] for a in ray])
        return error

    def expected_depth(self, spread: float) -> ExpectedDepth:
        """The expected depth. spread: standard deviation of the depths of the target's surface, meters."""
        sigma = min(math.sqrt(float(self.covariance[2, 2])), MAX_POSITION_SIGMA)
        z = max(float(self.mean[2]), MIN_POSITION_Z)
        return ExpectedDepth(z, float(np.hypot(sigma, spread)))

    def move_like(self, other: "PositionFilter") -> "PositionFilter":
        """The state with the velocity of another."""
        mean, covariance = np.concatenate([self.mean[:3], other.mean[3:]]), np.zeros((6, 6))
        covariance[:3, :3], covariance[3:, 3:] = self.covariance[:3, :3], other.covariance[3:, 3:]
        return PositionFilter(mean, covariance)

    def stop(self, p: PositionParams) -> "PositionFilter":
        """The state with an unknown velocity, as at the first measurement."""
        return PositionFilter.at_rest(self.mean[:3], self.covariance[:3, :3], p)

    def slow_down(self) -> "PositionFilter":
        """The state with less velocity, after a frame in which the target was missed."""
        return PositionFilter(self.mean * MISSED_MEAN_FACTORS, self.covariance)

    def predict(self, k: Kernels, seconds: float, p: PositionParams) -> "PositionFilter":
        """The state so many seconds later, under white acceleration noise.

        Bar-Shalom, Li and Kirubarajan 2001, section 6.3.2. :func:`limit_covariance` limits its uncertainty.
        """
        dynamics = _dynamics(seconds, p.acceleration_noise)
        mean, covariance = k.kalman_predict(self.mean, self.covariance, *dynamics)
        if mean[2] < MIN_POSITION_Z:
            mean[2], mean[5] = MIN_POSITION_Z, 0.0
        return PositionFilter(mean, limit_covariance(covariance, MOVING))

    def distance(self, point: Floats, noise: Floats) -> float:
        """The Mahalanobis distance to a measured point (3,) with covariance ``noise`` (3, 3)."""
        off = point - self.mean[:3]
        return float(np.sqrt(off @ np.linalg.solve(self.covariance[:3, :3] + noise, off)))

    def correct(self, k: Kernels, point: Floats, noise: Floats) -> "PositionFilter":
        """The state corrected by a measured point (3,) with covariance ``noise`` (3, 3).

        A large innovation shows that the motion model failed, so the covariance is first widened to match it.
        """
        mean, covariance, *_ = k.kalman_update(
            self.mean, self.covariance, point, POSITION_MATRIX, noise, MAX_INNOVATION
        )
        return PositionFilter(mean, covariance)

    def correct_bearing(self, k: Kernels, target: Target, camera: Intrinsics) -> "PositionFilter":
        """The state corrected by the target's place in the picture alone; depth doesn't change.

        Depth is treated as independent of X and Y. Otherwise, errors of the motion model to the right or down
        would change it.
        """
        z, variance = max(float(self.mean[2]), MIN_POSITION_Z), (LATERAL_NOISE * target.side) ** 2
        x, y = (target.x - 0.5 - camera.cx) / camera.fx, (target.y - 0.5 - camera.cy) / camera.fy
        noise = variance * np.diag([(z / camera.fx) ** 2, (z / camera.fy) ** 2])
        noise += self.covariance[2, 2] * np.diag([x * x, y * y])
        lateral, ahead = np.ix_(LATERAL, LATERAL), np.ix_(AHEAD, AHEAD)
        mean, covariance = self.mean.copy(), np.zeros((6, 6))
        mean[LATERAL], covariance[lateral], *_ = k.kalman_update(
            mean[LATERAL],
            self.covariance[lateral],
            np.array([x * z, y * z]),
            np.eye(2, 4),
            noise,
            MAX_INNOVATION,
        )
        covariance[ahead] = self.covariance[ahead]
        return PositionFilter(mean, covariance)


@lru_cache(maxsize=64)
def _dynamics(seconds: float, acceleration_noise: float) -> tuple[Floats, Floats]:
    """The transition matrix F and the process noise Q, (6, 6)."""
    transition, one = np.eye(6), np.eye(3)
    transition[:3, 3:] = seconds * one
    quarter, half = seconds**4 / 4 * one, seconds**3 / 2 * one
    noise = acceleration_noise**2 * np.block([[quarter, half], [half, seconds**2 * one]])
    return transition, noise


def back_project(
    observation: PictureObservation, target: Target, depth: DepthMeasurement
) -> tuple[Floats, Floats]:
    """A target's position (3,), meters in the camera's frame, and its covariance (3, 3)."""
    assert observation.depth_source is not None, "it was measured"
    camera, z = observation.camera, depth.z
    disparity = camera.fx / z  # the disparity at depth z of a stereo pair with a baseline of 1 m
    depth_noise = disparity / z * observation.depth_source.noise(z, target.side / DEPTH_SAMPLES)
    lateral_noise = LATERAL_NOISE * target.side
    k, place = observation.k, np.array([[target.x - 0.5, target.y - 0.5, disparity]])
    variances = np.array([lateral_noise**2, lateral_noise**2, depth_noise**2])
    points, covariances = k.back_project(place, variances, camera.vector, 1.0)
    return points[0], covariances[0].reshape(3, 3)


def lateral_variances(target: Target, box: Box, z: float, camera: Intrinsics) -> tuple[float, float]:
    """The variances, m², of a position's errors to the right and down that don't average out, at depth z.

    A position that is off the target's true center stays off it by the same amount in many frames. It is the
    center of the target's own box; a track's ``box`` may have another center, and either may be the true one.
    """
    variance, (x, y) = SHARED_LATERAL_ERROR**2 * box.width * box.height, box.center
    right = (variance + (x - target.x) ** 2) * (z / camera.fx) ** 2
    return right, (variance + (y - target.y) ** 2) * (z / camera.fy) ** 2
