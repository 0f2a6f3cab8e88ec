# SPDX-License-Identifier: MIT
"""The observation models by color ranks, section III.B: which changes of brightness leave."""

import math
from typing import NamedTuple

import numpy as np

from tricue.kernels import Kernels
from tricue.track.color_particle.observation_model import (
    NO_MODEL,
    Floats,
    Samples,
    Singles,
    blend,
    distance_score,
)
from tricue.track.color_particle.params import ColorParticleParams

RANK_QUANTILES = 16  # of the printed color ranks
MIN_RANK_SPREAD = 0.1  # sum of squared deviations of ranks; below it a window is flat and has no order


def rank_correlation(a: Singles, b: Singles) -> float:
    """Spearman's correlation of two rank maps, at least 0.

    The mean of a map is 1/2, so sum(a b) - N / 4 is the sum of the products of their deviations.
    """
    ab, aa, bb = float(np.vdot(a, b)), float(np.vdot(a, a)), float(np.vdot(b, b))
    even = a.size / 4
    if min(aa, bb) - even <= MIN_RANK_SPREAD:
        return 0.0
    return min(max(ab - even, 0.0) / math.sqrt((aa - even) * (bb - even)), 1.0)


class RankSpatial(NamedTuple):
    """The order of corresponding pixels: what section III.B argues for in words.

    Keeps the first frame's rank map beside the learned one, so that errors don't add up.
    """

    weights: Floats  # (2,) of the learned map and of the first frame's
    maps: Singles = NO_MODEL  # (2, 3, n) both
    sharpness: float = 110.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "RankSpatial":
        return cls(np.array([1 - p.first_frame_weight, p.first_frame_weight]))

    def learn(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "RankSpatial":
        ranks = k.color_ranks(inside[:1])
        if rate >= 1:
            return RankSpatial(self.weights, np.concatenate([ranks, ranks]))
        maps = self.maps.copy()
        learned = maps[0]
        change = ranks[0] - learned
        change *= np.float32(rate)
        learned += change
        return RankSpatial(self.weights, maps)

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        distances = k.rank_distance(inside, self.maps)
        combined: Floats = distances.min(axis=1) if searching else distances @ self.weights
        return combined

    def score(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        """The rank correlation: it is 0 for a flat window, though the distance of that is small."""
        ranks = k.color_ranks(inside[:1])[0]
        maps = self.maps if searching else self.maps[:1]
        return max(rank_correlation(ranks, each) for each in maps)


class RankSections(NamedTuple):
    """Equations (19)-(29) as printed: a^k, of sum 1, tells how many levels each quantile spans."""

    sections: Singles = NO_MODEL
    sharpness: float = 400.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "RankSections":
        return cls()

    def learn(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "RankSections":
        return RankSections(blend(self.sections, k.rank_sections(inside[:1], RANK_QUANTILES)[0], rate))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return k.section_distance(k.rank_sections(inside, RANK_QUANTILES), self.sections)

    def score(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        return distance_score(self, k, inside, around, unrelated=0.3)
