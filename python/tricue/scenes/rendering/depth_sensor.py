# SPDX-License-Identifier: MIT
"""Depth sensors: the errors that a sensor makes on an exact z-buffer."""

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask

MIN_EDGE_STEP = 0.1  # a depth edge: neighbours' depths differ by more than this share of the nearer one
FLYING_PIXEL_SHARE = (
    0.5  # share of the pixels along edges (one on each side) in which a time-of-flight camera mixes
)


@dataclass(frozen=True, slots=True)
class DepthSensor:
    """A kind of depth sensor: noise of deviation ``still + growth * z^2`` metres at z metres, and its flaws.

    The time-of-flight camera is the SR-3000 of Sabeti, Parvizi and Wu (2008), section V, with about 1 cm of
    noise at 2 m and 3 cm at 6 m, our estimate. The RGB-D camera has the Kinect's noise and quantisation of
    Khoshelham and Elberink (2012), Sensors 12, 1437-1454: half a step of disparity, which is 1.4 mm at 1 m,
    3.6 cm at 5 m. Noise is white: not correlated over pixels or frames.
    """

    intrinsics: Intrinsics
    rate: float  # frames a second
    near: float  # metres; what is outside the range is missing
    far: float
    base_noise: float  # metres
    noise_growth: float  # per metre
    inverse_depth_step: float  # per metre: 1 / z is a multiple of it; 0 leaves z as it is
    has_flying_pixels: bool  # whether a pixel on an edge measures something between both surfaces
    dropout_grain: float  # pixels, the deviation of the Gaussian that shapes the patches of missing pixels

    def noise_deviation(self, depth: Array) -> Array:
        """The noise's standard deviation at each depth, metres."""
        return self.base_noise + self.noise_growth * depth**2

    def measure(
        self, depth: Array, rng: np.random.Generator, *, missing: float = 0.03, noise: float = 1.0
    ) -> NDArray[np.float32]:
        """What the sensor makes of a z-buffer (H, W): float32 metres, NaN where nothing was measured.

        missing: share of the pixels within range that come without a depth, in patches and mostly at edges.
        noise: multiplies the deviation; up to 1 also the share of mixed pixels, so 0 leaves exact depths.
        """
        edges = find_depth_edges(depth)
        measured = (
            add_flying_pixels(depth, edges, FLYING_PIXEL_SHARE * min(noise, 1.0), rng)
            if self.has_flying_pixels
            else depth
        )
        measured = measured + noise * self.noise_deviation(measured) * rng.standard_normal(depth.shape)
        if self.inverse_depth_step:
            with np.errstate(divide="ignore"):
                measured = 1 / (np.rint(1 / measured / self.inverse_depth_step) * self.inverse_depth_step)
        measured[(measured < self.near) | (measured > self.far)] = np.nan
        drop_pixels(measured, edges, missing, self.dropout_grain, rng)
        return measured.astype(np.float32)


def find_depth_edges(depth: Array) -> Mask:
    """The pixels (H, W) whose 3x3 neighbourhood spans a depth edge: one on each side of it."""
    near, far = _neighborhood_range(depth)
    return np.asarray(far - near > MIN_EDGE_STEP * near)


def add_flying_pixels(depth: Array, edges: Mask, share: float, rng: np.random.Generator) -> Array:
    """Flying pixels: a random ``share`` of the pixels at edges lies between their fore- and background."""
    near, far = _neighborhood_range(depth)
    chosen = edges & (rng.random(depth.shape) < share)
    return np.where(chosen, near + rng.random(depth.shape) * (far - near), depth)


def drop_pixels(
    depth: Array, edges: Mask, share: float, dropout_grain: float, rng: np.random.Generator
) -> None:
    """Set exactly a ``share`` of the measured pixels to NaN: patches of blurred noise, edges first."""
    blurred = cv2.GaussianBlur(rng.standard_normal(depth.shape), (0, 0), dropout_grain)
    # Blurring white noise leaves a deviation of 1 / (2 sqrt(pi) grain); an edge counts for two of these.
    field = (blurred + edges / (math.sqrt(math.pi) * dropout_grain)).ravel()
    measured = np.flatnonzero(np.isfinite(depth))
    count = round(share * len(measured))
    if count:
        weakest = np.argpartition(field[measured], -count)[-count:]
        depth.flat[measured[weakest]] = np.nan


def _neighborhood_range(depth: Array) -> tuple[Array, Array]:
    """The nearest and the farthest depth in the 3x3 pixels round each."""
    square = np.ones((3, 3), np.uint8)
    return np.asarray(cv2.erode(depth, square)), np.asarray(cv2.dilate(depth, square))


DEPTH_SENSORS = {
    "tof": DepthSensor(
        Intrinsics.from_fov(176, 144, 47.5, 39.5),
        15,
        0.3,
        7.5,
        0.0075,
        6.25e-4,
        0.0,
        has_flying_pixels=True,
        dropout_grain=1.0,
    ),
    "rgbd": DepthSensor(
        Intrinsics(525, 525, 319.5, 239.5, 640, 480),
        30,
        0.5,
        8.0,
        0.0,
        1.425e-3,
        2.85e-3,
        has_flying_pixels=False,
        dropout_grain=3.0,
    ),
}
