# SPDX-License-Identifier: MIT
"""The correlation filter: it responds where edges and colors are arranged as in the target."""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Plane
from tricue.track.base.params import parameter
from tricue.track.fused.experts.spectra import CHANNELS, FirstFrameParams, Spectra, label_spectrum
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.window import CELL_PIXELS, HANN_WINDOW, WINDOW_CELLS, Window, WindowParams


@dataclass(frozen=True, kw_only=True)
class FilterParams(FirstFrameParams, WindowParams):
    """The parameters of the cue "filter"."""

    label_width: float = parameter(
        0.1,
        unit="target",
        source="Danelljan et al. 2014",
        above=0,
        high=1,
        doc="standard deviation of the desired response",
    )
    temporal_weight: float = parameter(
        2.0, unit="-", source="Li et al. 2018", low=0, doc="weight that keeps the filter near the one before"
    )
    filter_penalty: float = parameter(
        0.05,
        unit="-",
        source="Li et al. 2018",
        above=0,
        doc="penalty that keeps the filter in its mask, at first",
    )
    filter_weight: float = parameter(0.7, unit="-", source=PROTOTYPE, low=0, doc="weight of its response")
    filter_mask_size: float = parameter(
        1.3,
        unit="box",
        source=PROTOTYPE,
        above=1,
        high=99,
        doc="outer size of the filter's mask, which fades out from the box on",
        was="focus",
    )


class CorrelationFilterExpert(NamedTuple):
    """A filter on edge orientations and colors, learned from one frame at a time (Li et al. 2018).

    It stays near the previous filter, which remembers earlier frames. It is nearly 0 outside the target, so
    that it learns to tell the target from its surround.

    learned, first: (19, 32, 17) spectra of the current filter and of the first frame's.
    applied: (2, 19, 32, 17) the current filter mixed with a share of the first frame's, so that the first
    frame isn't forgotten, and the first frame's alone. label: spectrum of the desired response.
    """

    learned: Spectra
    first: Spectra
    applied: Spectra
    label: Spectra
    params: FilterParams

    @classmethod
    def from_window(cls, window: Window, p: FilterParams) -> "CorrelationFilterExpert":
        """The expert learned from the first frame."""
        label = label_spectrum(p.label_width * WINDOW_CELLS / p.context)
        nothing = np.zeros((CHANNELS, *label.shape), np.complex64)
        first = cls(nothing, nothing, nothing, label, p)._learn(window, 0.0, 0.0)[0]
        return cls(first, first, np.stack([first, first]), label, p)

    def learn(self, window: Window) -> "CorrelationFilterExpert":
        """The expert after learning a window around the target."""
        p = self.params
        learned, applied = self._learn(window, p.temporal_weight, p.first_frame_weight)
        return self._replace(learned=learned, applied=applied)

    def _learn(
        self, window: Window, temporal_weight: float, first_frame_weight: float
    ) -> tuple[Spectra, Spectra]:
        """The learned filter, and the filters that are applied."""
        p, mask = self.params, target_mask(window.size, self.params.filter_mask_size)
        return window.observation.k.learn_place_filter(
            window.patch,
            HANN_WINDOW,
            mask,
            self.label,
            self.learned,
            self.first,
            temporal_weight,
            p.filter_penalty,
            first_frame_weight,
        )


# Patch pixels from the middle of the window to the cells' centers.
CELL_OFFSETS = CELL_PIXELS * np.abs(np.arange(WINDOW_CELLS) + 0.5 - WINDOW_CELLS / 2)


@lru_cache(maxsize=64)
def _mask_profile(length: float, outer: float) -> Floats:
    share = (outer - 2 * CELL_OFFSETS / length) / (outer - 1)
    profile: Floats = np.sin(np.pi / 2 * np.minimum(np.maximum(share, 0.0), 1.0)) ** 2
    return profile


def target_mask(size: tuple[float, float], outer: float) -> Plane:
    """The soft mask (32, 32) that keeps the filter on the target.

    1 in a box of the target's ``size``, in patch pixels, falling to 0 at ``outer`` times that size.
    """
    return np.outer(_mask_profile(size[1], outer), _mask_profile(size[0], outer)).astype(np.float32)
