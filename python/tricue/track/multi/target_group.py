# SPDX-License-Identifier: MIT
"""What a group of targets can do, whichever processes follow it.

    MultiTracker -> FollowedTargets: Targets with one process, DistributedTargets with several
    DistributedTargets -> its TargetGroups: the Targets of this process, RemoteTargets for each worker
    RemoteTargets -> messages and FrameMemory -> Worker -> the Targets of that process

Tracks and errors take the same path back.
"""

from typing import Protocol

from tricue.camera.box import BoxLike
from tricue.camera.shared_frame import SharedFrame
from tricue.track.base.track import Track, Tracker


class TargetGroup(Protocol):
    """Trackers by the ids of their targets."""

    @property
    def ids(self) -> set[int]:
        """The targets' ids."""

    def add(self, target: int, tracker: Tracker, frame: SharedFrame, box: BoxLike | None) -> Track:
        """Start a tracker; it is kept if that succeeds."""

    def put(self, target: int, tracker: Tracker) -> None:
        """Continue with a tracker that was started elsewhere."""

    def remove(self, target: int) -> None:
        """Stop following one of the targets."""

    def undo(self, number: int, hurried: bool = False) -> None:
        """Undo an update, if it was the last one; this works because trackers replace their states.

        hurried: whether to end another process that doesn't do it within a few seconds.
        """

    def copies(self) -> dict[int, Tracker]:
        """Copies of the trackers."""

    def close(self) -> None:
        """Stop following all targets."""


class FollowedTargets(TargetGroup, Protocol):
    """A group whose update is one call; that of ``RemoteTargets`` is several, so that processes overlap."""

    def update(self, number: int, frame: SharedFrame) -> dict[int, Track]:
        """Follow all targets into a frame; messages are added to it.

        An error names its target; :meth:`undo` reverts those that succeeded. number: identifies the update
        for :meth:`undo`.
        """
