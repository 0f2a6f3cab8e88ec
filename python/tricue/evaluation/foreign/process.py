# SPDX-License-Identifier: MIT
"""The parent's side of a third-party tracker's process: requests with a time limit, and a reliable end."""

import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import IO, Any

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation.foreign.host import from_plain
from tricue.evaluation.foreign.worker import PATIENCE
from tricue.track.base.track import Track

LOADING_LIMIT = 60.0  # seconds, at least, to start a process and create a tracker in it
MAX_OUTPUT = 2000  # bytes of a tracker's output that are kept, the last ones
MAX_LINE = 200  # characters of it in an error message


class WorkerError(RuntimeError):
    """A failed request: what the tracker raised, or how its process ended."""


class WorkerProcess:
    """A process for one tracker. It ends with this object, with the process that created it, or when a
    request takes longer than ``limit`` seconds (when loading, at least LOADING_LIMIT). place: as for
    :class:`Host`.
    """

    def __init__(self, place: str, limit: float) -> None:
        self.limit = limit
        self.end = ""
        """How it ended, "" while it runs."""
        folders = list(map(str, sys.path))
        code = (
            f"import sys; sys.path[:] = {folders}; from tricue.evaluation.foreign.worker import main; "
            f"main({place!r}, {max(limit, LOADING_LIMIT)!r})"
        )
        self._process = subprocess.Popen(
            [sys.executable, "-c", code],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,  # Ctrl-C goes to the evaluation, which then ends the whole group
            env={**os.environ, "PYTHONHASHSEED": "0"},
        )
        assert self._process.stderr is not None
        self._output = _Tail(self._process.stderr)
        self.close = weakref.finalize(self, _end, self._process)

    def load(self, method: str, *arguments: Any) -> Any:
        """As :meth:`ask`, with enough time for imports and models to load."""
        return self._ask(max(self.limit, LOADING_LIMIT), not_loaded, method, *arguments)

    def ask(self, method: str, *arguments: Any) -> Any:
        """The value that a method of ``Host`` returns; WorkerError if it raises or the process ends."""
        return self._ask(self.limit, no_answer, method, *arguments)

    def _ask(self, limit: float, late: Callable[[float], str], method: str, *arguments: Any) -> Any:
        if self.end:
            raise WorkerError(self.end)
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        too_slow = threading.Event()
        timer = threading.Timer(limit, _kill_late, (self._process, too_slow))
        timer.daemon = True
        timer.start()
        try:
            pickle.dump((method, *arguments), self._process.stdin, pickle.HIGHEST_PROTOCOL)
            self._process.stdin.flush()
            succeeded, value = pickle.load(self._process.stdout)
        except (EOFError, OSError, pickle.UnpicklingError):
            ended = self._how_it_ended()
            self.end = late(limit) if too_slow.is_set() else ended
            raise WorkerError(self.end) from None
        finally:
            timer.cancel()
            timer.join()
        if too_slow.is_set():  # the time limit ended the process just after the answer
            self._how_it_ended()
            self.end = late(limit)
            raise WorkerError(self.end)
        if not succeeded:
            raise WorkerError(value)
        return value

    def _how_it_ended(self) -> str:
        _kill(self._process)  # its children may still run
        code = self._process.wait()
        self.close()
        if code < 0:
            with suppress(ValueError):
                return self._with_output(f"its process was ended by {signal.Signals(-code).name}")
        return self._with_output(f"its process ended with exit code {code}")

    def _with_output(self, message: str) -> str:
        line = self._output.last_line()
        return f"{message}; its last words: {line[:MAX_LINE]}" if line else message


def no_answer(limit: float) -> str:
    """The message for a process that a time limit ended."""
    return f"no answer within {limit:g} s (time_limit)"


def not_loaded(limit: float) -> str:
    """The message for one that ended while it was loading."""
    return f"not loaded within {limit:g} s (time_limit)"


def ended_by_another_limit(error: str, limit: float) -> bool:
    """Whether an error is one of these messages for a different time limit."""
    present = no_answer(limit), not_loaded(max(limit, LOADING_LIMIT))
    return _LATE.search(error) is not None and not error.endswith(present)


_LATE = re.compile(r"(?:no answer|not loaded) within \S+ s \(time_limit\)$")


class RemoteTracker:
    """A tracker in another process, with the interface of a local one. update_seconds: measured there.

    Every error is a WorkerError.
    """

    def __init__(self, process: WorkerProcess, keywords: Mapping[str, Any], seed: int) -> None:
        self._process = process
        self.update_seconds = 0.0
        process.load("make", keywords, seed)

    def init(self, frame: Frame, box: Box) -> Track:
        """Start on a box."""
        return from_plain(self._process.ask("init", frame, box))

    def update(self, frame: Frame) -> Track:
        """Follow the target into the next frame."""
        plain, self.update_seconds = self._process.ask("update", frame)
        return from_plain(plain)


class _Tail:
    """Reads a stream to its end, and keeps the last of it."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._kept = b""
        self._thread = threading.Thread(target=self._read, args=(stream,), daemon=True)
        self._thread.start()

    def _read(self, stream: IO[bytes]) -> None:
        with suppress(OSError, ValueError), stream:
            while data := os.read(stream.fileno(), 1 << 16):
                self._kept = (self._kept + data)[-MAX_OUTPUT:]

    def last_line(self) -> str:
        """The last line that isn't blank; "" without any."""
        self._thread.join(PATIENCE)
        lines = self._kept.decode(errors="replace").split("\n")
        return next((" ".join(line.split()) for line in reversed(lines) if line.strip()), "")


def _kill_late(process: "subprocess.Popen[bytes]", too_slow: threading.Event) -> None:
    too_slow.set()
    _kill(process)


def _kill(process: "subprocess.Popen[bytes]") -> None:
    """End a process and its children at once."""
    if sys.platform == "win32":
        process.kill()
        return
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)


def _end(process: "subprocess.Popen[bytes]") -> None:
    """End a process: cleanly, by closing its input, or else at once."""
    assert process.stdin is not None
    assert process.stdout is not None
    with suppress(OSError):
        process.stdin.close()
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        _kill(process)
        process.wait()
    process.stdout.close()
