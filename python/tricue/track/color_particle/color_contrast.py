# SPDX-License-Identifier: MIT
"""The color term of the likelihood: how much more of the target's colors a window has than its surround.

It replaces the paper's skin color model, and is relative to this target's surround. Bayes' rule with equal
priors on two joint color histograms gives P(target | color). This term locates the target's edge, which the
ranks of the pixels inside the window can't.
"""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Image, Singles
from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import EllipsePattern, ring
from tricue.track.color_particle.observation_model import Samples

CONTRAST_BINS = 16  # per channel
EMPTY_HISTOGRAM: Singles = np.zeros((CONTRAST_BINS, CONTRAST_BINS, CONTRAST_BINS), np.float32)
CONTRAST_SAMPLES = 600  # learned inside the target, and the same number around it
PATTERN = EllipsePattern(ring(CONTRAST_SAMPLES, 0.0, 1.0), ring(CONTRAST_SAMPLES, 1.15, 2.0))
MIN_CELL_SHARE = 1e-4  # of the samples; cells with fewer are uninformative


class ColorContrast(NamedTuple):
    """Joint color histograms of the target and of its surround, and the table of P(target | color).

    Each is (16, 16, 16) float32. weight: of this term in the log-likelihood, nats.
    """

    weight: float
    target: Singles = EMPTY_HISTOGRAM
    surround: Singles = EMPTY_HISTOGRAM
    table: Singles = EMPTY_HISTOGRAM
    skipped: bool = False  # whether the last frame was skipped in learning

    def learn(self, k: Kernels, image: Image, ellipse: Floats, rate: float) -> "ColorContrast":
        """Blend in the colors inside and around the ellipse (4,); a rate of 1 initializes the histograms.

        Colors change slowly: only every second call learns, with twice the rate.
        """
        if rate < 1 and not self.skipped:
            return ColorContrast(self.weight, self.target, self.surround, self.table, skipped=True)
        rate = min(2 * rate, 1.0)
        tables = k.learn_contrast(image, ellipse, PATTERN, self.target, self.surround, rate, MIN_CELL_SHARE)
        return ColorContrast(self.weight, *tables)

    def log_likelihood(self, k: Kernels, inside: Samples, around: Samples) -> Floats:
        """(N,) nats: the weight times the mean of P(target | color) inside minus its mean around."""
        mean_inside, mean_around = (
            k.color_lookup(samples, self.table).mean(axis=1, dtype=np.float64) for samples in (inside, around)
        )
        log_likelihood: Floats = self.weight * (mean_inside - mean_around)
        return log_likelihood
