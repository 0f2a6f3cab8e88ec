# SPDX-License-Identifier: MIT
"""Whether a place shows the target: features, and the log-odds that they give."""

import math
import operator
from typing import NamedTuple

import numpy as np

from tricue.track.fused.arrays import Image, Plane
from tricue.track.fused.experts.color import HISTOGRAM_BINS
from tricue.track.fused.target_observation import PictureKind
from tricue.track.fused.window import INNER_SHARE, Window

# Weights of the IdentityFeatures, in their order, by logistic regression on 30 recorded color videos: "the
# overlap is above 0.3" against "under 0.1". Samples are the tracker's own places and random ones, each video
# with the same weight.
FEATURE_WEIGHTS, FEATURE_OFFSET = (0.13, 3.7, 7.4, 8.8), -6.3
STRUCTURE_WEIGHTS, STRUCTURE_OFFSET = (0.16, 0.0, 0.0, 12.3), -2.4  # without what light changes
DEPTH_PICTURE_OFFSET = -6.0  # of the log-odds in a picture of depth, in which most things look alike
MAX_LOG_ODDS = 50.0  # beyond it a probability doesn't change


class IdentityFeatures(NamedTuple):
    """What tells whether a place shows the target.

    peak_sharpness: standard deviations of the filter's peak above its mean response.
    color_similarity: Bhattacharyya coefficient with the first frame's colors.
    contrast: mean P(target | pixel) in the box less a share of that in its surround.
    first_response: of the first frame's filter.
    """

    peak_sharpness: float
    color_similarity: float
    contrast: float
    first_response: float

    def log_odds(self, kind: PictureKind) -> float:
        """Of the target against anything else, in a picture of color or of depth."""
        offset = DEPTH_PICTURE_OFFSET if kind == "depth" else 0.0
        return FEATURE_OFFSET + self._weighted_sum(FEATURE_WEIGHTS) + offset

    @property
    def structure_log_odds(self) -> float:
        """The same by the features that light doesn't change."""
        return STRUCTURE_OFFSET + self._weighted_sum(STRUCTURE_WEIGHTS)

    def _weighted_sum(self, weights: tuple[float, ...]) -> float:
        return float(sum(map(operator.mul, weights, self)))


def probability(log_odds: float) -> float:
    """The probability in [0, 1] with some log-odds."""
    return 1 / (1 + math.exp(-min(max(log_odds, -MAX_LOG_ODDS), MAX_LOG_ODDS)))


class FirstColors(NamedTuple):
    """The target's colors in the first frame, which never learn.

    roots: (4096,) square roots of its histogram.
    """

    roots: Plane

    @classmethod
    def from_window(cls, window: Window) -> "FirstColors":
        """Of the target at the window's center."""
        return cls(np.sqrt(color_histogram(window, 0.0, 0.0)))

    def similarity(self, window: Window, right: float, down: float) -> float:
        """Bhattacharyya coefficient of the colors so many patch pixels off the window's center."""
        return float(np.vdot(np.sqrt(color_histogram(window, right, down)), self.roots))


def color_histogram(window: Window, right: float, down: float) -> Plane:
    """(4096,) of the inner part of the target's box, so many patch pixels off the window's center."""
    pixels: Image = window.patch[window.inner(right, down, INNER_SHARE)]
    samples = np.ascontiguousarray(pixels.transpose(2, 0, 1)).reshape(1, 3, -1)
    histogram: Plane = window.observation.k.joint_histogram(samples, HISTOGRAM_BINS)[0]
    return histogram
