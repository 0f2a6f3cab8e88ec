# SPDX-License-Identifier: MIT
"""A depth camera with the faults of real ones, beside a color camera, applied to any rendered frame.

The faults are those that ``benchmarks.quality.depth_properties`` measured on recordings of a Kinect, an Xtion
and two RealSense cameras; docs/scenes.md has the numbers.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.sensor.holes import HoleField, HoleShares
from tricue.scenes.sensor.shadow import cast_shadow
from tricue.scenes.sensor.surfaces import SurfaceFaults, smooth_noise

BEYOND = 100.0  # meters, stands for infinite depth; beyond every range
REFERENCE_WIDTH = 640  # pixels, of the images in which the faults were measured


class DepthFaults(NamedTuple):
    """The faults of a depth camera.

    near, far: its range, meters. step: 1 / z is rounded to multiples of it, per meter. noise: standard
    deviation at 1 m, meters; it grows with z squared. grain: sigma of the noise, pixels. baseline: see
    cast_shadow. surfaces, holes: see SurfaceFaults, HoleShares. shift: (x, y) pixels by which depth is
    displaced from color. margin: share of the image at each side that has no depth. delay: frames by which
    depth lags color; negative if it leads.
    """

    near: float
    far: float
    step: float
    noise: float
    grain: float
    baseline: float
    surfaces: SurfaceFaults
    holes: HoleShares
    shift: tuple[float, float]
    margin: float
    delay: int

    @classmethod
    def sample(cls, width: int, rng: np.random.Generator) -> "DepthFaults":
        """A random camera for images of this width, within the ranges that were measured."""
        scale = width / REFERENCE_WIDTH
        angle, length = rng.uniform(0, 2 * np.pi), scale * rng.uniform(1.0, 3.0)
        smear = scale * rng.uniform(1.0, 2.0) if rng.random() < 0.25 else 0.0
        thin, ragged = max(round(scale * rng.uniform(3, 8)), 1), scale * rng.uniform(0.5, 1.5)
        return cls(
            near=rng.uniform(0.3, 0.45),
            far=rng.uniform(6.0, 9.0),
            step=rng.uniform(1.0e-3, 2.85e-3),
            noise=rng.uniform(0.5e-3, 1.4e-3),
            grain=rng.uniform(0.5, 0.85),
            baseline=float(rng.choice([1, 1, -1])) * rng.uniform(0.03, 0.075),
            surfaces=SurfaceFaults(thin, ragged, smear, rng.uniform(0.0, 0.03)),
            holes=HoleShares(
                dark=rng.uniform(0.02, 0.3),
                medium=rng.uniform(0.0, 0.01),
                bright=rng.uniform(0.0, 0.01),
                shiny=rng.uniform(0.2, 0.8),
                edge=rng.uniform(0.1, 0.5),
                reach=max(round(scale * rng.uniform(0, 4)), 0),
                grain=scale * rng.uniform(6.0, 14.0),
            ),
            shift=(length * math.cos(angle), length * math.sin(angle)),
            margin=rng.uniform(0.0, 0.05),
            delay=int(rng.choice([0, 0, 1, -1])),
        )


class FaultyDepthCamera:
    """Measures the frames of one scene in order."""

    def __init__(self, intrinsics: Intrinsics, faults: DepthFaults, rng: np.random.Generator) -> None:
        self._intrinsics, self._faults, self._rng = intrinsics, faults, rng
        self._holes = HoleField((intrinsics.height, intrinsics.width), faults.holes, rng)

    def measure(self, depth: Array, gray: NDArray[np.uint8], shiny: Mask) -> NDArray[np.float32]:
        """The depth image (H, W), meters, NaN where nothing was measured.

        depth: the exact z-buffer in the color image's pixels, infinite where it is empty. gray: the color
        image's brightness. shiny: pixels that reflect the projector's light away.
        """
        faults, depth = self._faults, np.minimum(depth, BEYOND)
        holes = cast_shadow(depth, self._intrinsics.fx, faults.baseline)
        holes |= self._holes.next_holes(depth, gray, shiny, self._intrinsics)
        seen = self._quantize(faults.surfaces.apply(depth, self._rng))
        seen[holes | ~(seen >= faults.near) | ~(seen <= faults.far)] = np.nan
        return self._register(seen)

    def _quantize(self, depth: Array) -> Array:
        """Depth with noise added to its inverse, which is then rounded like a disparity."""
        faults = self._faults
        noise = faults.noise * smooth_noise(depth.shape, faults.grain, self._rng)
        levels = np.rint((1 / depth + noise) / faults.step)
        with np.errstate(divide="ignore"):
            return np.asarray(1 / (levels * faults.step))

    def _register(self, depth: Array) -> NDArray[np.float32]:
        """The depth in the color image's pixels, displaced by calibration errors and without margins."""
        x, y = self._faults.shift
        height, width = depth.shape
        moved = imgproc.shift(depth.astype(np.float32), x, y, height, width, "nearest", value=math.nan)
        beside, over = (round(self._faults.margin * side) for side in (width, height))
        framed = np.full(depth.shape, np.nan, np.float32)
        inside = slice(over, height - over), slice(beside, width - beside)
        framed[inside] = moved[inside]
        return framed
