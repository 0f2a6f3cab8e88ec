# SPDX-License-Identifier: MIT
"""A process that follows targets: the other end of ``RemoteTargets``."""

import pickle
import signal
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from tricue.camera.box import BoxLike
from tricue.camera.shared_frame import SharedFrame
from tricue.track.base.track import Track, Tracker
from tricue.track.multi.frame_memory import FrameMemory, MemoryLayout
from tricue.track.multi.messages import (
    WAKE,
    PlainTracks,
    poller,
    receive,
    send,
    stay_awake,
    to_plain,
    unpicklable,
)
from tricue.track.multi.targets import Targets, keeps_images


class Worker:
    """Answers requests, which are named after its methods."""

    def __init__(self, memory: FrameMemory) -> None:
        self._memory = memory
        self._targets = Targets()
        self.put, self.remove = self._targets.put, self._targets.remove
        self.undo, self.copies = self._targets.undo, self._targets.copies

    def add(
        self, target: int, tracker: Tracker, layout: MemoryLayout, box: BoxLike | None
    ) -> tuple[Track, list[str]]:
        """Start a tracker; return its first track and the warnings."""
        frame = self._frame(layout, keeps_images(tracker))
        return self._targets.add(target, tracker, frame, box), frame.messages

    def update(self, number: int, layout: MemoryLayout) -> tuple[PlainTracks, list[str]]:
        """The tracks of all targets, and the warnings."""
        frame = self._frame(layout, self._targets.keep_images)
        return to_plain(self._targets.update(number, frame)), frame.messages

    def _frame(self, layout: MemoryLayout, kept: bool) -> SharedFrame:
        """The frame in the memory, which the next one overwrites, so a copy if its images may be kept."""
        return self._memory.copy(layout) if kept else self._memory.read(layout)


def run(connection_file: int, memory_file: int) -> None:
    """Answer requests until the other end is closed, also because its process ended.

    A request is its number, a method, and arguments; its answer is the number, whether the call succeeded,
    and its result or error.
    """
    for each in signal.SIGINT, signal.SIGHUP:  # from a terminal, meant for the parent process
        signal.signal(each, signal.SIG_IGN)
    connection, worker = Connection(connection_file), Worker(FrameMemory(memory_file))
    messages = poller(connection)
    with suppress(EOFError, OSError):
        while True:
            number, request = receive(connection)
            try:
                method, arguments = pickle.loads(request)
            except Exception as error:  # for a class that this process can't import
                send(connection, number, False, unpicklable(error))
                continue
            if method != WAKE:
                send(connection, number, *_answer(worker, method, arguments))
            if method in (WAKE, "update"):  # the next frame of a recorded video follows at once
                stay_awake(messages)


def _answer(worker: Worker, method: str, arguments: tuple[Any, ...]) -> tuple[bool, Any]:
    try:
        return True, getattr(worker, method)(*arguments)
    except Exception as error:
        return False, _portable(error)


def _portable(error: Exception) -> Exception:
    """The error, or a RuntimeError with its text if it can't be pickled, as some third-party ones."""
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        return RuntimeError(f"{type(error).__name__}: {error}")
    return error
