# SPDX-License-Identifier: MIT
"""Progress of a run: a bar on a terminal, otherwise a plain line every few seconds."""

import sys
import time
from typing import TextIO

BAR_WIDTH = 24
SEARCH_NOTE = "folders searched for sequences"
_TERMINAL_EVERY, _PLAIN_EVERY = 0.1, 10.0  # seconds


class Progress:
    """``with Progress(total) as progress: progress(done, "note")``.

    The total may be unknown. Once more is done, it was wrong and is no longer shown.
    """

    def __init__(self, total: int | None = None, stream: TextIO | None = None) -> None:
        self.total, self.stream = total, stream or sys.stderr
        self.terminal = self.stream.isatty()
        self._every = _TERMINAL_EVERY if self.terminal else _PLAIN_EVERY
        self._next = time.monotonic() + self._every
        self._shown = 0

    def __call__(self, done: int, note: str = "") -> None:
        if time.monotonic() < self._next:
            return
        self._next = time.monotonic() + self._every
        total = self.total if self.total and done <= self.total else None
        bar = self._bar(done, total) if self.terminal and total else ""
        line = f"{bar}{done:,}{f'/{total:,}' if total else ''}  {note}".rstrip()
        if self.terminal:
            self.stream.write(f"\r{line.ljust(self._shown)}")
            self._shown = len(line)
        else:
            self.stream.write(f"{line}\n")
        self.stream.flush()

    def __enter__(self) -> "Progress":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        if self._shown:
            self.stream.write(f"\r{' ' * self._shown}\r")
            self.stream.flush()

    @staticmethod
    def _bar(done: int, total: int) -> str:
        full = BAR_WIDTH * done // total
        return f"[{'#' * full}{'.' * (BAR_WIDTH - full)}] "
