# SPDX-License-Identifier: MIT
"""A recorded sequence for trackers: its truth, its frames, its channels and cameras."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from tricue.camera.frame import Frame
from tricue.evaluation.dataset import OpenedSequence
from tricue.evaluation.tracker_spec import SequenceInfo

from benchmarks.quality.common.frame_results import Array


@dataclass(frozen=True)
class Recording:
    """A sequence as recorded; its N frames are decoded once, at first use."""

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
    def truth(self) -> Array:
        """(N, 4) the true boxes, NaN where unknown."""
        return self.opened.truth(len(self.frames))

    @cached_property
    def depths(self) -> Array:
        """(N,) the target's true z, meters, NaN where unknown."""
        return self.opened.positions(len(self.frames))[:, 2]


class MirroredRecording(Recording):
    """The color of a sequence with left and right exchanged.

    It is as hard as the sequence itself, but results that depend on a few pixels come out differently. So it
    shows how much of what was chosen on the sequence is chance.
    """

    @cached_property
    def frames(self) -> Sequence[Frame]:
        """All frames, in memory, with color alone."""
        return [_mirrored(frame) for frame in self.opened.source]

    @cached_property
    def truth(self) -> Array:
        """(N, 4) the true boxes, NaN where unknown."""
        boxes: Array = self.opened.truth(len(self.frames)).copy()
        width, _ = self.opened.source.size
        boxes[:, 0] = width - boxes[:, 0] - boxes[:, 2]
        return boxes


def _mirrored(frame: Frame) -> Frame:
    assert frame.color is not None, "a color sequence"
    return replace(frame, color=np.ascontiguousarray(frame.color[:, ::-1]), depth=None, right=None)
