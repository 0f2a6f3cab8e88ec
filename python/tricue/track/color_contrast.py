# SPDX-License-Identifier: MIT
"""The color term of the likelihood: how much more a window has of the target's colors than its surround has.

What the paper calls skin color modeling, but relative to what is round this target: Bayes' rule with equal
priors on two joint color histograms. It says where the target ends, which ranks inside the window can't.
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

    def __init__(self) -> None:
        self.histograms: Floats = np.empty(0)
        self.table: Floats = np.empty(0)

    def learn(self, k: Kernels, image: Samples, ellipse: Floats, rate: float) -> None:
        """Blend the colors in and round the ellipse (1, 4) into the histograms; rate 1 starts them."""
        new = np.concatenate(
            [
                k.joint_histogram(k.sample_ellipses(image, ellipse, places), BINS)
                for places in (TARGET, SURROUND)
            ]
        )
        if rate >= 1:
            self.histograms = new
        else:
            new -= self.histograms
            new *= np.float32(rate)
            self.histograms += new
        target, surround = self.histograms
        self.table = (target / (target + surround + RARE)).reshape(BINS, BINS, BINS)

    def measure(self, k: Kernels, inside: Samples, surround: Samples) -> Floats:
        """(N,) mean P(target) in the window minus that round it, in [-1, 1]."""
        return _means(k.color_lookup(inside, self.table)) - _means(k.color_lookup(surround, self.table))


def _means(values: Floats) -> Floats:
    n = values.shape[1]
    return values @ np.full(n, 1 / n, np.float32)
