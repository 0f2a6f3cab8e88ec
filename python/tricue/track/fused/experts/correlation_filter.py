# SPDX-License-Identifier: MIT
"""The correlation filter: it responds where orientations and colors are arranged as on the target."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.arrays import Floats, Plane
from tricue.track.fused.params import FusedParams
from tricue.track.fused.window import WINDOW_CELLS, Window

Spectra = NDArray[np.complex64]


class CorrelationFilterExpert(NamedTuple):
    """A filter on orientations and colors, learned from one frame at a time (Li et al. 2018).

    It keeps near the filter before it, which remembers former frames, and is 0 outside of the target, so that
    it learns to tell the target from what surrounds it.

    learned, first: (19, 32, 17) the filter as it is now, and that of the first frame. applied: two filters,
    the learned one with a share of the first frame's, against forgetting, and the first frame's alone. label:
    spectrum of the desired response.
    """

    learned: Spectra
    first: Spectra
    applied: Spectra
    label: Spectra
    params: FusedParams

    @classmethod
    def from_window(cls, window: Window, p: FusedParams) -> "CorrelationFilterExpert":
        """Learned from the first frame."""
        label = label_spectrum(p.label_width * WINDOW_CELLS / p.context)
        mask = target_mask(window.size, p.filter_mask_size)
        nothing = np.zeros((len(window.cells), *label.shape), np.complex64)
        first = window.observation.k.regularized_filter(
            window.cells, mask, label, nothing, 0.0, p.filter_penalty
        )
        return cls(first, first, np.stack([first, first]), label, p)

    def responses(self, window: Window) -> Plane:
        """(2, 32, 32) responses of the learned and of the first frame's filter."""
        return window.observation.k.correlation_response(window.cells, self.applied)

    def learn(self, window: Window) -> "CorrelationFilterExpert":
        """The expert after a window whose center is the target's."""
        p, k = self.params, window.observation.k
        mask = target_mask(window.size, p.filter_mask_size)
        learned = k.regularized_filter(
            window.cells, mask, self.label, self.learned, p.temporal_weight, p.filter_penalty
        )
        blended = learned + np.float32(p.first_frame_weight) * (self.first - learned)
        return self._replace(learned=learned, applied=np.stack([blended, self.first]))


@lru_cache(maxsize=64)
def _mask_profile(length: float, outer: float) -> Floats:
    offset = 2 * np.abs(np.arange(WINDOW_CELLS) + 0.5 - WINDOW_CELLS / 2)
    share = np.clip((outer - 2 * offset / length) / (outer - 1), 0, 1)
    profile: Floats = np.sin(np.pi / 2 * share) ** 2
    return profile


def target_mask(size: tuple[float, float], outer: float) -> Plane:
    """(32, 32) weights of the cells that may add to the filter's response.

    1 in the box of a target's size, in patch pixels, falling to 0 at ``outer`` times that size.
    """
    return np.outer(_mask_profile(size[1], outer), _mask_profile(size[0], outer)).astype(np.float32)


def label_spectrum(width: float) -> Spectra:
    """The spectrum of the desired response: a Gaussian at (0, 0) with that standard deviation in cells."""
    offset = np.fft.fftfreq(WINDOW_CELLS, 1 / WINDOW_CELLS)
    profile = np.exp(-0.5 * (offset / width) ** 2)
    return np.fft.rfft2(np.outer(profile, profile)).astype(np.complex64)
