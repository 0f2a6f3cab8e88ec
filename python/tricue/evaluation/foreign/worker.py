# SPDX-License-Identifier: MIT
"""The process that runs somebody else's tracker: the other end of a ``WorkerProcess``.

What the tracker prints goes to standard error, never between the answers.
"""

import faulthandler
import os
import pickle
import signal
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import Any, BinaryIO

import cv2

from tricue.errors import BoxError, one_line
from tricue.evaluation.foreign.host import Host
from tricue.evaluation.toolkits.trax_client import TraxError

PATIENCE = 2.0  # seconds to end in good order
GRACE = 5.0  # seconds after the time limit until the process ends itself, should nobody end it


def main(place: str, limit: float) -> None:
    """Answer requests until standard input ends.

    place: of the tracker, see :class:`Host`. limit: seconds for a request, which the other end watches. A
    request is a method's name and its arguments; the answer whether that succeeded, and what came of it, an
    error's line where it didn't.
    """
    requests, answers = _take_streams()
    waiting: SimpleQueue[Any] = SimpleQueue()
    threading.Thread(target=_read, args=(requests, waiting), daemon=True).start()
    _offer_to_the_memory_killer()
    cv2.setNumThreads(1)
    host = Host(place)
    while (request := waiting.get()) is not None:
        # This ends even a process that hangs outside of Python and whose parent was killed.
        faulthandler.dump_traceback_later(limit + GRACE, exit=True)
        answer = _answer(host, *request)
        faulthandler.cancel_dump_traceback_later()
        answers.write(pickle.dumps(answer, pickle.HIGHEST_PROTOCOL))
        answers.flush()
    host.close()


def _take_streams() -> tuple[BinaryIO, BinaryIO]:
    """Standard input and output for requests and answers; the tracker gets an empty one, and stderr."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    sys.stdout.flush()
    os.dup2(2, 1)
    return requests, answers


def _read(requests: BinaryIO, waiting: "SimpleQueue[Any]") -> None:
    """Hand requests on. At their end, which is also that of a killed parent, end this process and all that it
    has started.
    """
    with suppress(EOFError, OSError, pickle.UnpicklingError):
        while True:
            waiting.put(pickle.load(requests))
    waiting.put(None)
    time.sleep(PATIENCE)
    if sys.platform != "win32":
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


def _offer_to_the_memory_killer() -> None:
    """Where memory runs out, Linux shall end this process first."""
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")


def _answer(host: Host, method: str, *arguments: Any) -> tuple[bool, Any]:
    try:
        return True, getattr(host, method)(*arguments)
    except SystemExit as error:
        return False, f"it called sys.exit({'' if error.code is None else repr(error.code)[:40]})"
    except BaseException as error:
        return False, _describe(error)


def _describe(error: BaseException) -> str:
    """An error in one line, with its type where its message doesn't stand for itself."""
    message = one_line(error)
    speaking = isinstance(error, (BoxError, ImportError, OSError, TraxError, cv2.error))
    speaking = speaking or type(error) is ValueError
    return message if speaking or message == type(error).__name__ else f"{type(error).__name__}: {message}"
