# SPDX-License-Identifier: MIT
"""The target's position in metres: a Kalman filter over place and velocity in the camera's frame."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.fused.experts.depth import GRID, Measured
from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Sight
from tricue.track.fused.view import Target

Floats = NDArray[np.float64]

LATERAL = 0.02  # of the target's side, standard deviation of its place
NEAREST = 0.05  # metres before the camera
SURPRISING = 2.0  # standard deviations of a measurement from what was foreseen
POSITION = np.eye(3, 6)
SLOWING = np.array([1, 1, 1, 0.8, 0.8, 0.8])


class Space(NamedTuple):
    """mean (6,): X, Y, Z metres, x right, y down, z forward; and their velocities, m/s. covariance (6, 6)."""

    mean: Floats
    covariance: Floats

    @classmethod
    def start(cls, point: Floats, noise: Floats, p: FusedParams) -> "Space":
        """At rest at a measured point (3,) with its covariance (3, 3)."""
        covariance = np.zeros((6, 6))
        covariance[:3, :3] = noise
        covariance[3:, 3:] = p.fastest**2 / 3 * np.eye(3)
        return cls(np.concatenate([point, np.zeros(3)]), covariance)

    @property
    def position(self) -> Floats:
        """(3,) metres."""
        return np.array(self.mean[:3])

    @property
    def uncertainty(self) -> Floats:
        """(3, 3) metres², of the position."""
        return np.array(self.covariance[:3, :3])

    def slowed(self) -> "Space":
        """Coming to rest, as nobody sees where it goes."""
        return Space(self.mean * SLOWING, self.covariance)

    def predicted(self, k: Kernels, seconds: float, p: FusedParams) -> "Space":
        """That much later, by a white acceleration (Bar-Shalom, Li and Kirubarajan 2001, section 6.3.2)."""
        mean, covariance = k.kalman_predict(self.mean, self.covariance, *_dynamics(seconds, p.agility))
        if mean[2] < NEAREST:
            mean[2], mean[5] = NEAREST, 0.0
        return Space(mean, covariance)

    def distance(self, point: Floats, noise: Floats) -> float:
        """Standard deviations from a measured point (3,) with its covariance (3, 3)."""
        off = point - self.mean[:3]
        return float(np.sqrt(off @ np.linalg.solve(self.covariance[:3, :3] + noise, off)))

    def corrected(self, k: Kernels, point: Floats, noise: Floats) -> "Space":
        """With a measured point (3,) and its covariance (3, 3); what surprises shows that the target does
        what wasn't foreseen, and widens the state to that.
        """
        wider = max(self.distance(point, noise) / SURPRISING, 1.0) ** 2
        mean, covariance, *_ = k.kalman_update(self.mean, wider * self.covariance, point, POSITION, noise)
        return Space(mean, covariance)


@lru_cache(maxsize=64)
def _dynamics(seconds: float, agility: float) -> tuple[Floats, Floats]:
    """F and Q, (6, 6)."""
    transition, one = np.eye(6), np.eye(3)
    transition[:3, 3:] = seconds * one
    quarter, half = seconds**4 / 4 * one, seconds**3 / 2 * one
    noise = agility**2 * np.block([[quarter, half], [half, seconds**2 * one]])
    return transition, noise


def locate(sight: Sight, target: Target, measured: Measured) -> tuple[Floats, Floats]:
    """A target's point (3,), metres in the camera's frame, and its covariance (3, 3)."""
    assert sight.ranger is not None, "it was measured"
    camera, z = sight.camera, measured.z
    disparity = camera.fx / z  # of a pair with a baseline of 1 m, which says the same as z
    depth = disparity / z * sight.ranger.noise(z, target.side / GRID)
    lateral = LATERAL * target.side
    k, at = sight.k, np.array([[target.x - 0.5, target.y - 0.5, disparity]])
    variances = np.array([lateral**2, lateral**2, depth**2])
    intrinsics = np.array([camera.fx, camera.fy, camera.cx, camera.cy])
    points, covariances = k.back_project(at, variances, intrinsics, 1.0)
    return points[0], covariances[0].reshape(3, 3)
