# SPDX-License-Identifier: MIT
"""Ctrl-C while the program ``tricue`` imports its modules, half a second: a line instead of a traceback.

The import of the package comes before any of the program's own code, so the package itself calls this.
"""

import os
import signal
import sys
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from types import FrameType

INTERRUPTED = 130


def begin() -> None:
    """End the program at Ctrl-C with a line, from now until :func:`end`; elsewhere do nothing."""
    if _is_program() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _leave)


def end() -> None:
    """Let Ctrl-C raise KeyboardInterrupt again, as the program's own code expects."""
    if signal.getsignal(signal.SIGINT) is _leave:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _is_program() -> bool:
    """Whether this process runs ``tricue`` or ``python -m tricue``, and isn't one of its workers, which get
    its ``sys.argv`` but have another command line.
    """
    first, words = (sys.argv or [""])[0], sys.orig_argv
    if first == "-m":  # until the module is found
        return ("-m", "tricue") in pairwise(words)
    return Path(first).stem == "tricue" and first in words


def _leave(_number: int, _frame: FrameType | None) -> None:
    """End at once: an exception may be swallowed, or replaced, by the module that is imported just now."""
    with suppress(OSError):  # stderr may be closed
        os.write(2, b"tricue: interrupted\n")
    os._exit(INTERRUPTED)
