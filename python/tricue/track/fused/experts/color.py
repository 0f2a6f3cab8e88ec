# SPDX-License-Identifier: MIT
"""Which colors are the target's, and which its surround's."""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.sight import Plane
from tricue.track.fused.view import PIXELS, View

BINS = 16  # a color channel, of the histograms
RARE = 1e-4  # a color's share under which it says little about either side
SURROUND = 1.1  # of the box: colors outside of it are the surround's
SURELY, HARDLY = 0.4, 0.1  # P(target | depth) of what is learnt for the target, and against it


class ColorExpert(NamedTuple):
    """Colors of the target and of its surround, (16, 16, 16) each, and P(target | color)."""

    target: Plane
    surround: Plane
    table: Plane

    @classmethod
    def start(cls, view: View) -> "ColorExpert":
        """Learnt from the first frame."""
        none = np.zeros((BINS, BINS, BINS), np.float32)
        return cls(none, none, none).learnt(view, 1.0)

    def opinion(self, view: View) -> Plane:
        """(64, 64) P(target | color) of the patch's pixels."""
        return view.sight.k.color_lookup(view.colors, self.table).reshape(PIXELS, PIXELS)

    def learnt(self, view: View, rate: float) -> "ColorExpert":
        """With the view, whose middle is the target, blended in; what is farther or nearer than the target
        is learnt against it.
        """
        inside, around = _sides(view)
        colors = view.colors[0]
        own, other = (colors.take(each, axis=1)[None] for each in (inside, around))
        return ColorExpert(*view.sight.k.learn_contrast(own, other, self.target, self.surround, rate, RARE))


def _sides(view: View) -> tuple[NDArray[Any], NDArray[Any]]:
    """Which of the 4096 pixels are the target's, and which its surround's."""
    inside, around = masks(round(view.size[0], 1), round(view.size[1], 1))
    if view.depth is None:
        return inside, around
    at_depth = view.depth[0].ravel()
    own = inside[at_depth[inside] > SURELY]
    behind = inside[at_depth[inside] < HARDLY]
    return (own, np.concatenate([around, behind])) if 2 * len(own) > len(inside) else (inside, around)


@lru_cache(maxsize=64)
def masks(width: float, height: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Indices of a patch's pixels in the ellipse of a target's size, and of those outside of its box."""
    offset = np.abs(np.arange(PIXELS) + 0.5 - PIXELS / 2)
    u, v = offset[None] / max(width / 2, 1.0), offset[:, None] / max(height / 2, 1.0)
    inside, around = u * u + v * v <= 1, np.maximum(u, v) > SURROUND
    if not around.any():
        around = ~inside
    return np.flatnonzero(inside), np.flatnonzero(around)
