# SPDX-License-Identifier: MIT
"""The depth of pixels: read from a depth image, or measured by matching a stereo pair."""

import math
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats, Image, Plane
from tricue.camera.rig import StereoRig
from tricue.kernels import Kernels
from tricue.track.base.stereo_matching import StereoMatching

GATE_SIGMAS = 3  # standard deviations from the expected depth within which a pixel may be the target's
MAX_EXPECTED_SIGMA = 0.5  # meters; a less certain expected depth isn't used
MAX_OCCLUDER_MARGIN = 0.5  # meters
MIN_OCCLUDER_MARGIN = MAX_OCCLUDER_MARGIN / 2

SAD_MATCHING = StereoMatching(window=7, uniqueness=15)  # of samples
SAD_TOLERANCE = 1  # samples, of the left-right check
MAX_DISPARITY_ABOVE_EXPECTED = 16  # samples
MAX_DISPARITY_BELOW_EXPECTED = 8  # samples
MAX_DISPARITY_OF_WIDTH = 0.25  # of the image's width, if no depth is expected
MAX_DISPARITY_OF_SIDE = 4  # sides of the sampled square: limits the time
# At most a fifth of random matches agree with their median; on recorded targets, at least a third of all do.
MIN_AGREEING_SHARE = 0.3  # of the measured samples
AGREEING_OFFSET, AGREEING_SAMPLES = 0.1, 2  # from the median: meters, plus samples of disparity
MIN_NEARER_SHARE = 0.5  # of a small box, that a surface too near for fine samples has to fill
DISPARITY_NOISE = 0.15  # standard deviation, in samples; in pixels if samples are finer than pixels
DEPTH_IMAGE_NOISE = 0.005  # standard deviation of a pixel, as a share of its depth

Gate = tuple[float, float]  # meters from the expected depth, and the smallest share of samples within them
Grid = tuple[float, float, float]  # x and y of the top left corner, and a square's side; image pixels


class ExpectedDepth(NamedTuple):
    """The depth at which the target should be.

    z: meters. sigma: standard deviation of its pixels' depths around z, meters.
    """

    z: float
    sigma: float

    @property
    def occluder_margin(self) -> float:
        """Meters; anything nearer than the expected depth by more than this margin is an occluder.

        If the expected depth is uncertain, the margin reaches to the camera, so that nothing is an occluder.
        """
        if self.sigma < MAX_EXPECTED_SIGMA:
            return max(min(GATE_SIGMAS * self.sigma, MAX_OCCLUDER_MARGIN), MIN_OCCLUDER_MARGIN)
        return self.z


class DepthPosterior(NamedTuple):
    """What depth tells about the squares of a grid, (side, side) each.

    posterior: P(target | depth), 0.5 where no depth is measured. occluded: 1 where depth is nearer than
    expected by more than a margin, else 0.
    """

    posterior: Plane
    occluded: NDArray[np.uint8]


class DepthSource(Protocol):
    """Measures the depth of pixels."""

    @property
    def has_sharp_edges(self) -> bool:
        """Whether depth edges are at the same pixels as the edges in the picture."""

    def medians(
        self, k: Kernels, boxes: Floats, samples: int, expected: ExpectedDepth | None, gate: Gate
    ) -> Floats:
        """(N, 3) median depths, spreads and shares of samples in boxes (N, 4); see ``median_depths``."""

    def posterior(
        self, k: Kernels, grid: Grid, side: int, expected: ExpectedDepth, margin: float
    ) -> DepthPosterior:
        """The posterior of a grid with so many squares on a side.

        margin: meters; anything nearer than expected by more is an occluder.
        """

    def noise(self, z: float, pixel_size: float) -> float:
        """Standard deviation, in meters, of a depth z that is sampled in squares of so many image pixels."""


class DepthImageSource(NamedTuple):
    """A depth camera's image, (H, W) in meters, NaN where nothing was measured."""

    depth: Plane

    @property
    def has_sharp_edges(self) -> bool:
        """True: each pixel is measured by itself."""
        return True

    def medians(
        self, k: Kernels, boxes: Floats, samples: int, expected: ExpectedDepth | None, gate: Gate
    ) -> Floats:
        """All boxes are measured in one call, each sample by the pixel under it."""
        return k.median_depths(self.depth, boxes, samples, expected.z if expected else math.nan, *gate)

    def posterior(
        self, k: Kernels, grid: Grid, side: int, expected: ExpectedDepth, margin: float
    ) -> DepthPosterior:
        """As of every DepthSource."""
        return DepthPosterior(*k.depth_posterior(self.depth, (*grid, side, side), (*expected, margin)))

    def noise(self, z: float, pixel_size: float) -> float:
        """Proportional to the depth."""
        return DEPTH_IMAGE_NOISE * z


class StereoSource(NamedTuple):
    """A rectified stereo pair, (H, W, 3) BGR each, and its rig."""

    left: Image
    right: Image
    rig: StereoRig

    @property
    def has_sharp_edges(self) -> bool:
        """False: the windows of block matching reach beyond edges."""
        return False

    @property
    def _focal_baseline(self) -> float:
        """Pixels times meters: depth times disparity."""
        return self.rig.intrinsics.fx * self.rig.baseline

    def sample(self, k: Kernels, grid: Grid, side: int, expected: ExpectedDepth | None) -> Plane:
        """(side, side) depths of a grid's squares in meters, NaN where nothing is measured.

        Samples of both images are matched by sums of absolute differences (Moreno et al. 2002, section 3.2).
        The right image is sampled farther left by the expected disparity, which makes that disparity 0.

        Only depths near the expected one are found. If no depth is expected, disparities up to a quarter of
        the image's width, and up to four sides of the grid, are found.
        """
        x, y, step = grid
        shift = 0.0 if expected is None else self._focal_baseline / expected.z
        max_disparity = MAX_DISPARITY_OF_WIDTH * self.left.shape[1]
        first = 0 if expected is None else -MAX_DISPARITY_BELOW_EXPECTED
        last = int(np.ceil(max_disparity / step)) if expected is None else MAX_DISPARITY_ABOVE_EXPECTED
        last = min(last, MAX_DISPARITY_OF_SIDE * side)
        width = side + last
        part = np.array([[x - last * step, y, width * step, side * step]])
        left = k.reduce_gray(k.sample_windows(self.left, part, side, width)[0], 1)
        moved = part - [[shift, 0, 0, 0]]
        right = k.reduce_gray(k.sample_windows(self.right, moved, side, width)[0], 1)
        region = (last, 0, width, side)
        found = k.sad_disparity(left, right, region, False, (first, last), SAD_MATCHING, SAD_TOLERANCE)
        disparity = found * np.float32(step) + np.float32(shift)
        disparity[~(disparity > 0)] = np.nan  # not found, or not in front of the camera
        depths: Plane = np.float32(self._focal_baseline) / disparity
        return depths

    def medians(
        self, k: Kernels, boxes: Floats, samples: int, expected: ExpectedDepth | None, gate: Gate
    ) -> Floats:
        """Each box is matched separately, in the square that its samples cover.

        The samples of a small box are so fine that the disparities of near surfaces are out of range. So if
        no depth is expected, coarser samples are tried first, for such near surfaces.
        """
        found = []
        for box in boxes.tolist():
            step = max(box[2:]) / samples
            if expected is None:
                medians = self._measure_nearer(k, box, step, samples, gate)
                if medians is None:
                    medians = self._measure_unexpected(k, box, step, samples, gate)
                found.append(medians)
            else:
                depths, part = self._sample_around(k, box, step, samples, expected)
                found.append(k.median_depths(depths, part, samples, expected.z, *gate))
        return np.concatenate(found)

    def _measure_unexpected(
        self, k: Kernels, box: list[float], step: float, samples: int, gate: Gate
    ) -> Floats:
        """(1, 3) as in ``medians``, without an expected depth; NaN if too few depths agree with their median.

        A surface that the right image doesn't show, outside its border or occluded there, matches at random.
        """
        depths, part = self._sample_around(k, box, step, samples, None)
        medians = k.median_depths(depths, part, samples, math.nan, *gate)
        z = float(medians[0, 0])
        if math.isnan(z):
            return medians
        sample = step * z * z / self._focal_baseline  # of disparity, in meters
        agreeing = AGREEING_OFFSET + AGREEING_SAMPLES * sample, MIN_AGREEING_SHARE
        agree = not math.isnan(k.median_depths(depths, part, samples, math.nan, *agreeing)[0, 0])
        return medians if agree else np.full((1, 3), np.nan)

    def _measure_nearer(
        self, k: Kernels, box: list[float], step: float, samples: int, gate: Gate
    ) -> Floats | None:
        """(1, 3) as in ``medians``, for a surface that fills most of a box and is nearer than ``sample`` can
        find with samples ``step`` pixels apart; None if there is no such surface.
        """
        coarse = MAX_DISPARITY_OF_WIDTH * self.left.shape[1] / (MAX_DISPARITY_OF_SIDE * samples)
        if step >= coarse:
            return None
        depths, part = self._sample_around(k, box, coarse, samples, None)
        medians = k.median_depths(depths, part, samples, math.nan, *gate)
        z = float(medians[0, 0])
        if not z < self.rig.depth(MAX_DISPARITY_OF_SIDE * samples * step):
            return None
        share = k.median_depths(depths, part, samples, z, *gate)[0, 2]  # of the box, not of what is measured
        return medians if share >= MIN_NEARER_SHARE else None

    def _sample_around(
        self, k: Kernels, box: list[float], step: float, samples: int, expected: ExpectedDepth | None
    ) -> tuple[Plane, Floats]:
        """The depths of a square of samples ``step`` pixels apart around a box, and the box (1, 4) in it."""
        x, y, width, height = box
        half = step * samples / 2
        depths = self.sample(k, (x - half, y - half, step), samples, expected)
        return depths, np.array([[samples / 2, samples / 2, width / step, height / step]])

    def posterior(
        self, k: Kernels, grid: Grid, side: int, expected: ExpectedDepth, margin: float
    ) -> DepthPosterior:
        """As of every DepthSource."""
        depths = self.sample(k, grid, side, expected)
        return DepthPosterior(*k.depth_posterior(depths, (0.0, 0.0, 1.0, side, side), (*expected, margin)))

    def noise(self, z: float, pixel_size: float) -> float:
        """Proportional to the squared depth, as the noise of a disparity is constant.

        Samples finer than pixels don't reduce this noise.
        """
        disparity_noise = DISPARITY_NOISE * max(pixel_size, 1.0)  # pixels
        return disparity_noise * z * z / self._focal_baseline
