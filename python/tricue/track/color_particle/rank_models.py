# SPDX-License-Identifier: MIT
"""The observation models by color ranks, section III.B, which don't change with brightness."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Image, Singles
from tricue.kernels import Kernels
from tricue.track.color_particle.observation_model import (
    NO_MODEL,
    Samples,
    WindowSamples,
    blend,
    recognition_by_distance,
    window_grid,
)
from tricue.track.color_particle.params import ColorParticleParams

RANK_QUANTILES = 16  # of the paper's color ranks
MIN_RANK_SPREAD = 0.1  # sum of squared deviations of ranks; below it a window is flat and has no order


class RankWindow(NamedTuple):
    """The order of the pixels in one window."""

    ranks: Singles  # (3, n)
    correlations: Floats  # (2,) in [0, 1], with the learned map and with the first frame's


class RankSpatial(NamedTuple):
    """The order of corresponding pixels, the idea that section III.B states in words.

    It keeps the first frame's rank map beside the learned one, so that errors don't accumulate.
    """

    weights: Floats  # (2,) of the learned map and the first frame's
    maps: Singles  # (2, 3, n) both maps, (0, 3, n) before the first frame is learned
    sharpness: float = 110.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "RankSpatial":
        weights = np.array([1 - p.first_frame_weight, p.first_frame_weight])
        return cls(weights, np.empty((0, 3, len(window_grid(p))), np.float32))

    def observe(self, k: Kernels, image: Image, ellipse: Floats, grid: Floats) -> RankWindow:
        """The observation of the window of an ellipse (4,)."""
        return RankWindow(*k.rank_window(image, ellipse, grid, self.maps, MIN_RANK_SPREAD))

    def learn(self, k: Kernels, seen: RankWindow, rate: float) -> "RankSpatial":
        if len(self.maps) == 0:
            return RankSpatial(self.weights, np.stack([seen.ranks, seen.ranks]))
        return RankSpatial(self.weights, k.learn_ranks(self.maps, seen.ranks, rate))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        distances = k.rank_distance(inside, self.maps)
        combined: Floats = distances.min(axis=1) if searching else distances @ self.weights
        return combined

    def recognition(self, k: Kernels, seen: RankWindow, searching: bool = False) -> float:
        """The rank correlation, which is 0 for a flat window although its distance is small."""
        correlations: list[float] = seen.correlations.tolist()
        return max(correlations) if searching else correlations[0]


class RankSections(NamedTuple):
    """Equations (19)-(29), a^k divided by its sum: how many levels each quantile spans."""

    sections: Singles = NO_MODEL
    sharpness: float = 400.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "RankSections":
        return cls()

    def learn(self, k: Kernels, seen: WindowSamples, rate: float) -> "RankSections":
        return RankSections(blend(self.sections, k.rank_sections(seen.inside, RANK_QUANTILES)[0], rate))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return k.section_distance(k.rank_sections(inside, RANK_QUANTILES), self.sections)

    def recognition(self, k: Kernels, seen: WindowSamples, searching: bool = False) -> float:
        return recognition_by_distance(self, k, seen, unrelated=0.3)
