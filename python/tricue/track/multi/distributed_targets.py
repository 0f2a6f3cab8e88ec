# SPDX-License-Identifier: MIT
"""Targets distributed over several processes."""

from tricue.camera.box import BoxLike
from tricue.camera.shared_frame import SharedFrame
from tricue.track.base.track import Track, Tracker
from tricue.track.multi.frame_memory import FrameMemory
from tricue.track.multi.remote_targets import RemoteTargets
from tricue.track.multi.target_group import FollowedTargets, TargetGroup
from tricue.track.multi.targets import Targets


class DistributedTargets(FollowedTargets):
    """Targets of which some are in this process and the others in workers.

    A new target goes to the process with the fewest. A worker is started for it if all processes have targets
    and there are fewer than ``processes``, which includes this one. If a worker was killed, there is a
    WorkerEndedError: its targets are removed from :attr:`ids`, the others stay, and a new target starts
    another worker.
    """

    def __init__(self, processes: int) -> None:
        self._processes = processes
        self._memory = FrameMemory()
        self._here = Targets()
        self._workers: list[RemoteTargets] = []

    @property
    def ids(self) -> set[int]:
        return set[int]().union(*(each.ids for each in self._parts))

    def add(self, target: int, tracker: Tracker, frame: SharedFrame, box: BoxLike | None) -> Track:
        return self._emptiest().add(target, tracker, frame, box)

    def put(self, target: int, tracker: Tracker) -> None:
        self._emptiest().put(target, tracker)

    def remove(self, target: int) -> None:
        next(each for each in self._parts if target in each.ids).remove(target)

    def update(self, number: int, frame: SharedFrame) -> dict[int, Track]:
        busy = [each for each in self._workers if each.ids]
        for worker in busy:
            worker.wake()
        if busy:
            layout = self._memory.write(frame)
            for worker in busy:
                worker.start_update(number, layout)
        tracks = self._here.update(number, frame)
        for worker in busy:
            tracks |= worker.finish_update(frame)
        return tracks

    def undo(self, number: int, hurried: bool = False) -> None:
        """Undo an update, if it was the last one. Targets of a worker that has ended are gone."""
        for each in self._parts:
            each.undo(number, hurried)

    def copies(self) -> dict[int, Tracker]:
        return {target: tracker for each in self._parts for target, tracker in each.copies().items()}

    def close(self) -> None:
        """Stop following all targets, and end the workers."""
        for each in self._parts:
            each.close()
        self._workers = []

    @property
    def _parts(self) -> list[TargetGroup]:
        return [self._here, *self._workers]

    def _emptiest(self) -> TargetGroup:
        self._workers = [each for each in self._workers if not each.ended]
        if len(self._workers) < self._processes - 1 and all(each.ids for each in self._parts):
            self._workers.append(RemoteTargets(self._memory))
        return min(self._parts, key=lambda each: len(each.ids))
