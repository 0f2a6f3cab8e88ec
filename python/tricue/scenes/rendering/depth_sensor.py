# SPDX-License-Identifier: MIT
"""Depth sensors: the errors that a sensor makes on an exact z-buffer."""

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask

EDGE = 0.1  # a depth edge: neighbours' depths differ by more than this share of the nearer one
FLYING = 0.5  # share of the pixels along edges (one on each side) in which a time-of-flight camera mixes


@dataclass(frozen=True, slots=True)
class DepthCamera:
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
    still: float  # metres
    growth: float  # per metre
    step: float  # per metre: 1 / z is a multiple of it; 0 leaves z as it is
    mixes: bool  # whether a pixel on an edge measures something between both surfaces
    grain: float  # pixels, the deviation of the Gaussian that shapes the patches of missing pixels

    def deviation(self, depth: Array) -> Array:
        """The noise's standard deviation at each depth, metres."""
        return self.still + self.growth * depth**2

    def measure(
        self, depth: Array, rng: np.random.Generator, *, missing: float = 0.03, noise: float = 1.0
    ) -> NDArray[np.float32]:
        """What the sensor makes of a z-buffer (H, W): float32 metres, NaN where nothing was measured.

        missing: share of the pixels within range that come without a depth, in patches and mostly at edges.
        noise: multiplies the deviation; up to 1 also the share of mixed pixels, so 0 leaves exact depths.
        """
        edges = depth_edges(depth)
        measured = mix(depth, edges, FLYING * min(noise, 1.0), rng) if self.mixes else depth
        measured = measured + noise * self.deviation(measured) * rng.standard_normal(depth.shape)
        if self.step:
            with np.errstate(divide="ignore"):
                measured = 1 / (np.rint(1 / measured / self.step) * self.step)
        measured[(measured < self.near) | (measured > self.far)] = np.nan
        drop(measured, edges, missing, self.grain, rng)
        return measured.astype(np.float32)


def depth_edges(depth: Array) -> Mask:
    """The pixels (H, W) whose 3x3 neighbourhood spans a depth edge: one on each side of it."""
    near, far = _neighbourhood(depth)
    return np.asarray(far - near > EDGE * near)


def mix(depth: Array, edges: Mask, share: float, rng: np.random.Generator) -> Array:
    """Flying pixels: a random ``share`` of the pixels at edges lies between their fore- and background."""
    near, far = _neighbourhood(depth)
    chosen = edges & (rng.random(depth.shape) < share)
    return np.where(chosen, near + rng.random(depth.shape) * (far - near), depth)


def drop(depth: Array, edges: Mask, share: float, grain: float, rng: np.random.Generator) -> None:
    """Set exactly a ``share`` of the measured pixels to NaN: patches of blurred noise, edges first."""
    blurred = cv2.GaussianBlur(rng.standard_normal(depth.shape), (0, 0), grain)
    # Blurring white noise leaves a deviation of 1 / (2 sqrt(pi) grain); an edge counts for two of these.
    field = (blurred + edges / (math.sqrt(math.pi) * grain)).ravel()
    measured = np.flatnonzero(np.isfinite(depth))
    count = round(share * len(measured))
    if count:
        weakest = np.argpartition(field[measured], -count)[-count:]
        depth.flat[measured[weakest]] = np.nan


def _neighbourhood(depth: Array) -> tuple[Array, Array]:
    """The nearest and the farthest depth in the 3x3 pixels round each."""
    square = np.ones((3, 3), np.uint8)
    return np.asarray(cv2.erode(depth, square)), np.asarray(cv2.dilate(depth, square))


CAMERAS = {
    "tof": DepthCamera(
        Intrinsics.from_fov(176, 144, 47.5, 39.5), 15, 0.3, 7.5, 0.0075, 6.25e-4, 0.0, mixes=True, grain=1.0
    ),
    "rgbd": DepthCamera(
        Intrinsics(525, 525, 319.5, 239.5, 640, 480),
        30,
        0.5,
        8.0,
        0.0,
        1.425e-3,
        2.85e-3,
        mixes=False,
        grain=3.0,
    ),
}
