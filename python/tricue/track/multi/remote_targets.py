# SPDX-License-Identifier: MIT
"""Targets followed by another process."""

import os
import pickle
import socket
import subprocess
import sys
import weakref
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from tricue.camera.box import BoxLike, as_box
from tricue.camera.shared_frame import SharedFrame
from tricue.errors import WorkerEndedError
from tricue.track.base.track import Track, Tracker
from tricue.track.multi.frame_memory import FrameMemory, MemoryLayout
from tricue.track.multi.messages import WAKE, from_plain, poller, receive, send, stay_awake, unpicklable
from tricue.track.multi.target_group import TargetGroup

PATIENCE = 5.0  # seconds that a worker gets to end by itself, or to answer after Ctrl-C


class RemoteTargets(TargetGroup):
    """Targets in another process, which ends with this object and with this process.

    memory: of the frames. The process runs a module, not this process's script, so the script needs no
    ``__main__`` guard.
    """

    def __init__(self, memory: FrameMemory) -> None:
        self._ids: set[int] = set()
        self.ended = False
        self._memory = memory
        self._number = 0  # of the last request
        self._owner = os.getpid()
        mine, theirs = socket.socketpair()
        with theirs:
            files, folders = (theirs.fileno(), memory.file), list(map(str, sys.path))
            code = (
                f"import sys; sys.path[:] = {folders}; from tricue.track.multi.worker import run; run{files}"
            )
            command = [sys.executable, "-c", code]
            self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, pass_fds=files)
        self._connection = Connection(mine.detach())
        self._answers = poller(self._connection)
        self._end_process = weakref.finalize(self, _end, self._connection, self._process, self._owner)

    @property
    def ids(self) -> set[int]:
        return set(self._ids)

    def add(self, target: int, tracker: Tracker, frame: SharedFrame, box: BoxLike | None) -> Track:
        plain = None if box is None else as_box(box)  # it can't unpickle classes of the user's script
        try:
            self._send("add", target, tracker, self._memory.write(frame), plain)
            track: Track = self._receive_seen(frame)
        except WorkerEndedError:
            raise
        except BaseException as error:  # the worker may have succeeded anyway
            with suppress(WorkerEndedError):
                self._ask("remove", target, hurried=not isinstance(error, Exception))
            raise
        self._ids.add(target)
        return track

    def put(self, target: int, tracker: Tracker) -> None:
        self._ask("put", target, tracker)
        self._ids.add(target)

    def remove(self, target: int) -> None:
        self._ask("remove", target)
        self._ids.remove(target)

    def wake(self) -> None:
        """Announce an update, so that the other process wakes up while this one writes the frame."""
        self._send(WAKE)

    def start_update(self, number: int, layout: MemoryLayout) -> None:
        """Start following all targets into the frame in memory; :meth:`finish_update` gives the tracks."""
        self._send("update", number, layout)

    def finish_update(self, frame: SharedFrame) -> dict[int, Track]:
        """The tracks of the started update; messages are added to its frame."""
        stay_awake(self._answers)
        return from_plain(self._receive_seen(frame))

    def undo(self, number: int, hurried: bool = False) -> None:
        """Undo an update, whether it is running, finished, or never started; nothing if the process ended."""
        with suppress(WorkerEndedError):  # ``ids`` shows it
            if not self.ended:
                self._ask("undo", number, hurried=hurried)

    def copies(self) -> dict[int, Tracker]:
        found: dict[int, Tracker] = self._ask("copies") if self._ids else {}
        return found

    def close(self) -> None:
        """Stop following all targets, and end the process."""
        self._end_process()

    def _ask(self, method: str, *arguments: Any, hurried: bool = False) -> Any:
        self._send(method, *arguments)
        return self._receive(hurried)

    def _send(self, method: str, *arguments: Any) -> None:
        if os.getpid() != self._owner:
            raise RuntimeError(
                "workers: expected a call in the process that made them; a copy starts its own"
            )
        self._number += 1
        try:
            send(self._connection, self._number, method, arguments)
        except OSError:
            raise self._end() from None
        except (AttributeError, TypeError, pickle.PicklingError) as error:
            raise unpicklable(error) from None

    def _receive(self, hurried: bool = False) -> Any:
        """The answer to the last request; earlier answers that weren't read, as after Ctrl-C, are skipped.

        Ctrl-C while waiting leaves the connection usable. If an answer was read only in part, the next one
        couldn't be found, so the worker is ended; so is one that doesn't answer within PATIENCE, if hurried.
        """
        number, succeeded, value = 0, False, None
        while number != self._number:
            if not self._answers.poll(1000 * PATIENCE if hurried else None):
                self._process.kill()
                raise self._end()
            try:
                number, answer = receive(self._connection)
                succeeded, value = pickle.loads(answer)
            except (EOFError, OSError, pickle.UnpicklingError):
                raise self._end() from None
            except BaseException:
                self._end()
                raise
        if not succeeded:
            assert isinstance(value, Exception)
            raise value
        return value

    def _receive_seen(self, frame: SharedFrame) -> Any:
        """The same, for an answer with messages about the frame."""
        value, messages = self._receive()
        frame.messages.extend(each for each in messages if each not in frame.messages)
        return value

    def _end(self) -> WorkerEndedError:
        """End the worker, unless it has ended already; return the error that says so."""
        self.ended, self._ids = True, set()
        self._end_process()
        code = self._process.wait()  # another thread may be ending it, as the interpreter does at its exit
        how = f"by signal {-code}" if code < 0 else f"with exit code {code}"
        return WorkerEndedError(f"a worker process ended {how}")


def _end(connection: Connection, process: "subprocess.Popen[bytes]", owner: int) -> None:
    """End a worker; it ends by itself once its connection is shut down, also if a fork has it open, too."""
    if os.getpid() != owner:
        connection.close()
        return
    with suppress(OSError), socket.socket(fileno=os.dup(connection.fileno())) as same:
        same.shutdown(socket.SHUT_RDWR)
    connection.close()
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        pass
    finally:  # also after Ctrl-C
        process.kill()
        process.wait()
