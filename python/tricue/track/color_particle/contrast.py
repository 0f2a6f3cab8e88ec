# SPDX-License-Identifier: MIT
"""The color term of the likelihood: how much more a window has of the target's colors than its surround.

What the paper calls skin color modeling, but relative to what is round this target: Bayes' rule with equal
priors on two joint color histograms. It says where the target ends, which ranks inside the window can't.
"""

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import ring

Samples = NDArray[np.uint8]
Ellipses = NDArray[np.float64]

BINS = 16
DENSE = 600  # places read for learning, in the target and round it
TARGET, SURROUND = ring(DENSE, 0.0, 1.0), ring(DENSE, 1.15, 2.0)
RARE = 1e-4  # a cell's share under which it says little about either side


class ColorContrast:
    """Colors of the target and of its surround, and the table of P(target | color)."""

    def __init__(self, weight: float) -> None:
        self.weight = weight
        self.target = self.surround = self.table = np.zeros((BINS, BINS, BINS), np.float32)
        self.rested = False

    def learn(self, k: Kernels, image: Samples, ellipse: Ellipses, rate: float) -> None:
        """Blend the colors in and round the ellipse (1, 4) into the histograms; a rate of 1 starts them.

        Colors change slowly: they are learnt every second time, with twice the rate.
        """
        self.rested = rate < 1 and not self.rested
        if self.rested:
            return
        inside, around = (k.sample_ellipses(image, ellipse, places) for places in (TARGET, SURROUND))
        self.target, self.surround, self.table = k.learn_contrast(
            inside, around, self.target, self.surround, min(2 * rate, 1.0), RARE
        )

    def log_likelihood(self, k: Kernels, inside: Samples, around: Samples) -> Ellipses:
        """(N,) weight times the mean P(target) in the window minus that round it."""
        within, without = (
            k.color_lookup(samples, self.table).mean(axis=1, dtype=np.float64) for samples in (inside, around)
        )
        log_likelihood: Ellipses = self.weight * (within - without)
        return log_likelihood
