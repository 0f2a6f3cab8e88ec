# SPDX-License-Identifier: MIT
"""The color term of the likelihood: how much more a window has of the target's colors than its surround.

What the paper calls skin color modeling, but relative to what is round this target: Bayes' rule with equal
priors on two joint color histograms. It says where the target ends, which ranks inside the window can't.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.pattern import ring

Samples = NDArray[np.uint8]
Floats = NDArray[np.float32]
Ellipses = NDArray[np.float64]

UNKNOWN: Floats = np.empty(0, np.float32)
BINS = 16
DENSE = 600  # places read for learning, in the target and round it
TARGET, SURROUND = ring(DENSE, 0.0, 1.0), ring(DENSE, 1.15, 2.0)
RARE = np.float32(1e-4)  # a cell's share under which it says little about either side


class ColorContrast:
    """Colors of the target and of its surround, and the table of P(target | color)."""

    def __init__(self, weight: float) -> None:
        self.weight = weight
        self.target: Floats = UNKNOWN
        self.surround: Floats = UNKNOWN
        self.table: Floats = UNKNOWN
        self.rested = False

    def learn(self, k: Kernels, image: Samples, ellipse: Ellipses, rate: float) -> None:
        """Blend the colors in and round the ellipse (1, 4) into the histograms; a rate of 1 starts them.

        Colors change slowly: they are learnt every second time, with twice the rate.
        """
        self.rested = rate < 1 and not self.rested
        if self.rested:
            return
        target, surround = (_colors(k, image, ellipse, places) for places in (TARGET, SURROUND))
        if rate < 1:
            _blend(self.target, target, 2 * rate)
            _blend(self.surround, surround, 2 * rate)
        self.target, self.surround = target, surround
        both = target + surround
        both += RARE
        self.table = np.divide(target, both, out=both).reshape(BINS, BINS, BINS)

    def log_likelihood(self, k: Kernels, inside: Samples, around: Samples) -> Floats:
        """(N,) weight times the mean P(target) in the window minus that round it."""
        within, without = k.color_lookup(inside, self.table), k.color_lookup(around, self.table)
        return _means(within, self.weight) - _means(without, self.weight)


@cache
def _share(n: int, weight: float) -> Floats:
    return np.full(n, weight / n, np.float32)


def _means(values: Floats, weight: float) -> Floats:
    """(N,) the means of the rows of (N, n), times the weight: a product is quicker than a mean."""
    means: Floats = values @ _share(values.shape[1], weight)
    return means


def _colors(k: Kernels, image: Samples, ellipse: Ellipses, places: Ellipses) -> Floats:
    histogram: Floats = k.joint_histogram(k.sample_ellipses(image, ellipse, places), BINS)[0]
    return histogram


def _blend(old: Floats, new: Floats, rate: float) -> None:
    """Make ``new`` old + rate (new - old), in its own memory."""
    new -= old
    new *= np.float32(min(rate, 1.0))
    new += old
