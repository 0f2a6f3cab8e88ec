# SPDX-License-Identifier: MIT
"""The color term of the likelihood: how much more a window has of the target's colors than its surround has.

What the paper calls skin color modeling, but relative to what is round this target: Bayes' rule with equal priors on
two joint color histograms. It says where the target ends, which ranks inside the window can't.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.pattern import ring

Samples = NDArray[np.uint8]
Floats = NDArray[np.floating[Any]]

BINS = 16
DENSE = 600  # places read for learning, in the target and round it
TARGET, SURROUND = ring(DENSE, 0.0, 1.0), ring(DENSE, 1.15, 2.0)
RARE = np.float32(1e-4)  # a cell's share under which it says little about either side


class ColorContrast:
    """Colors of the target and of its surround, and the table of P(target | color)."""

    def __init__(self, weight: float) -> None:
        self.weight = weight
        self.target: Floats = np.empty(0)
        self.surround: Floats = np.empty(0)
        self.table: Floats = np.empty(0)

    def learn(self, k: Kernels, image: Samples, ellipse: Floats, rate: float) -> None:
        """Blend the colors in and round the ellipse (1, 4) into the histograms; a rate of 1 starts them."""
        target, surround = (
            k.joint_histogram(k.sample_ellipses(image, ellipse, places), BINS)[0]
            for places in (TARGET, SURROUND)
        )
        if rate < 1:
            target, surround = blend(self.target, target, rate), blend(self.surround, surround, rate)
        self.target, self.surround = target, surround
        self.table = (target / (target + surround + RARE)).reshape(BINS, BINS, BINS)

    def log_likelihood(self, k: Kernels, inside: Samples, around: Samples) -> Floats:
        """(N,) weight times the mean P(target) in the window minus that round it."""
        within = k.color_lookup(inside, self.table).sum(axis=1, dtype=np.float64)
        without = k.color_lookup(around, self.table).sum(axis=1, dtype=np.float64)
        within *= self.weight / inside.shape[2]
        without *= self.weight / around.shape[2]
        within -= without
        return within


def blend(old: Floats, new: Floats, rate: float) -> Floats:
    """old + rate (new - old), in the memory of ``new``."""
    new -= old
    new *= np.float32(rate)
    new += old
    return new
