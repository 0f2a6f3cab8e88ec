# SPDX-License-Identifier: MIT
"""How far away pixels are: from a depth image, or from a stereo pair by matching."""

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import StereoRig
from tricue.kernels import Kernels
from tricue.track.fused.sight import Expected, Grid, Image, Plane

WINDOW = 7  # samples a side, compared in both images of a pair
NEARER, FARTHER = 16, 8  # samples of disparity round the expected one
WIDEST = 0.25  # of the image's width, the largest disparity that is looked for
MATCHING = 0.15  # samples, standard deviation of a disparity
COMMON = 0.005  # of the distance, standard deviation of a depth camera's pixel


class DepthImage(NamedTuple):
    """A depth camera's, (H, W) metres, NaN where nothing was measured."""

    depth: Plane

    @property
    def sharp(self) -> bool:
        """As in Ranger."""
        return True

    def metres(self, grid: Grid, side: int, around: Expected | None) -> Plane:
        """The pixels nearest to the middles of the squares."""
        x, y, unit = grid
        steps = (np.arange(side) + 0.5) * unit
        rows, columns = np.floor(y + steps).astype(int), np.floor(x + steps).astype(int)
        height, width = self.depth.shape
        inside = ((rows >= 0) & (rows < height))[:, None] & ((columns >= 0) & (columns < width))
        sampled = self.depth[rows.clip(0, height - 1)[:, None], columns.clip(0, width - 1)]
        metres: Plane = np.where(inside, sampled, np.float32(np.nan))
        return metres

    def posterior(
        self, k: Kernels, grid: Grid, side: int, expected: Expected, margin: float
    ) -> tuple[Plane, NDArray[np.uint8]]:
        """As in Ranger."""
        return k.depth_posterior(self.depth, *grid, side, side, *expected, margin)

    def noise(self, z: float, unit: float) -> float:
        """Grows with the distance."""
        return COMMON * z


class Pair(NamedTuple):
    """A rectified pair, (H, W, 3) BGR each, and its rig."""

    k: Kernels
    left: Image
    right: Image
    rig: StereoRig

    @property
    def sharp(self) -> bool:
        """Its windows reach over edges."""
        return False

    def metres(self, grid: Grid, side: int, around: Expected | None) -> Plane:
        """By sums of absolute differences (Moreno et al. 2002, section 3.2), between samples of both images.

        The right one is sampled where what is expected has the disparity 0.
        """
        x, y, unit = grid
        product = self.rig.intrinsics.fx * self.rig.baseline
        shift = 0.0 if around is None else product / around.z
        most = WIDEST * self.left.shape[1]
        first = 0 if around is None else -FARTHER
        last = int(np.ceil(most / unit)) if around is None else NEARER
        last = min(last, 4 * side)
        width = side + last
        place = np.array([[x - last * unit, y, width * unit, side * unit]])
        left = _gray(self.k.sample_windows(self.left, place, side, width)[0])
        right = _gray(self.k.sample_windows(self.right, place - [[shift, 0, 0, 0]], side, width)[0])
        region = (last, 0, width, side)
        found = self.k.sad_disparity(left, right, region, False, first, last, WINDOW, 15, True, 1)
        disparity = found * np.float32(unit) + np.float32(shift)
        disparity[~(disparity > 0)] = np.nan  # beyond infinity, or not found
        metres: Plane = np.float32(product) / disparity
        return metres

    def posterior(
        self, k: Kernels, grid: Grid, side: int, expected: Expected, margin: float
    ) -> tuple[Plane, NDArray[np.uint8]]:
        """As in Ranger."""
        metres = self.metres(grid, side, expected)
        return k.depth_posterior(metres, 0.0, 0.0, 1.0, side, side, *expected, margin)

    def noise(self, z: float, unit: float) -> float:
        """Of a disparity that is a share of a sample off."""
        return MATCHING * unit * z * z / (self.rig.intrinsics.fx * self.rig.baseline)


def _gray(samples: Image) -> Image:
    return cv2.cvtColor(samples, cv2.COLOR_BGR2GRAY)  # type: ignore[return-value]
