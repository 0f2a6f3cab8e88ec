# SPDX-License-Identifier: MIT
"""The correlation filter: where the orientations and colors are as they were."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Plane
from tricue.track.fused.view import CELLS, View

Filter = tuple[NDArray[np.complex64], Plane]  # numerator and denominator


class FilterExpert(NamedTuple):
    """A filter on orientations and colors (Danelljan et al. 2014, Bolme et al. 2010).

    model: numerator (11, 32, 17) and denominator (32, 17), as they are learnt. asked: the two that answer,
    stacked: the model with a share of the first frame's, and the first frame's alone.
    """

    model: Filter
    asked: Filter
    label: NDArray[np.complex64]
    params: FusedParams

    @classmethod
    def start(cls, view: View, p: FusedParams) -> "FilterExpert":
        """Learnt from the first frame."""
        label = _label(p.label_width * CELLS / p.context)
        none = np.zeros((len(view.cells), *label.shape), np.complex64), np.zeros(label.shape, np.float32)
        focus = focus_of(view.size, p.focus)
        first = view.sight.k.correlation_train(view.cells, focus, label, *none, 1.0, p.background)
        return cls(first, _stacked(first, first), label, p)

    def evidence(self, view: View) -> Plane:
        """(2, 32, 32): the learnt filter's answer, and the first frame's."""
        return view.sight.k.correlation_response(view.cells, *self.asked, self.params.ridge)

    def learnt(self, view: View, rate: float) -> "FilterExpert":
        """With the view, whose middle is the target, blended in."""
        p = self.params
        focus = focus_of(view.size, p.focus)
        now = view.sight.k.correlation_train(view.cells, focus, self.label, *self.model, rate, p.background)
        first = self.asked[0][1], self.asked[1][1]
        return FilterExpert(now, _stacked(mixed(now, first, p.anchor), first), self.label, p)


def mixed(model: Filter, first: Filter, share: float) -> Filter:
    """A model with a share of the first frame's, against forgetting."""
    part = np.float32(share)
    return model[0] + part * (first[0] - model[0]), model[1] + part * (first[1] - model[1])


def _stacked(learnt: Filter, first: Filter) -> Filter:
    return np.stack([learnt[0], first[0]]), np.stack([learnt[1], first[1]])


@lru_cache(maxsize=64)
def _fading(length: float, outer: float) -> NDArray[np.float64]:
    offset = 2 * np.abs(np.arange(CELLS) + 0.5 - CELLS / 2)
    share = np.clip((outer - 2 * offset / length) / (outer - 1), 0, 1)
    bell: NDArray[np.float64] = np.sin(np.pi / 2 * share) ** 2
    return bell


def focus_of(size: tuple[float, float], outer: float) -> Plane:
    """(32, 32) 1 in the box of a target's size, patch pixels, falling to 0 at ``outer`` times that: what the
    filter has to answer to.
    """
    return np.outer(_fading(size[1], outer), _fading(size[0], outer)).astype(np.float32)


def _label(width: float) -> NDArray[np.complex64]:
    """The spectrum of the wanted answer: a Gaussian of that standard deviation, cells, at (0, 0)."""
    offset = np.fft.fftfreq(CELLS, 1 / CELLS)
    bell = np.exp(-0.5 * (offset / width) ** 2)
    return np.fft.rfft2(np.outer(bell, bell)).astype(np.complex64)
