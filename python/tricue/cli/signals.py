# SPDX-License-Identifier: MIT
"""Signals that end a command: Ctrl-C, what `kill` sends, and a closed terminal. All leave complete files."""

import signal
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, TypeVar

T = TypeVar("T")

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


class CaughtSignal:
    """The first signal received; calling it gives its number, 0 if none."""

    def __init__(self) -> None:
        self._number = 0
        self._awaiting = False

    def __call__(self) -> int:
        return self._number

    def catch(self, number: int, _frame: FrameType | None) -> None:
        """The handler: a second signal interrupts, and so does one that comes while an item is awaited."""
        second, self._number = self._number != 0, self._number or number
        if second or self._awaiting:
            raise KeyboardInterrupt

    def until_caught(self, items: Iterable[T]) -> Iterator[T]:
        """The items until a signal comes. It doesn't wait for the next item: a camera that has stopped may
        give none for a minute.
        """
        iterator = iter(items)
        while not self._number:
            try:
                self._awaiting = True
                item = next(iterator)
            except (StopIteration, KeyboardInterrupt):
                return
            finally:
                self._awaiting = False
            yield item


@contextmanager
def catch_signals() -> Iterator[CaughtSignal]:
    """Catch signals, so that the current frame can be finished. A second signal interrupts."""
    caught = CaughtSignal()
    with _handled(ENDING, caught.catch):
        yield caught


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
