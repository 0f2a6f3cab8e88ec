# SPDX-License-Identifier: MIT
"""The geometry of a rectified stereo pair: projection, triangulation, and the noise of a position."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.camera.rig import StereoRig
from tricue.kernels import Kernels
from tricue.track.base.stereo_noise import measurement_variances
from tricue.track.stereo_head.params import StereoHeadParams

Point = tuple[float, float, float]  # meters

MIN_POSITION_NOISE = 1e-4  # meters, for zeros of a polynomial
POLYNOMIAL_SAMPLES = 64  # of the working range, for fitting the cubic polynomials


class StereoGeometry(NamedTuple):
    """rig: (5,) fx, fy, cx, cy, pixels, and the baseline, meters. shape: height and width of its images.

    numbers: the rig as a tuple, because scalar arithmetic is faster. camera: (4,), without the baseline.
    """

    rig: Floats
    shape: tuple[int, ...]
    numbers: tuple[float, ...]
    camera: Floats

    @classmethod
    def of(cls, rig: StereoRig) -> "StereoGeometry":
        """The geometry of a rig."""
        camera = rig.intrinsics
        five = np.append(camera.vector, rig.baseline)
        return cls(five, (camera.height, camera.width), tuple(five.tolist()), five[:4])

    def disparity(self, z: float) -> float:
        """The disparity at a distance z, pixels; z in meters."""
        return self.numbers[0] * self.numbers[4] / z

    def project(self, position: Point) -> tuple[float, float, float]:
        """x, y in box coordinates and disparity, all in pixels, of a position."""
        x, y, z = position
        fx, fy, cx, cy, baseline = self.numbers
        return fx * x / z + cx + 0.5, fy * y / z + cy + 0.5, fx * baseline / z

    def ellipse(self, position: Point, size: tuple[float, float]) -> tuple[float, float, float, float]:
        """Center and semi-axes, pixels, of an upright ellipse with a size, meters, at a position."""
        x, y, z = position
        fx, fy, cx, cy, _ = self.numbers
        return fx * x / z + cx + 0.5, fy * y / z + cy + 0.5, size[0] / 2 * fx / z, size[1] / 2 * fy / z

    def width(self, size: tuple[float, float], z: float) -> float:
        """The width, pixels, of an ellipse with a size, meters, at a distance z, meters."""
        return size[0] * self.numbers[0] / z

    def size(self, minor: float, major: float, z: float) -> tuple[float, float]:
        """Width and height, meters, of an ellipse at a distance z, meters; semi-axes in pixels."""
        return 2 * minor * z / float(self.rig[0]), 2 * major * z / float(self.rig[1])

    def triangulate(
        self, k: Kernels, x: float, y: float, disparity: float, step: int, p: StereoHeadParams
    ) -> tuple[Point, Floats]:
        """The position at x, y (box coordinates) with a disparity, and its covariance (3, 3).

        step: pixels per cell, the unit of ``place_noise``.
        """
        measured = np.array([[x - 0.5, y - 0.5, disparity]])
        variances = measurement_variances(p.place_noise * step, p.disparity_noise)
        points, covariances = k.back_project(measured, variances, self.camera, self.numbers[4])
        x, y, z = points.tolist()[0]
        if p.noise_model == "polynomial":
            return (x, y, z), np.diag(_cubic_noise(self, (x, y, z), p) ** 2)
        return (x, y, z), covariances[0]


def _cubic_noise(geometry: StereoGeometry, point: Point, p: StereoHeadParams) -> Floats:
    """(3,) meters: the error of each coordinate as a cubic polynomial of it, e of equation (9)."""
    errors = [
        np.polyval(each, value) for each, value in zip(fit_polynomials(geometry, p), point, strict=True)
    ]
    return np.asarray(np.abs(errors)) + MIN_POSITION_NOISE


def fit_polynomials(geometry: StereoGeometry, p: StereoHeadParams) -> tuple[Floats, Floats, Floats]:
    """The coefficients a_i0 .. a_i3 of (9) for X, Y and Z, (4,) each, highest power first.

    They are fitted to the errors of the back-projection between near and far.

    X and Y are those of the image's border, in proportion to Z, as in figure 2.
    """
    return _fit_polynomials(geometry.numbers, geometry.shape, p.near, p.far, p.disparity_noise)


@lru_cache(maxsize=16)
def _fit_polynomials(
    rig: tuple[float, ...], shape: tuple[int, ...], near: float, far: float, disparity_noise: float
) -> tuple[Floats, Floats, Floats]:
    """They don't change from frame to frame, and fitting takes longer than the rest of an update."""
    fx, fy, _, _, baseline = rig
    z = np.linspace(near, far, POLYNOMIAL_SAMPLES)
    error = z * z / (fx * baseline) * disparity_noise

    def fit_at_border(slope: float) -> Floats:
        along = np.concatenate([-slope * z[::-1], slope * z])
        return np.polyfit(along, np.concatenate([slope * error[::-1], slope * error]), 3)

    height, width = shape[:2]
    return fit_at_border(width / 2 / fx), fit_at_border(height / 2 / fy), np.polyfit(z, error, 3)
