# SPDX-License-Identifier: MIT
"""A time-of-flight camera that counts electrons: its own light, the scene's light, and phase ambiguity.

It sends modulated light and measures the phase of the reflection. A surface of reflectance R at distance r
returns A = signal R / r² electrons of this light, and ambient R of the scene's light. Their shot noise gives
the range a standard deviation of L / sqrt(8) sqrt(B) / (2 A), where B is their sum and L the unambiguous
range, c / 2f: Lange and Seitz (2001), IEEE Journal of Quantum Electronics 37, 390-397. A surface farther than
L has the phase of a nearer one, and appears at that distance.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.rendering.depth_sensor import FLYING_PIXEL_SHARE, add_flying_pixels, find_depth_edges

SPEED_OF_LIGHT = 299_792_458.0  # meters per second
BEYOND = 1000.0  # meters, stands for infinity: no light returns from there


class TimeOfFlightImage(NamedTuple):
    """depth: (H, W) float32 meters, NaN where nothing was measured. amplitude: (H, W) float32 electrons."""

    depth: NDArray[np.float32]
    amplitude: NDArray[np.float32]


class TimeOfFlightCamera(NamedTuple):
    """A time-of-flight camera; its numbers are our estimate of the SR-3000.

    They give a deviation of 1 cm at 2 m and 3 cm at 6 m in darkness, for a reflectance of one half, as the
    sensor of :mod:`tricue.scenes.rendering.depth_sensor` has.
    """

    intrinsics: Intrinsics
    modulation: float = 20e6  # Hz
    near: float = 0.3  # meters; nearer depths are missing
    signal: float = 140_000.0  # electrons, from white at 1 m
    ambient: float = 20_000.0  # electrons, from white under indoor light
    full_well: float = 500_000.0  # electrons; pixels with more are saturated, and missing
    min_amplitude: float = 100.0  # electrons; pixels with less are missing
    min_reflectance: float = 0.0
    """Pixels are missing if their amplitude and apparent depth imply a lower reflectance; 0 keeps all.
    Surfaces beyond the unambiguous range are darker than anything at their apparent depth.
    """

    @property
    def unambiguous_range(self) -> float:
        """c / 2f, meters."""
        return SPEED_OF_LIGHT / (2 * self.modulation)

    def measure(
        self, depth: Array, reflectance: Array, light: float, rng: np.random.Generator
    ) -> TimeOfFlightImage:
        """The image of a z-buffer (H, W), meters; infinite where it is empty, which counts as missing.

        reflectance: (H, W), 0 to 1. light: the scene's light, 1 indoors, 0 in darkness, 100 in the sun.
        """
        lengths = self._ray_lengths()
        depth = np.minimum(depth, BEYOND)
        seen = add_flying_pixels(depth, find_depth_edges(depth), FLYING_PIXEL_SHARE, rng)
        distance = seen * lengths
        amplitude = self.signal * reflectance / np.square(distance)
        electrons = amplitude + self.ambient * light * reflectance
        noise = rng.standard_normal(depth.shape)
        valid = self._valid(amplitude, electrons)
        measured = np.where(valid, distance, 1.0)
        measured += np.where(valid, self.deviation(np.where(valid, amplitude, 1.0), electrons), 0.0) * noise
        measured = np.mod(measured, self.unambiguous_range)
        # The amplitude's noise is that of all electrons, as for an intensity.
        amplitude = amplitude + np.sqrt(electrons) * rng.standard_normal(depth.shape)
        apparent = np.maximum(amplitude, 0) * np.square(measured) / self.signal
        measured /= lengths
        valid &= (measured >= self.near) & (apparent >= self.min_reflectance)
        return TimeOfFlightImage(
            np.where(valid, measured, np.nan).astype(np.float32),
            np.maximum(amplitude, 0).astype(np.float32),
        )

    def deviation(self, amplitude: Array, electrons: Array) -> Array:
        """The standard deviation of distances, meters, for an amplitude and the number of all electrons."""
        deviation: Array = self.unambiguous_range / np.sqrt(8) * np.sqrt(electrons) / (2 * amplitude)
        return deviation

    def _valid(self, amplitude: Array, electrons: Array) -> Mask:
        return np.asarray((amplitude >= self.min_amplitude) & (electrons <= self.full_well))

    def _ray_lengths(self) -> Array:
        """The length (H, W) of each pixel's ray up to depth 1, because phases are measured along rays."""
        camera = self.intrinsics
        x = (np.arange(camera.width) - camera.cx) / camera.fx
        y = (np.arange(camera.height) - camera.cy) / camera.fy
        lengths: Array = np.sqrt(1 + np.add.outer(np.square(y), np.square(x)))
        return lengths
