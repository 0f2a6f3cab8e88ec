# SPDX-License-Identifier: MIT
"""A recorded sequence for trackers: its truth, its frames, and what trackers are told of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from tricue.camera.frame import Frame
from tricue.evaluation.dataset import OpenedSequence
from tricue.evaluation.tracker_spec import SequenceInfo

from benchmarks.quality.common.frame_results import Array


@dataclass(frozen=True)
class Recording:
    """A sequence as its files have it; its N frames are decoded once, when they are asked for."""

    opened: OpenedSequence

    @cached_property
    def inputs(self) -> SequenceInfo:
        """Channels and cameras."""
        return self.opened

    @cached_property
    def frames(self) -> Sequence[Frame]:
        """All frames, in memory."""
        return list(self.opened.source)

    @cached_property
    def depths(self) -> Array:
        """(N,) the target's true z, meters, NaN where unknown."""
        return self.opened.positions(len(self.frames))[:, 2]
