# SPDX-License-Identifier: MIT
"""Who says where the target is: each expert gives a map of evidence over the places of its centre."""

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.fused.params import FusedParams
from tricue.track.fused.view import CELLS, PIXELS, Plane, View

BINS = 16  # a color channel, of the histograms
RARE = 1e-4  # a color's share under which it says little about either side
SURROUND = 1.1  # of the box: colors outside of it are the surround's


class Expert(Protocol):
    """One cue's model of the target. Immutable: learning gives another."""

    def evidence(self, k: Kernels, view: View) -> Plane:
        """(32, 32) for the target's centre at each cell of the view, about 1 on the target, 0 elsewhere."""

    def learnt(self, k: Kernels, view: View, rate: float) -> "Expert":
        """With the view, whose middle is the target, blended in."""


class FilterExpert(NamedTuple):
    """A correlation filter on orientations and colors, and the first frame's, which stays in it."""

    numerator: NDArray[np.complex64]
    denominator: NDArray[np.float32]
    first: tuple[NDArray[np.complex64], NDArray[np.float32]]
    label: NDArray[np.complex64]
    params: FusedParams

    @classmethod
    def start(cls, k: Kernels, view: View, p: FusedParams) -> "FilterExpert":
        """Learnt from the first frame."""
        label = _label(p.label_width * CELLS / p.context)
        cells, focus = cells_of(k, view), focus_of(view, p)
        none = np.zeros((len(cells), *label.shape), np.complex64), np.zeros(label.shape, np.float32)
        first = k.correlation_train(cells, focus, label, *none, 1.0, p.background)
        return cls(*first, first, label, p)

    def evidence(self, k: Kernels, view: View) -> Plane:
        return self.response(k, cells_of(k, view))

    def response(self, k: Kernels, cells: Plane) -> Plane:
        """The answer to the cells of a view."""
        share = np.float32(self.params.anchor)
        numerator, denominator = (
            now + share * (first - now)
            for now, first in zip((self.numerator, self.denominator), self.first, strict=True)
        )
        answers: Plane = k.correlation_response(cells, numerator[None], denominator[None], self.params.ridge)
        return answers.reshape(CELLS, CELLS)

    def first_response(self, k: Kernels, cells: Plane) -> Plane:
        """What the first frame's filter alone answers."""
        numerator, denominator = self.first
        answers: Plane = k.correlation_response(cells, numerator[None], denominator[None], self.params.ridge)
        return answers.reshape(CELLS, CELLS)

    def learnt(self, k: Kernels, view: View, rate: float) -> "FilterExpert":
        p = self.params
        now = k.correlation_train(
            cells_of(k, view),
            focus_of(view, p),
            self.label,
            self.numerator,
            self.denominator,
            rate,
            p.background,
        )
        return self._replace(numerator=now[0], denominator=now[1])


class ColorExpert(NamedTuple):
    """Colors of the target and of its surround, and P(target | color)."""

    target: Plane
    surround: Plane
    table: Plane
    params: FusedParams

    @classmethod
    def start(cls, k: Kernels, view: View, p: FusedParams) -> "ColorExpert":
        """Learnt from the first frame."""
        none = np.zeros((BINS, BINS, BINS), np.float32)
        return cls(none, none, none, p).learnt(k, view, 1.0)

    def posterior(self, k: Kernels, view: View) -> Plane:
        """(64, 64) P(target | color) of the patch's pixels."""
        return k.color_lookup(view.colors, self.table).reshape(PIXELS, PIXELS)

    def evidence(self, k: Kernels, view: View) -> Plane:
        p = self.params
        return k.box_contrast(self.posterior(k, view), *view.size, p.frame, p.around)

    def learnt(self, k: Kernels, view: View, rate: float) -> "ColorExpert":
        inside, around = masks(*view.size)
        colors = view.colors
        own, other = (np.ascontiguousarray(colors[:, :, each]) for each in (inside, around))
        target, surround, table = k.learn_contrast(own, other, self.target, self.surround, rate, RARE)
        return self._replace(target=target, surround=surround, table=table)


def cells_of(k: Kernels, view: View) -> Plane:
    """(11, 32, 32) what the filter reads of a view."""
    return k.gradient_color_cells(view.patch, TAPER)


def focus_of(view: View, p: FusedParams) -> Plane:
    """(32, 32) 1 in the target's box, falling to 0 at its outer size: what the filter has to answer to."""
    offset = 2 * np.abs(np.arange(CELLS) + 0.5 - CELLS / 2)
    across, down = (np.clip((p.focus - 2 * offset / length) / (p.focus - 1), 0, 1) for length in view.size)
    return np.outer(_smooth(down), _smooth(across)).astype(np.float32)


def _smooth(share: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.sin(np.pi / 2 * share) ** 2


def masks(width: float, height: float) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """(4096,) which pixels of a patch lie in the ellipse of a target's size, and which outside of its box."""
    offset = np.abs(np.arange(PIXELS) + 0.5 - PIXELS / 2)
    u, v = offset[None] / max(width / 2, 1.0), offset[:, None] / max(height / 2, 1.0)
    inside, around = u * u + v * v <= 1, np.maximum(u, v) > SURROUND
    if not around.any():
        around = ~inside
    return inside.ravel(), around.ravel()


def _label(width: float) -> NDArray[np.complex64]:
    """The spectrum of the wanted answer: a Gaussian of that standard deviation, cells, at (0, 0)."""
    offset = np.fft.fftfreq(CELLS, 1 / CELLS)
    bell = np.exp(-0.5 * (offset / width) ** 2)
    return np.fft.rfft2(np.outer(bell, bell)).astype(np.complex64)


def _taper() -> Plane:
    """Hann's window, so that a patch has no edges."""
    bell = np.sin(np.pi * (np.arange(CELLS) + 0.5) / CELLS) ** 2
    return np.outer(bell, bell).astype(np.float32)


TAPER = _taper()
