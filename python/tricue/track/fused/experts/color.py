# SPDX-License-Identifier: MIT
"""The color expert: which colors are the target's, and which its surround's."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tricue.arrays import Plane
from tricue.track.base.params import Params, parameter
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.window import Window

HISTOGRAM_BINS = 16  # per color channel
MIN_COLOR_SHARE = 1e-4  # of a histogram; a rarer color tells little about target or surround
MIN_SURROUND_SIZE = 1.1  # of the box: pixels outside of that are learned as the surround's
MIN_TARGET_POSTERIOR = 0.4  # P(target | depth) of pixels that are learned as the target's
MAX_SURROUND_POSTERIOR = 0.1  # P(target | depth) of pixels that are learned as the surround's


@dataclass(frozen=True, kw_only=True)
class ColorParams(Params):
    """The parameters of the cue "color"."""

    color_weight: float = parameter(
        0.3, unit="-", source=PROTOTYPE, low=0, doc="weight of the posterior's contrast"
    )
    color_learning_rate: float = parameter(
        0.04,
        unit="per frame",
        source="Bertinetto et al. 2016",
        low=0,
        high=0.5,
        doc="learning rate of the histograms",
        was="color_rate",
    )
    surround_size: float = parameter(
        1.5, unit="box", source=PROTOTYPE, above=1, doc="outer size of the contrast's surround", was="frame"
    )
    surround_weight: float = parameter(
        0.5, unit="-", source=PROTOTYPE, low=0, doc="weight of the surround in the contrast", was="around"
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
        """The expert learned from the first frame."""
        empty = np.zeros((HISTOGRAM_BINS, HISTOGRAM_BINS, HISTOGRAM_BINS), np.float32)
        return cls(empty, empty, empty).learn(window, 1.0)

    def learn(self, window: Window, rate: float) -> "ColorExpert":
        """The expert with a window around the target blended in.

        Pixels in the box that are farther or nearer than the target are learned as the surround's.
        """
        width, height = (round(side, 1) for side in window.size)
        return ColorExpert(
            *window.observation.k.learn_patch_colors(
                window.patch,
                window.depth_posterior,
                (width, height, MIN_SURROUND_SIZE, MIN_TARGET_POSTERIOR, MAX_SURROUND_POSTERIOR),
                self.target,
                self.surround,
                rate,
                MIN_COLOR_SHARE,
            )
        )
