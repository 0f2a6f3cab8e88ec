# SPDX-License-Identifier: MIT
"""The correlation filter: where the orientations and colors are as they were."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Plane
from tricue.track.fused.view import CELLS, View

Numerators = NDArray[np.complex64]


class FilterExpert(NamedTuple):
    """A filter on orientations and colors (Danelljan et al. 2014, Bolme et al. 2010).

    numerator (11, 32, 17), denominator (32, 17): what is learnt. asked: the filters that answer, stacked,
    (2, 11, 32, 17) and (2, 32, 17): what is learnt with a tenth of the first frame's, and that alone.
    """

    numerator: Numerators
    denominator: Plane
    asked: tuple[Numerators, Plane]
    label: Numerators
    params: FusedParams

    @classmethod
    def start(cls, view: View, p: FusedParams) -> "FilterExpert":
        """Learnt from the first frame."""
        label = _label(p.label_width * CELLS / p.context)
        none = np.zeros((len(view.cells), *label.shape), np.complex64), np.zeros(label.shape, np.float32)
        focus = focus_of(view.size, p.focus)
        first = view.sight.k.correlation_train(view.cells, focus, label, *none, 1.0, p.background)
        return cls(*first, _stacked(first, first), label, p)

    def evidence(self, view: View) -> Plane:
        """(2, 32, 32): the learnt filter's answer, and the first frame's."""
        return view.sight.k.correlation_response(view.cells, *self.asked, self.params.ridge)

    def learnt(self, view: View, rate: float) -> "FilterExpert":
        """With the view, whose middle is the target, blended in."""
        p = self.params
        focus = focus_of(view.size, p.focus)
        past = self.numerator, self.denominator
        now = view.sight.k.correlation_train(view.cells, focus, self.label, *past, rate, p.background)
        first = self.asked[0][1], self.asked[1][1]
        share = np.float32(p.anchor)
        blended = tuple(a + share * (b - a) for a, b in zip(now, first, strict=True))
        return FilterExpert(*now, _stacked(blended, first), self.label, p)


def _stacked(learnt: tuple[Plane, ...], first: tuple[Plane, ...]) -> tuple[Numerators, Plane]:
    both = [np.stack(pair) for pair in zip(learnt, first, strict=True)]
    return both[0], both[1]


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
