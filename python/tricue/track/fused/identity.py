# SPDX-License-Identifier: MIT
"""Whether what was found is the target, in one number that may be read as a probability."""

import math
from typing import NamedTuple

import numpy as np

from tricue.track.fused.experts.color import BINS
from tricue.track.fused.sight import Image, Plane
from tricue.track.fused.view import View

# Log-odds of "the overlap is above 0.1", by logistic regression over six recorded videos, the same made
# sparse, turned, shrunk, shaken and lit otherwise, and frames of other videos. With each video left out in
# turn the area under the ROC curve is 0.97.
WEIGHTS = {"sharpness": 0.38, "order": -14.76, "colors": 5.45, "contrast": 8.56, "first": 1.88, "depth": 0.0}
OFFSET = -5.52


class Marks(NamedTuple):
    """What a found place tells of who is there.

    sharpness: standard deviations by which the filter's answer stands above its mean. order: mean distance of
    its ranks from those learnt, in [0, 1]. colors: Bhattacharyya coefficient with the first frame's colors.
    contrast: mean P(target | pixel) in the box less half that round it. first: the first frame's filter's
    answer. depth: mean P(target | depth) in the box less its prior, 0 without depth.
    """

    sharpness: float
    order: float
    colors: float
    contrast: float
    first: float
    depth: float

    @property
    def log_odds(self) -> float:
        """Of the target being there; above 0 it rather is."""
        return OFFSET + sum(WEIGHTS[name] * value for name, value in zip(self._fields, self, strict=True))

    @property
    def score(self) -> float:
        """The same as a probability."""
        return 1 / (1 + math.exp(-min(max(self.log_odds, -50.0), 50.0)))


class Identity(NamedTuple):
    """What is remembered of the target's look: colors (4096,) of the first frame, which never learn, and its
    ranks (3, n), which do.
    """

    colors: Plane
    ranks: Plane

    @classmethod
    def start(cls, view: View, ranks: Plane) -> "Identity":
        """Of the first frame."""
        return cls(colors_of(view, 0.0, 0.0), ranks)

    def likeness(self, view: View, right: float, down: float) -> float:
        """Bhattacharyya coefficient of the colors so many patch pixels off the view's middle."""
        return float(np.sqrt(colors_of(view, right, down) * self.colors).sum())

    def order(self, ranks: Plane) -> float:
        """Mean distance of ranks (3, n)."""
        return float(np.abs(ranks - self.ranks).mean())

    def learnt(self, ranks: Plane, rate: float) -> "Identity":
        """With the ranks of a found target blended in."""
        return Identity(self.colors, self.ranks + np.float32(rate) * (ranks - self.ranks))


def colors_of(view: View, right: float, down: float) -> Plane:
    """(4096,) histogram of the middle of a target's box."""
    pixels: Image = view.patch[view.inner(right, down, share=0.8)]
    samples = np.ascontiguousarray(pixels.reshape(-1, 3).T)[None]
    return view.sight.k.joint_histogram(samples, BINS)[0]
