# SPDX-License-Identifier: MIT
"""What is wrong with the right image of a real stereo pair: its exposure, and its rows."""

from typing import NamedTuple

import numpy as np

from tricue import imgproc
from tricue.scenes.arrays import Picture


class StereoFaults(NamedTuple):
    """The right image's faults against the left: gain of its exposure, and rows that it lies lower."""

    gain: float
    rows: float

    @classmethod
    def sample(cls, rng: np.random.Generator) -> "StereoFaults":
        """A gain between 0.75 and 1.33, and half a row to one, up or down."""
        return cls(
            float(np.exp(rng.uniform(-0.29, 0.29))), float(rng.choice([-1, 1]) * rng.uniform(0.5, 1.0))
        )

    def apply(self, picture: Picture) -> Picture:
        """The right image (H, W, 3), before noise, of one that is rectified and exposed as the left."""
        height, width = picture.shape[:2]
        moved = imgproc.shift(picture, 0, self.rows, height, width, border="replicate")
        return np.asarray(np.float32(self.gain) * moved, np.float32)
