# SPDX-License-Identifier: MIT
"""What the stereo head tracker keeps from frame to frame."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.stereo_head.filter import HeadFilter
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.stereo_geometry import StereoGeometry

Floats = NDArray[np.float64]


class HeadState(NamedTuple):
    """All that changes from frame to frame."""

    shape: tuple[int, ...]
    geometry: StereoGeometry
    size: tuple[float, float]  # metres, width and height of the head
    first: Floats  # (L,) its colors at first
    learned: Floats  # M of (2)
    filter: HeadFilter
    last_seen: Floats  # (3,) metres
    score: float  # of its place
    mean_score: float  # running mean
    mean_intersection: float  # of (1), running mean
    mean_share: float  # of the ellipse at the head's depth, running mean
    light: Floats | None  # (3,) mean blue, green, red of the first picture
    timestamp: float | None
    missed: float = 0.0  # seconds for which it was not seen

    def histogram(self, p: StereoHeadParams) -> Floats:
        """(L,) the model that is searched for."""
        return p.anchor * self.first + (1 - p.anchor) * self.learned

    def lost(self, p: StereoHeadParams) -> bool:
        """Whether it has been gone for long."""
        return self.missed >= p.lost_after
