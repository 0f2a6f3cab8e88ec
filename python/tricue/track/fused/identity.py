# SPDX-License-Identifier: MIT
"""Whether a place shows the target: features, and the log-odds that they give."""

import math
import operator
from typing import NamedTuple

import numpy as np

from tricue.track.fused.arrays import Image, Plane
from tricue.track.fused.experts.color import HISTOGRAM_BINS
from tricue.track.fused.window import INNER_SHARE, Window

# Weights of the IdentityFeatures, in their order, by logistic regression with the signs that they have to
# have: "the overlap is above 0.3" against "under 0.1". Samples are the tracker's own places, random places
# and look-alikes, in six recorded videos and in scenes with other seeds than those of the tables.
FEATURE_WEIGHTS, FEATURE_OFFSET = (0.32, -15.64, 7.33, 11.19, 12.29), -10.6
STRUCTURE_WEIGHTS, STRUCTURE_OFFSET = (0.44, -7.19, 0.0, 0.0, 11.07), -4.91  # without what light changes
# Slope and offset of the log-odds by channels: with depth contrasts are higher, so that they tell less.
CHANNEL_CALIBRATION = {"color": (1.0, 0.0), "both": (1.0, -1.0), "depth": (0.36, -4.7)}
MAX_LOG_ODDS = 50.0  # beyond it a probability doesn't change


class IdentityFeatures(NamedTuple):
    """What tells whether a place shows the target.

    peak_sharpness: standard deviations of the filter's peak above its mean response.
    rank_distance: mean distance of its ranks from the learned ones, in [0, 1].
    color_similarity: Bhattacharyya coefficient with the first frame's colors.
    contrast: mean P(target | pixel) in the box less a share of that in its surround.
    first_response: of the first frame's filter.
    """

    peak_sharpness: float
    rank_distance: float
    color_similarity: float
    contrast: float
    first_response: float

    def log_odds(self, channels: str) -> float:
        """Of the target against anything else; channels: a key of CHANNEL_CALIBRATION."""
        slope, offset = CHANNEL_CALIBRATION[channels]
        return slope * (FEATURE_OFFSET + self._weighted_sum(FEATURE_WEIGHTS)) + offset

    @property
    def structure_log_odds(self) -> float:
        """The same by the features that light doesn't change."""
        return STRUCTURE_OFFSET + self._weighted_sum(STRUCTURE_WEIGHTS)

    def _weighted_sum(self, weights: tuple[float, ...]) -> float:
        return float(sum(map(operator.mul, weights, self)))


def probability(log_odds: float) -> float:
    """The probability in [0, 1] with some log-odds."""
    return 1 / (1 + math.exp(-min(max(log_odds, -MAX_LOG_ODDS), MAX_LOG_ODDS)))


class IdentityModel(NamedTuple):
    """What the target is compared with.

    color_roots: (4096,) square roots of its color histogram in the first frame, which never learn.
    ranks: (3, n), which do.
    """

    color_roots: Plane
    ranks: Plane

    @classmethod
    def from_window(cls, window: Window, ranks: Plane) -> "IdentityModel":
        """Of the first frame, whose target is at the window's center."""
        return cls(np.sqrt(color_histogram(window, 0.0, 0.0)), ranks)

    def color_similarity(self, window: Window, right: float, down: float) -> float:
        """Bhattacharyya coefficient of the colors so many patch pixels off the window's center."""
        return float(np.vdot(np.sqrt(color_histogram(window, right, down)), self.color_roots))

    def rank_distance(self, ranks: Plane) -> float:
        """Mean absolute difference from ranks (3, n)."""
        return float(np.abs(ranks - self.ranks).sum()) / ranks.size

    def learn(self, ranks: Plane, rate: float) -> "IdentityModel":
        """The model with ranks (3, n) blended in."""
        return IdentityModel(self.color_roots, self.ranks + np.float32(rate) * (ranks - self.ranks))


def color_histogram(window: Window, right: float, down: float) -> Plane:
    """(4096,) of the inner part of the target's box, so many patch pixels off the window's center."""
    pixels: Image = window.patch[window.inner(right, down, INNER_SHARE)]
    samples = np.ascontiguousarray(pixels.transpose(2, 0, 1)).reshape(1, 3, -1)
    histogram: Plane = window.observation.k.joint_histogram(samples, HISTOGRAM_BINS)[0]
    return histogram
