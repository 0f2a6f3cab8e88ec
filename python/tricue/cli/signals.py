# SPDX-License-Identifier: MIT
"""Signals that end a command: Ctrl-C, what `kill` sends, and a closed terminal. All leave complete files."""

import signal
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, TypeVar

T = TypeVar("T")

MAX_LAST_FRAME = 3.0
"""Seconds that the current frame may take after a signal: many times what a slow tracker needs."""

ENDING = tuple(
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP")
    if hasattr(signal, name)  # not on Windows
)
ALARM = (signal.SIGALRM,) if hasattr(signal, "SIGALRM") else ()


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
        self._awaiting = self._working = False

    def __call__(self) -> int:
        return self._number

    def catch(self, number: int, _frame: FrameType | None) -> None:
        """The handler: a second signal interrupts, and so does one that comes while an item is awaited."""
        second, self._number = self._number != 0, self._number or number
        if second or self._awaiting:
            raise KeyboardInterrupt
        if self._working:
            _set_alarm(MAX_LAST_FRAME)

    def expire(self, _number: int, _frame: FrameType | None) -> None:
        """The alarm's handler."""
        if self._working:
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

    def unless_stuck(self, items: Iterable[T]) -> Iterator[T]:
        """The items. After a signal the one in work may be finished, but not wait forever, as for a process
        that hangs; then, and after a second signal, there are no more.
        """
        iterator = iter(items)
        while True:
            try:
                self._working = True
                item = next(iterator)
            except StopIteration:
                return
            except KeyboardInterrupt:
                if not self._number:
                    raise
                return
            finally:
                self._working = False
                if self._number:
                    _set_alarm(0)
            yield item


def _set_alarm(seconds: float) -> None:
    """Send SIGALRM after this time, or never for 0; nothing on Windows, which has none."""
    if hasattr(signal, "setitimer") and threading.current_thread() is threading.main_thread():
        signal.setitimer(signal.ITIMER_REAL, seconds)


@contextmanager
def catch_signals() -> Iterator[CaughtSignal]:
    """Catch signals, so that the current frame can be finished. A second signal interrupts."""
    caught = CaughtSignal()
    with _handled(ENDING, caught.catch), _handled(ALARM, caught.expire):
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
