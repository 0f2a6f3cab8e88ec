# SPDX-License-Identifier: MIT
"""Progress of a run: a bar on a terminal, otherwise a plain line every few seconds."""

import sys
import time
from typing import TextIO

BAR_WIDTH = 24
_TERMINAL_EVERY, _PLAIN_EVERY = 0.1, 10.0  # seconds


class Progress:
    """``with Progress(total) as progress: progress(done, "note")``; the total may be unknown."""

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
        line = f"{self._bar(done)}{done:,}{f'/{self.total:,}' if self.total else ''}  {note}".rstrip()
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

    def _bar(self, done: int) -> str:
        if not (self.terminal and self.total):
            return ""
        full = min(BAR_WIDTH, BAR_WIDTH * done // self.total)
        return f"[{'#' * full}{'.' * (BAR_WIDTH - full)}] "
