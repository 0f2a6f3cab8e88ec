# SPDX-License-Identifier: MIT
"""What the stereo head tracker keeps from frame to frame."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tricue.track.stereo_head.filter import HeadFilter
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.stereo_geometry import Eyes

Floats = NDArray[np.float64]


@dataclass(slots=True)
class HeadState:
    """All that changes from frame to frame."""

    shape: tuple[int, ...]
    eyes: Eyes
    size: tuple[float, float]  # metres, width and height of the head
    first: Floats  # (L,) its colors at first
    learnt: Floats  # M of (2)
    filter: HeadFilter
    seen: Floats  # (3,) metres, where it was last
    score: float  # of its place
    usual: float  # running means: of that,
    intersection: float  # of (1),
    share: float  # of the share of the ellipse at the head's depth
    light: Floats | None  # (3,) mean blue, green, red of the first picture
    timestamp: float | None
    missed: float = 0.0  # seconds for which it was not seen

    def histogram(self, p: StereoHeadParams) -> Floats:
        """(L,) the model that is searched for."""
        return p.anchor * self.first + (1 - p.anchor) * self.learnt

    def lost(self, p: StereoHeadParams) -> bool:
        """Whether it has been gone for long."""
        return self.missed >= p.lost_after
