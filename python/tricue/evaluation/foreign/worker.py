# SPDX-License-Identifier: MIT
"""The process that runs a third-party tracker: the other end of a ``WorkerProcess``.

The tracker's output goes to standard error, so that it never mixes with the answers.
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

PATIENCE = 2.0  # seconds to end cleanly
GRACE = 5.0  # seconds after the time limit until the process ends itself, if its parent doesn't


def main(place: str, limit: float) -> None:
    """Answer requests until standard input ends.

    place: of the tracker, see :class:`Host`. limit: seconds for a request, enforced by the other end. A
    request is a method's name and arguments; the answer is whether it succeeded, and the result or an error's
    line.
    """
    requests, answers = _take_streams()
    waiting: SimpleQueue[Any] = SimpleQueue()
    threading.Thread(target=_read, args=(requests, waiting), daemon=True).start()
    _offer_to_the_memory_killer()
    cv2.setNumThreads(1)
    host = Host(place)
    while (request := waiting.get()) is not None:
        # This ends even a process that hangs outside Python and whose parent was killed.
        faulthandler.dump_traceback_later(limit + GRACE, exit=True)
        answer = _answer(host, *request)
        faulthandler.cancel_dump_traceback_later()
        answers.write(pickle.dumps(answer, pickle.HIGHEST_PROTOCOL))
        answers.flush()
    host.close()


def _take_streams() -> tuple[BinaryIO, BinaryIO]:
    """Standard input and output for requests and answers; the tracker gets empty input, and stderr."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    sys.stdout.flush()
    os.dup2(2, 1)
    return requests, answers


def _read(requests: BinaryIO, waiting: "SimpleQueue[Any]") -> None:
    """Pass requests on. When they end, also because the parent was killed, end this process and its
    children.
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
    """If memory runs out, let Linux kill this process first."""
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
    """An error in one line, with its type if the message alone isn't clear."""
    message = one_line(error)
    speaking = isinstance(error, (BoxError, ImportError, OSError, TraxError, cv2.error))
    speaking = speaking or type(error) is ValueError
    return message if speaking or message == type(error).__name__ else f"{type(error).__name__}: {message}"
