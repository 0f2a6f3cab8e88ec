# SPDX-License-Identifier: MIT
"""A color camera in fading light: fewer photons, a limited gain, and noise of a few levels in darkness."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.scenes.arrays import Picture

LEVELS = 255


class LowLightSensor(NamedTuple):
    """A camera with automatic gain, shot noise and read noise; the numbers are typical of a small sensor.

    full_well: electrons at level 255 under light 1. read_noise: standard deviation, electrons. max_gain: the
    gain's limit in dim light; bright light only shortens the exposure.
    """

    full_well: float = 10_000.0
    read_noise: float = 10.0
    max_gain: float = 16.0

    def expose(self, picture: Picture, light: float, rng: np.random.Generator) -> NDArray[np.uint8]:
        """The 8-bit image (H, W, 3) of a picture with its levels under light 1. light: 0 in darkness."""
        exposed = min(light, 1.0)
        electrons = np.maximum(picture, 0) * np.float32(exposed * self.full_well / LEVELS)
        noise = np.sqrt(electrons + np.float32(self.read_noise**2))
        noise *= rng.standard_normal(picture.shape, dtype=np.float32)
        gain = min(1 / exposed, self.max_gain) if exposed > 0 else self.max_gain
        levels = (electrons + noise) * np.float32(gain * LEVELS / self.full_well)
        return np.asarray(np.clip(np.rint(levels), 0, LEVELS), np.uint8)
