# SPDX-License-Identifier: MIT
"""What tells a target from other objects of its size: how it is spread over its box."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.depth_objects.objects import SLICES, Objects

Floats = NDArray[np.float64]

RATE = 0.1  # per frame, of learning


class Signature(NamedTuple):
    """How a target is spread over its box: (2 SLICES,) shares of its columns and of its rows, and (2,) metres
    from the box's centre to the centroid.
    """

    spread: Floats
    shift: Floats

    @classmethod
    def unknown(cls) -> "Signature":
        """Even."""
        return cls(np.full(2 * SLICES, 1 / SLICES), np.zeros(2))

    @classmethod
    def of(cls, objects: Objects, index: int) -> "Signature":
        """An object's."""
        return cls(_spread(objects, index), objects.shift[index])

    def distance(self, objects: Objects, index: int) -> float:
        """In [0, 1]: how differently an object is spread over its box."""
        return float(np.abs(_spread(objects, index) - self.spread).sum()) / 4

    def learned(self, new: "Signature") -> "Signature":
        """With another one blended in."""
        spread = self.spread + RATE * (new.spread - self.spread)
        return Signature(spread, self.shift + RATE * (new.shift - self.shift))


def _spread(objects: Objects, index: int) -> Floats:
    return np.concatenate((objects.columns[index], objects.rows[index]), dtype=np.float64)
