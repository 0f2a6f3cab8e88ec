# SPDX-License-Identifier: MIT
"""The color term of the likelihood: how much more a window has of the target's colors than its surround.

What the paper calls skin color modeling, but relative to what is round this target: Bayes' rule with equal
priors on two joint color histograms. It says where the target ends, which ranks inside the window can't.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import ring

Samples = NDArray[np.uint8]
Ellipses = NDArray[np.float64]
Table = NDArray[np.float32]

BINS = 16
EMPTY: Table = np.zeros((BINS, BINS, BINS), np.float32)
LEARNED_SAMPLES = 600  # in the target, and as many around it
TARGET, SURROUND = ring(LEARNED_SAMPLES, 0.0, 1.0), ring(LEARNED_SAMPLES, 1.15, 2.0)
MIN_SHARE = 1e-4  # of a cell, under which it says little about either side


class ColorContrast(NamedTuple):
    """Colors of the target and of its surround, and the table of P(target | color); (16, 16, 16) each."""

    weight: float
    target: Table = EMPTY
    surround: Table = EMPTY
    table: Table = EMPTY
    rested: bool = False  # whether the last frame was left out

    def learned(self, k: Kernels, image: Samples, ellipse: Ellipses, rate: float) -> "ColorContrast":
        """With the colors in and around the ellipse (1, 4) blended in; a rate of 1 starts the histograms.

        Colors change slowly: they are learned every second time, with twice the rate.
        """
        if rate < 1 and not self.rested:
            return self._replace(rested=True)
        inside, around = (k.sample_ellipses(image, ellipse, places) for places in (TARGET, SURROUND))
        tables = k.learn_contrast(inside, around, self.target, self.surround, min(2 * rate, 1.0), MIN_SHARE)
        return ColorContrast(self.weight, *tables)

    def log_likelihood(self, k: Kernels, inside: Samples, around: Samples) -> Ellipses:
        """(N,) weight times the mean P(target) in the window minus that round it."""
        within, without = (
            k.color_lookup(samples, self.table).mean(axis=1, dtype=np.float64) for samples in (inside, around)
        )
        log_likelihood: Ellipses = self.weight * (within - without)
        return log_likelihood
