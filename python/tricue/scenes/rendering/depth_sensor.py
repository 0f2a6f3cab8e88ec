# SPDX-License-Identifier: MIT
"""Depth sensors: range, noise, quantization, flying and missing pixels, applied to an exact z-buffer."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask

MIN_EDGE_STEP = 0.1  # between the depths of neighbors at a depth edge, as a share of the smaller one
FLYING_PIXEL_SHARE = 0.5  # of a time-of-flight camera's pixels at edges (one on each side)


@dataclass(frozen=True, slots=True)
class DepthSensor:
    """A depth sensor, with white noise of deviation ``base_noise + noise_growth * z^2`` meters at depth z.

    The time-of-flight camera is the SR-3000 of Sabeti, Parvizi and Wu (2008), section V; its noise of about
    1 cm at 2 m and 3 cm at 6 m is our estimate. The RGB-D camera has the Kinect's noise and quantization by
    Khoshelham and Elberink (2012), Sensors 12, 1437-1454: half a disparity step, which is 1.4 mm at 1 m and
    3.6 cm at 5 m.
    """

    intrinsics: Intrinsics
    rate: float  # frames per second
    near: float  # meters; depths outside near to far are missing
    far: float
    base_noise: float  # meters
    noise_growth: float  # per meter
    inverse_depth_step: float  # per meter: 1 / z is rounded to multiples of it; 0 means no rounding
    has_flying_pixels: bool  # whether pixels at edges measure a depth between both surfaces
    dropout_grain: float  # pixels, the sigma of the Gaussian that shapes the patches of missing pixels

    def noise_deviation(self, depth: Array) -> Array:
        """The standard deviation of the noise at each depth, meters."""
        return self.base_noise + self.noise_growth * depth**2

    def measure(
        self, depth: Array, rng: np.random.Generator, *, missing: float = 0.03, noise: float = 1.0
    ) -> NDArray[np.float32]:
        """The depth image (H, W) of a z-buffer, float32 meters, NaN where nothing was measured.

        missing: share of the pixels within range that have no depth, in patches and mostly at edges.
        noise: multiplies the noise, and up to 1 also the share of flying pixels; at 0 depths are exact.
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
    """The pixels (H, W) at depth edges, one on each side: those whose 3x3 neighborhood spans an edge."""
    near, far = _neighborhood_range(depth)
    return np.asarray(far - near > MIN_EDGE_STEP * near)


def add_flying_pixels(depth: Array, edges: Mask, share: float, rng: np.random.Generator) -> Array:
    """Give a random ``share`` of the pixels at edges a depth between foreground and background."""
    near, far = _neighborhood_range(depth)
    chosen = edges & (rng.random(depth.shape) < share)
    return np.where(chosen, near + rng.random(depth.shape) * (far - near), depth)


def drop_pixels(depth: Array, edges: Mask, share: float, grain: float, rng: np.random.Generator) -> None:
    """Set a ``share`` of the measured pixels to NaN, in place: patches of blurred noise, preferably at edges.

    The number of pixels is exact, share times the number measured. grain: sigma of the blur, pixels.
    """
    blurred = imgproc.gaussian_blur(rng.standard_normal(depth.shape), grain)
    # Blurred white noise has a deviation of 1 / (2 sqrt(pi) grain); an edge adds two deviations.
    field = (blurred + edges / (math.sqrt(math.pi) * grain)).ravel()
    measured = np.flatnonzero(np.isfinite(depth))
    count = round(share * len(measured))
    if count:
        weakest = np.argpartition(field[measured], -count)[-count:]
        depth.flat[measured[weakest]] = np.nan


def _neighborhood_range(depth: Array) -> tuple[Array, Array]:
    """The smallest and the largest depth in the 3x3 neighborhood of each pixel."""
    return imgproc.erode(depth, 3), imgproc.dilate(depth, 3)


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
