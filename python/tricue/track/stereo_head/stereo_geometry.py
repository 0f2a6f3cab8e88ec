# SPDX-License-Identifier: MIT
"""What a rectified pair of cameras knows of depth: projection, its inverse, and the noise of that."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import StereoRig
from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams

Floats = NDArray[np.float64]

LEAST_NOISE = 1e-4  # metres, where a polynomial has a zero
SAMPLES = 64  # of the working range, that the cubic polynomials are fitted to


class StereoGeometry(NamedTuple):
    """rig: (5,) fx, fy, cx, cy, pixels, and the baseline, metres. shape: of its images."""

    rig: Floats
    shape: tuple[int, ...]

    @classmethod
    def of(cls, rig: StereoRig) -> "StereoGeometry":
        """The numbers of a rig."""
        camera = rig.intrinsics
        numbers = np.array([camera.fx, camera.fy, camera.cx, camera.cy, rig.baseline])
        return cls(numbers, (camera.height, camera.width))

    def disparity(self, z: float) -> float:
        """Pixels, at a distance in metres."""
        return float(self.rig[0] * self.rig[4] / z)

    def project(self, position: Floats) -> tuple[float, float, float]:
        """Box coordinates x, y and disparity, pixels, of a point (3,) in metres."""
        x, y, z = position.tolist()
        fx, fy, cx, cy, baseline = self.rig.tolist()
        return fx * x / z + cx + 0.5, fy * y / z + cy + 0.5, fx * baseline / z

    def ellipse(self, position: Floats, size: tuple[float, float]) -> tuple[float, float, float, float]:
        """Centre and semi-axes, pixels, of an upright ellipse of a size in metres at a point (3,)."""
        x, y, _ = self.project(position)
        z = float(position[2])
        return x, y, size[0] / 2 * float(self.rig[0]) / z, size[1] / 2 * float(self.rig[1]) / z

    def size(self, minor: float, major: float, z: float) -> tuple[float, float]:
        """Width and height in metres of an ellipse, semi-axes in pixels, at a distance."""
        return 2 * minor * z / float(self.rig[0]), 2 * major * z / float(self.rig[1])

    def point(
        self, k: Kernels, x: float, y: float, disparity: float, step: int, p: StereoHeadParams
    ) -> tuple[Floats, Floats]:
        """(3,) metres of a place in box coordinates with a disparity, and its covariance (3, 3)."""
        place = p.place_noise * step
        variances = np.array([place**2, place**2, p.disparity_noise**2])
        points, covariances = k.back_project(
            np.array([[x - 0.5, y - 0.5, disparity]]), variances, self.rig[:4], float(self.rig[4])
        )
        if p.noise == "polynomial":
            return points[0], np.diag(_cubic_noise(self, points[0], p) ** 2)
        return points[0], covariances[0]


def _cubic_noise(geometry: StereoGeometry, point: Floats, p: StereoHeadParams) -> Floats:
    """e of (9), (3,) metres: what an error of the disparity does to each coordinate, by cubic polynomials."""
    errors = [np.polyval(each, value) for each, value in zip(polynomials(geometry, p), point, strict=True)]
    return np.asarray(np.abs(errors)) + LEAST_NOISE


def polynomials(geometry: StereoGeometry, p: StereoHeadParams) -> list[Floats]:
    """Three times four coefficients a_i0 .. a_i3 of (9), fitted to the back-projection in the working range.

    X and Y are those of the image's rim, in proportion to Z: what figure 2 shows.
    """
    fx, fy, _, _, baseline = geometry.rig.tolist()
    z = np.linspace(p.near, p.far, SAMPLES)
    error = z * z / (fx * baseline) * p.disparity_noise
    height, width = geometry.shape[:2]
    fits = []
    for slope in (width / 2 / fx, height / 2 / fy):
        along = np.concatenate([-slope * z[::-1], slope * z])
        fits.append(np.polyfit(along, np.concatenate([slope * error[::-1], slope * error]), 3))
    return [*fits, np.polyfit(z, error, 3)]
