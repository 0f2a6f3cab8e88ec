# SPDX-License-Identifier: MIT
"""Which colors are the target's, and which its surround's."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.params import Params, parameter
from tricue.track.fused.arrays import Plane
from tricue.track.fused.sources import OURS
from tricue.track.fused.window import PATCH_PIXELS, Window

HISTOGRAM_BINS = 16  # per color channel
MIN_COLOR_SHARE = 1e-4  # of a histogram; rarer colors tell little about either side
MIN_SURROUND_SIZE = 1.1  # of the box: colors outside of it are the surround's
MIN_TARGET_POSTERIOR = 0.4  # P(target | depth) of pixels that are learned as the target's
MAX_SURROUND_POSTERIOR = 0.1  # P(target | depth) of pixels that are learned as the surround's


@dataclass(frozen=True, kw_only=True)
class ColorParams(Params):
    """Of the cue "color"."""

    color_weight: float = parameter(0.3, unit="-", source=OURS, low=0, doc="of the posterior's contrast")
    color_learning_rate: float = parameter(
        0.04,
        unit="per frame",
        source="Bertinetto et al. 2016",
        low=0,
        high=0.5,
        doc="of the histograms",
        was="color_rate",
    )
    surround_size: float = parameter(
        1.5, unit="box", source=OURS, above=1, doc="outer size of the contrast's surround", was="frame"
    )
    surround_weight: float = parameter(
        0.5, unit="-", source=OURS, low=0, doc="of the surround in the contrast", was="around"
    )


class ColorExpert(NamedTuple):
    """Histograms of the target's and the surround's colors, (16, 16, 16) each.

    table: (16, 16, 16) P(target | color).
    """

    target: Plane
    surround: Plane
    table: Plane

    @classmethod
    def from_window(cls, window: Window) -> "ColorExpert":
        """Learned from the first frame."""
        empty = np.zeros((HISTOGRAM_BINS, HISTOGRAM_BINS, HISTOGRAM_BINS), np.float32)
        return cls(empty, empty, empty).learn(window, 1.0)

    def posterior(self, window: Window) -> Plane:
        """(64, 64) P(target | color) of the patch's pixels."""
        return window.observation.k.color_posterior(window.patch, self.table)

    def learn(self, window: Window, rate: float) -> "ColorExpert":
        """The expert with a window blended in, whose center is the target's.

        Pixels in the box that are farther or nearer than the target are learned as its surround.
        """
        inside, outside = _target_and_surround(window)
        colors, k = window.colors[0], window.observation.k
        own, other = (colors.take(each, axis=1)[None] for each in (inside, outside))
        return ColorExpert(*k.learn_contrast(own, other, self.target, self.surround, rate, MIN_COLOR_SHARE))


def _target_and_surround(window: Window) -> tuple[NDArray[Any], NDArray[Any]]:
    """Indices of the 4096 pixels that are the target's, and of the surround's."""
    inside, outside = ellipse_and_surround(round(window.size[0], 1), round(window.size[1], 1))
    if window.depth is None:
        return inside, outside
    by_depth = window.depth[0].take(inside)
    own = inside[by_depth > MIN_TARGET_POSTERIOR]
    if 2 * len(own) > len(inside):
        return own, np.concatenate([outside, inside[by_depth < MAX_SURROUND_POSTERIOR]])
    return inside, outside


@lru_cache(maxsize=64)
def ellipse_and_surround(width: float, height: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Indices of the patch's pixels in the ellipse of a target's size, and of those outside of its box."""
    offset = np.abs(np.arange(PATCH_PIXELS) + 0.5 - PATCH_PIXELS / 2)
    u, v = offset[None] / max(width / 2, 1.0), offset[:, None] / max(height / 2, 1.0)
    inside, outside = u * u + v * v <= 1, np.maximum(u, v) > MIN_SURROUND_SIZE
    if not outside.any():
        outside = ~inside
    return np.flatnonzero(inside), np.flatnonzero(outside)
