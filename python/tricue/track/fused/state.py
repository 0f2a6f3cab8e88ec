# SPDX-License-Identifier: MIT
"""Everything that the fused tracker keeps from frame to frame."""

from dataclasses import dataclass
from typing import Any

from tricue.track.base.validation import ADDED_TIME_ERROR
from tricue.track.fused.clutter import NO_CLUTTER, Clutter
from tricue.track.fused.depth_object import DepthObject
from tricue.track.fused.depth_trust import DepthTrust
from tricue.track.fused.experts.depth import DepthExpert
from tricue.track.fused.identity import IdentityFeatures
from tricue.track.fused.memory import Memory
from tricue.track.fused.models import ModelsByKind
from tricue.track.fused.motion import Motion
from tricue.track.fused.outline import BOX_OUTLINE, Outline, Sides
from tricue.track.fused.params import FusedParams
from tricue.track.fused.position_filter import PositionFilter
from tricue.track.fused.target import Target

FRESH_TRUST = DepthTrust()  # before the first frame
NO_MOTION = Motion()  # after the first frame
MIN_LOST_FRAMES = 3  # missed in a row, before the target is LOST
MIN_INTERVAL_SHARE = 1 / 3  # of the mean interval between frames


@dataclass(frozen=True)
class FusedState:
    """The immutable state of the tracker after a frame."""

    shape: tuple[int, int]  # of the first frame
    models: ModelsByKind
    memory: Memory  # older models
    target: Target
    first_side: float  # pixels, of the first box
    recognized_side: float  # pixels, when it was last recognized
    mean_response: float  # running mean of the filter's response on the target
    sides: Sides  # what depth tells about the target's sides
    moved: bool = False  # to this frame's match
    features: IdentityFeatures | None = None
    score: float = 1.0
    typical: IdentityFeatures | None = None  # running means; None until recognized after the first frame
    depth: DepthExpert | None = None  # None until depth is measured
    depth_object: DepthObject | None = None  # None unless the target is an object of the depth image
    position: PositionFilter | None = None  # None until depth is measured
    is_metric: bool = True  # no frame since init was a stereo pair whose rig had to be guessed
    motion: Motion = NO_MOTION
    outline: Outline = BOX_OUTLINE
    depth_trust: DepthTrust = FRESH_TRUST
    occluded: bool = False  # by something nearer
    clutter: Clutter = NO_CLUTTER  # since the target was last recognized
    missed_frames: int = 0  # in a row, in which the target was not recognized
    missed_seconds: float = 0.0  # of these frames
    unlearned_seconds: float = 0.0  # since appearance was learned
    appearance_updates: int = 0  # after the first frame
    seconds: float = 0.0  # since the previous frame
    mean_seconds: float = 0.0  # running mean of these; at first 1 / rate
    frames: int = 0  # since init
    timestamp: float | None = None

    def replace(self, **changes: Any) -> "FusedState":
        """The state with some attributes changed; a named tuple of this size takes four times as long."""
        assert changes.keys() <= vars(self).keys(), (
            f"expected fields of a FusedState, got {', '.join(changes)}"
        )
        changed = object.__new__(FusedState)
        vars(changed).update(vars(self))
        vars(changed).update(changes)
        return changed

    def is_late(self) -> bool:
        """Whether the frame came so soon after the one before that it must have been taken earlier than its
        timestamp says, as in a burst after a delay. A velocity over that time is wrong.
        """
        return self.seconds < MIN_INTERVAL_SHARE * self.mean_seconds

    def is_lost(self, p: FusedParams) -> bool:
        """Whether the target has been missed for long enough to be LOST."""
        return self.missed_frames >= MIN_LOST_FRAMES and self.missed_seconds >= p.lost_after

    def is_followed(self, p: FusedParams) -> bool:
        """Whether the target is recognized, or has been missed so briefly that it may still be near."""
        return self.missed_frames == 0 or self.missed_seconds <= p.max_missed_seconds + ADDED_TIME_ERROR
