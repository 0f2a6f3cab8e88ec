# SPDX-License-Identifier: MIT
"""The shape that distinguishes a target from other objects of its size: its distribution over its box."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.track.depth_objects.objects import DISTRIBUTION_BINS, Objects

SIGNATURE_RATE = 0.1  # per frame, of learning


class Signature(NamedTuple):
    """The distribution of a target over its box.

    values: (2 DISTRIBUTION_BINS + 2,) the distribution and the centroid's offset in one array, because they
    are learned together.
    """

    values: Floats

    @property
    def distribution(self) -> Floats:
        """The horizontal and then the vertical distribution, (2 DISTRIBUTION_BINS,), each with sum 1."""
        return self.values[:-2]

    @property
    def centroid_offset(self) -> Floats:
        """The vector (2,) from the box's center to the centroid, meters."""
        return self.values[-2:]

    @classmethod
    def uniform(cls) -> "Signature":
        """The signature of a target of unknown shape."""
        return cls(np.append(np.full(2 * DISTRIBUTION_BINS, 1 / DISTRIBUTION_BINS), (0.0, 0.0)))

    @classmethod
    def from_object(cls, objects: Objects, index: int) -> "Signature":
        """The signature of a segmented object."""
        parts = objects.columns[index], objects.rows[index], objects.centroid_offset[index]
        return cls(np.concatenate(parts, dtype=np.float64))

    def learn(self, new: "Signature") -> "Signature":
        """Blend in another signature."""
        return Signature(self.values + SIGNATURE_RATE * (new.values - self.values))
