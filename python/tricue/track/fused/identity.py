# SPDX-License-Identifier: MIT
"""Whether what was found is the target, in one number that may be read as a probability."""

import math
import operator
from typing import NamedTuple

import numpy as np

from tricue.track.fused.experts.color import BINS
from tricue.track.fused.sight import Image, Plane
from tricue.track.fused.view import View

# Log-odds of "the overlap is above 0.3" against "under 0.1", by logistic regression with signs as they
# have to be, over six recorded videos and scenes with other seeds than those of the tables, where the tracker
# was and at random places and look-alikes. Depth makes contrasts higher, so that they tell less.
WEIGHTS = 0.32, -15.64, 7.33, 11.19, 12.29  # of the marks
OFFSET = -10.6
STRUCTURE = 0.44, -7.19, 0.0, 0.0, 11.07  # the same of what light leaves as it is
STRUCTURE_OFFSET = -4.91
TRUST = {"color": (1.0, 0.0), "both": (1.0, -1.0), "depth": (0.36, -4.7)}  # slope, offset


class Marks(NamedTuple):
    """What a found place tells of who is there.

    sharpness: standard deviations by which the filter's answer stands above its mean. order: mean distance of
    its ranks from those learnt, in [0, 1]. colors: Bhattacharyya coefficient with the first frame's colors.
    contrast: mean P(target | pixel) in the box less half that round it. first: the first frame's filter's
    answer.
    """

    sharpness: float
    order: float
    colors: float
    contrast: float
    first: float

    def log_odds(self, channels: str) -> float:
        """Of the target being there; above 0 it rather is. channels: a key of TRUST."""
        slope, offset = TRUST[channels]
        return slope * (OFFSET + self._weighed(WEIGHTS)) + offset

    @property
    def by_structure(self) -> float:
        """The same by what light leaves as it is alone."""
        return STRUCTURE_OFFSET + self._weighed(STRUCTURE)

    def _weighed(self, weights: tuple[float, ...]) -> float:
        return float(sum(map(operator.mul, weights, self)))


def probability(log_odds: float) -> float:
    """What log-odds say, in [0, 1]."""
    return 1 / (1 + math.exp(-min(max(log_odds, -50.0), 50.0)))


class Identity(NamedTuple):
    """What is remembered of the target's look: roots of its colors (4096,) in the first frame, which never
    learn, and its ranks (3, n), which do.
    """

    roots: Plane
    ranks: Plane

    @classmethod
    def start(cls, view: View, ranks: Plane) -> "Identity":
        """Of the first frame."""
        return cls(np.sqrt(colors_of(view, 0.0, 0.0)), ranks)

    def likeness(self, view: View, right: float, down: float) -> float:
        """Bhattacharyya coefficient of the colors so many patch pixels off the view's middle."""
        return float(np.vdot(np.sqrt(colors_of(view, right, down)), self.roots))

    def order(self, ranks: Plane) -> float:
        """Mean distance of ranks (3, n)."""
        return float(np.abs(ranks - self.ranks).sum()) / ranks.size

    def learnt(self, ranks: Plane, rate: float) -> "Identity":
        """With the ranks of a found target blended in."""
        return Identity(self.roots, self.ranks + np.float32(rate) * (ranks - self.ranks))


def colors_of(view: View, right: float, down: float) -> Plane:
    """(4096,) histogram of the middle of a target's box."""
    pixels: Image = view.patch[view.inner(right, down, share=0.8)]
    samples = np.ascontiguousarray(pixels.transpose(2, 0, 1)).reshape(1, 3, -1)
    histogram: Plane = view.sight.k.joint_histogram(samples, BINS)[0]
    return histogram
