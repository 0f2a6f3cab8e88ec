# SPDX-License-Identifier: MIT
"""Whether a place shows the target: features, and the log-odds computed from them."""

import math
import operator
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Image, Plane
from tricue.track.fused.experts.color import HISTOGRAM_BINS
from tricue.track.fused.window import INNER_SHARE, Window


class Weights(NamedTuple):
    """Log-odds per unit of each of the IdentityFeatures, in their order, and of their changes; an offset."""

    features: tuple[float, float, float, float]
    change: tuple[float, float, float, float]
    offset: float


# Fitted by logistic regression on 30 recorded color videos: "the overlap is above 0.3" against "under 0.1, or
# the target is covered" (python -m benchmarks.quality.identity_fit). Features that added nothing have weight
# 0. The offsets are 0.7 above the fitted ones.
APPEARANCE = Weights((0.0, 1.5, 7.7, 13.1), (0.2, 5.0, 0.0, 7.9), -4.0)
STRUCTURE = Weights((0.0, 0.0, 0.0, 17.2), (0.2, 0.0, 0.0, 11.7), -1.2)  # without features that light changes
DEPTH_PICTURE_OFFSET = -3.0  # of the log-odds in a picture of depth, in which most things look similar
# Platt scaling (Platt 1999), fitted on tracks of the same videos (python -m benchmarks.quality.score_fit).
# The offset is positive because a followed target is usually still there; the slope is below 1 because the
# evidence of consecutive frames is similar.
SCORE_SLOPE, SCORE_OFFSET = 0.5, 2.0
STRUCTURE_ONLY_PENALTY = 2.0  # log-odds
MAX_LOG_ODDS = 50.0  # beyond it the probability doesn't change


class IdentityFeatures(NamedTuple):
    """The features that tell whether a place shows the target.

    peak_sharpness: height of the filter's peak above its mean response, in standard deviations.
    color_similarity: Bhattacharyya coefficient with the first frame's colors.
    contrast: mean P(target | pixel) in the box minus a share of the mean in its surround.
    first_response: response of the first frame's filter.
    """

    peak_sharpness: float
    color_similarity: float
    contrast: float
    first_response: float

    def log_odds(self, typical: "IdentityFeatures | None", weights: Weights) -> float:
        """Log-odds that this is the target, from the features and their differences from typical values.

        typical: running means of the features; None until the target is recognized after the first frame.
        """
        change = map(operator.sub, self, typical or SECOND_FRAME)
        return weights.offset + _weighted_sum(weights.features, self) + _weighted_sum(weights.change, change)

    def blend(self, other: "IdentityFeatures", rate: float) -> "IdentityFeatures":
        """The features moved toward others by a share ``rate`` of the difference."""
        return IdentityFeatures(*(old + rate * (new - old) for old, new in zip(self, other, strict=True)))


# Used until typical values are known. In the second frame, 95 % of the targets of the same videos have at
# least these values; a black image or noise has much lower ones.
SECOND_FRAME = IdentityFeatures(7.6, 0.68, 0.33, 0.24)


def _weighted_sum(weights: Iterable[float], values: Iterable[float]) -> float:
    return float(sum(map(operator.mul, weights, values)))


def in_any_light(log_odds: float, structure_log_odds: float) -> float:
    """Log-odds in a color picture: as light may have changed the colors, the structure alone may suffice."""
    return max(log_odds, structure_log_odds - STRUCTURE_ONLY_PENALTY)


def score_of(log_odds: float) -> float:
    """The probability in [0, 1] that a place with these log-odds shows a followed target."""
    calibrated = SCORE_SLOPE * log_odds + SCORE_OFFSET
    return 1 / (1 + math.exp(-min(max(calibrated, -MAX_LOG_ODDS), MAX_LOG_ODDS)))


def log_odds_of(score: float) -> float:
    """The log-odds that give this score in [0, 1]: the inverse of :func:`score_of`."""
    if score in (0.0, 1.0):
        return math.copysign(MAX_LOG_ODDS / SCORE_SLOPE, score - 0.5)
    return (math.log(score / (1 - score)) - SCORE_OFFSET) / SCORE_SLOPE


class FirstColors(NamedTuple):
    """The target's colors in the first frame, which are never updated.

    roots: (4096,) square roots of its histogram.
    """

    roots: Floats

    @classmethod
    def from_window(cls, window: Window) -> "FirstColors":
        """The colors of the target at the window's center."""
        return cls(np.sqrt(color_histogram(window).astype(float)))


def color_histogram(window: Window) -> Plane:
    """(4096,) histogram of the inner part of the target's box at the window's center."""
    pixels: Image = window.patch[window.inner(share=INNER_SHARE)]
    samples = np.ascontiguousarray(pixels.transpose(2, 0, 1)).reshape(1, 3, -1)
    histogram: Plane = window.observation.k.joint_histogram(samples, HISTOGRAM_BINS)[0]
    return histogram
