# SPDX-License-Identifier: MIT
"""What is wrong with the right image of a real stereo pair: its exposure, and its rows."""

from typing import NamedTuple

import cv2
import numpy as np

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
        moved = cv2.warpAffine(
            picture,
            np.array([[1.0, 0, 0], [0, 1, self.rows]]),
            picture.shape[1::-1],
            flags=cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_REPLICATE,
        )
        return np.asarray(np.float32(self.gain) * moved, np.float32)
