# SPDX-License-Identifier: MIT
"""The faults of the right image of a real stereo pair: its exposure and its vertical offset."""

from typing import NamedTuple

import numpy as np

from tricue import imgproc
from tricue.scenes.arrays import Picture


class StereoFaults(NamedTuple):
    """The right image's gain relative to the left one, and how many rows lower it lies."""

    gain: float
    rows: float

    @classmethod
    def sample(cls, rng: np.random.Generator) -> "StereoFaults":
        """A random gain between 0.75 and 1.33, and an offset of half a row to one, up or down."""
        return cls(
            float(np.exp(rng.uniform(-0.29, 0.29))), float(rng.choice([-1, 1]) * rng.uniform(0.5, 1.0))
        )

    def apply(self, picture: Picture) -> Picture:
        """Apply them to a right image (H, W, 3) that is rectified and exposed like the left, before noise."""
        height, width = picture.shape[:2]
        moved = imgproc.shift(picture, 0, self.rows, height, width, border="replicate")
        return np.asarray(np.float32(self.gain) * moved, np.float32)
