# SPDX-License-Identifier: MIT
"""The shape that distinguishes a target from other objects of its size: its distribution over its box."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.depth_objects.objects import DISTRIBUTION_BINS, Objects

Floats = NDArray[np.float64]

SIGNATURE_RATE = 0.1  # per frame, of learning


class Signature(NamedTuple):
    """The distribution of a target over its box.

    distribution: (2 DISTRIBUTION_BINS,) the horizontal and then the vertical one, each of sum 1.
    centroid_offset: (2,) meters, from the box's center to the centroid.
    """

    distribution: Floats
    centroid_offset: Floats

    @classmethod
    def uniform(cls) -> "Signature":
        """The signature of a target of unknown shape."""
        return cls(np.full(2 * DISTRIBUTION_BINS, 1 / DISTRIBUTION_BINS), np.zeros(2))

    @classmethod
    def from_object(cls, objects: Objects, index: int) -> "Signature":
        """The signature of a segmented object."""
        return cls(_distribution(objects, index), objects.centroid_offset[index])

    def distance(self, objects: Objects, index: int) -> float:
        """The total variation distance to an object's distributions, their mean, in [0, 1]."""
        return float(np.abs(_distribution(objects, index) - self.distribution).sum()) / 4

    def learn(self, new: "Signature") -> "Signature":
        """Blend in another signature."""
        distribution = self.distribution + SIGNATURE_RATE * (new.distribution - self.distribution)
        offset = self.centroid_offset + SIGNATURE_RATE * (new.centroid_offset - self.centroid_offset)
        return Signature(distribution, offset)


def _distribution(objects: Objects, index: int) -> Floats:
    return np.concatenate((objects.columns[index], objects.rows[index]), dtype=np.float64)
