# SPDX-License-Identifier: MIT
"""Ctrl-C while the package is imported: the command ends quietly, as it does later. Imports nothing slow."""

import contextlib
import os
import signal
import sys
from pathlib import Path
from types import FrameType

INTERRUPTED = 130  # 128 plus the signal's number


def is_command() -> bool:
    """Whether this process runs ``tricue`` or ``python -m tricue``, not a program that imports it."""
    words = sys.argv
    if words[:1] == ["-m"]:  # until the module itself runs; its name is before its arguments
        return sys.orig_argv[-len(words)] == "tricue"
    return bool(words) and Path(words[0]).stem == "tricue" and Path(words[0]).is_file()


def exit_at_interrupts() -> None:
    """Let Ctrl-C end the process at once, as nothing is open yet. Extension modules would turn an exception
    into one of their own. An ignored signal, as of a command in the background, stays ignored.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _exit)


def raise_interrupts() -> None:
    """Let Ctrl-C raise KeyboardInterrupt again."""
    if signal.getsignal(signal.SIGINT) is _exit:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _exit(_number: int, _frame: FrameType | None) -> None:
    with contextlib.suppress(OSError):  # stderr may be closed
        os.write(2, b"tricue: interrupted\n")
    os._exit(INTERRUPTED)
