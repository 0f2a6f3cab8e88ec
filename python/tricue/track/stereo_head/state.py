# SPDX-License-Identifier: MIT
"""The state that the stereo head tracker keeps from frame to frame."""

from typing import NamedTuple

from tricue.arrays import Floats
from tricue.track.stereo_head.head_filter import HeadFilter
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Color
from tricue.track.stereo_head.stereo_geometry import Point, StereoGeometry


class StereoHeadState(NamedTuple):
    """Everything that changes from frame to frame."""

    shape: tuple[int, ...]  # of the left image
    geometry: StereoGeometry
    size: tuple[float, float]  # width and height of the head, meters
    first_histogram: Floats  # (L,) the color model of the first frame
    learned_histogram: Floats  # (L,) M of (2)
    model: Floats  # (L,) the model to search for: the first mixed with the learned one
    filter: HeadFilter
    last_seen: Point  # position
    score: float  # of the match in this frame, 0 where the head isn't recognized
    mean_score: float  # running mean
    mean_intersection: float  # running mean of (1)
    mean_share: float  # running mean of the share of the ellipse at the head's disparity
    first_mean: Color | None  # mean color of the first left image; None: light isn't compensated
    timestamp: float | None
    missed_seconds: float = 0.0  # since the head was last recognized

    def min_intersection_to_learn(self, p: StereoHeadParams) -> float:
        """The intersection (1) from which on colors are learned."""
        of = self.mean_intersection if p.learning_gate == "relative" else 1.0
        return p.min_intersection_to_learn * of

    def is_lost(self, p: StereoHeadParams) -> bool:
        """Whether the head has been missed for ``lost_after`` seconds."""
        return self.missed_seconds >= p.lost_after
