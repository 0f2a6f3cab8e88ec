# SPDX-License-Identifier: MIT
"""The correlation filter: it responds where orientations and colors are arranged as on the target."""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.arrays import Floats, Plane
from tricue.track.fused.params import FusedParams
from tricue.track.fused.window import WINDOW_CELLS, Window

Spectra = NDArray[np.complex64]
Filter = tuple[Spectra, Plane]  # numerator and denominator


class CorrelationFilterExpert(NamedTuple):
    """A filter on orientations and colors (Danelljan et al. 2014, Bolme et al. 2010).

    learned, first: numerator (19, 32, 17) and denominator (32, 17), as they are learned, and of the first
    frame. applied: two filters, divided: the learned one with a share of the first frame's, and the first
    frame's alone. label: spectrum of the desired response.
    """

    learned: Filter
    first: Filter
    applied: Spectra
    label: Spectra
    params: FusedParams

    @classmethod
    def from_window(cls, window: Window, p: FusedParams) -> "CorrelationFilterExpert":
        """Learned from the first frame."""
        label = label_spectrum(p.label_width * WINDOW_CELLS / p.context)
        shape = (len(window.cells), *label.shape)
        empty = np.zeros(shape, np.complex64), np.zeros(label.shape, np.float32)
        mask = target_mask(window.size, p.filter_mask_size)
        k = window.observation.k
        first = k.correlation_train(window.cells, mask, label, *empty, 1.0, p.background_weight)
        return cls(first, first, divide([first, first], p.ridge), label, p)

    def responses(self, window: Window) -> Plane:
        """(2, 32, 32) responses of the learned and of the first frame's filter."""
        return window.observation.k.correlation_response(window.cells, self.applied)

    def learn(self, window: Window, rate: float) -> "CorrelationFilterExpert":
        """The expert with a window blended in, whose center is the target's."""
        p, k = self.params, window.observation.k
        mask = target_mask(window.size, p.filter_mask_size)
        learned = k.correlation_train(
            window.cells, mask, self.label, *self.learned, rate, p.background_weight
        )
        blended = blend_filters(learned, self.first, p.first_frame_weight)
        return self._replace(learned=learned, applied=divide([blended, self.first], p.ridge))


def blend_filters(learned: Filter, first: Filter, first_weight: float) -> Filter:
    """A filter with a share of the first frame's, against forgetting."""
    share = np.float32(first_weight)
    return learned[0] + share * (first[0] - learned[0]), learned[1] + share * (first[1] - learned[1])


def divide(filters: Sequence[Filter], ridge: float) -> Spectra:
    """(F, 19, 32, 17), as correlation_response takes filters. ridge: in parts of the mean denominator."""
    return np.stack([a / (b + np.float32(ridge * max(float(b.mean()), 1e-12))) for a, b in filters])


@lru_cache(maxsize=64)
def _mask_profile(length: float, outer: float) -> Floats:
    offset = 2 * np.abs(np.arange(WINDOW_CELLS) + 0.5 - WINDOW_CELLS / 2)
    share = np.clip((outer - 2 * offset / length) / (outer - 1), 0, 1)
    profile: Floats = np.sin(np.pi / 2 * share) ** 2
    return profile


def target_mask(size: tuple[float, float], outer: float) -> Plane:
    """(32, 32) weights of the cells that the filter has to respond to.

    1 in the box of a target's size, in patch pixels, falling to 0 at ``outer`` times that size.
    """
    return np.outer(_mask_profile(size[1], outer), _mask_profile(size[0], outer)).astype(np.float32)


def label_spectrum(width: float) -> Spectra:
    """The spectrum of the desired response: a Gaussian at (0, 0) with that standard deviation in cells."""
    offset = np.fft.fftfreq(WINDOW_CELLS, 1 / WINDOW_CELLS)
    profile = np.exp(-0.5 * (offset / width) ** 2)
    return np.fft.rfft2(np.outer(profile, profile)).astype(np.complex64)
