# SPDX-License-Identifier: MIT
"""Signals that end a command: Ctrl-C, what `kill` sends, and a closed terminal. All leave complete files."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

ENDING = tuple(
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP")
    if hasattr(signal, name)  # not on Windows
)


@contextmanager
def clean_exits() -> Iterator[None]:
    """SIGTERM and SIGHUP raise SystemExit, with 128 plus their number, so that open files are finished."""

    def leave(number: int, _frame: FrameType | None) -> None:
        raise SystemExit(128 + number)

    with _handled(ENDING[1:], leave):
        yield


@contextmanager
def catch_signals() -> Iterator[Callable[[], int]]:
    """Yield a function that returns the number of the signal received, 0 if none, so that the current frame
    can be finished. A second signal interrupts.
    """
    caught = 0

    def catch(number: int, _frame: FrameType | None) -> None:
        nonlocal caught
        if caught:
            raise KeyboardInterrupt
        caught = number

    with _handled(ENDING, catch):
        yield lambda: caught


@contextmanager
def _handled(numbers: tuple[signal.Signals, ...], handler: Any) -> Iterator[None]:
    """Install the handler for these signals in the main thread, the only one that can handle signals.

    If SIGHUP is ignored, it stays ignored, because that is how nohup keeps a command alive.
    """
    main = threading.current_thread() is threading.main_thread()
    chosen = [each for each in numbers if main and not _is_kept_alive(each)]
    before = {number: signal.signal(number, handler) for number in chosen}
    try:
        yield
    finally:
        for number, former in before.items():
            signal.signal(number, former)


def _is_kept_alive(number: signal.Signals) -> bool:
    return number.name == "SIGHUP" and signal.getsignal(number) is signal.SIG_IGN
