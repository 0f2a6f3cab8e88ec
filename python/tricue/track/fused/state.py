# SPDX-License-Identifier: MIT
"""All that the fused tracker keeps from frame to frame."""

from typing import NamedTuple

from tricue.track.fused.experts.color import ColorExpert
from tricue.track.fused.experts.depth import DepthExpert
from tricue.track.fused.experts.filter import FilterExpert
from tricue.track.fused.experts.flow import Glance
from tricue.track.fused.experts.size import SizeExpert
from tricue.track.fused.identity import Identity, Marks
from tricue.track.fused.outline import WHOLE, Outline
from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Kind
from tricue.track.fused.space import Space
from tricue.track.fused.view import Target

MIN_MISSED = 3  # frames in a row, at least, until the target is LOST


class Models(NamedTuple):
    """What is known of the target's look in one kind of picture; learning gives others."""

    filter: FilterExpert
    color: ColorExpert
    size: SizeExpert
    identity: Identity
    edge: float  # P(target | pixel) along the target's edge, in the first frame


class State(NamedTuple):
    """After a frame. models: by the kind of picture that they are of."""

    shape: tuple[int, int]
    models: dict[Kind, Models]
    target: Target
    first_side: float  # pixels, of the first box
    side: float  # the same when it was last recognised
    usual: float  # the filter's answer where the target is
    marks: Marks | None = None
    score: float = 1.0
    sure: float = 0.0  # log-odds of its being the target, usually
    structure: float = 0.0  # the same by its structure alone
    velocity: tuple[float, float] = (0.0, 0.0)  # pixels a frame
    depth: DepthExpert | None = None
    space: Space | None = None
    glance: Glance | None = None
    outline: Outline = WHOLE
    hidden: bool = False  # behind something nearer
    missed: int = 0  # frames in a row in which it was not recognized
    unseen: float = 0.0  # seconds of them
    seconds: float = 0.0  # since the frame before
    frames: int = 0  # since init
    timestamp: float | None = None

    def lost(self, p: FusedParams) -> bool:
        """Whether it hasn't been recognized for long."""
        return self.missed >= MIN_MISSED and self.unseen >= p.lost_after
