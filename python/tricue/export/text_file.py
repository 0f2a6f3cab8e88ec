# SPDX-License-Identifier: MIT
"""Text files written line by line: each write reaches the system at once, and errors name the file."""

import os
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

ROOM = 10_000  # of the last texts may be dropped to make room for the file's end on a full disk


class TextFile:
    """A new text file, in a folder that is created if missing; use it in ``with``.

    Each :meth:`put` is passed to the system at once, so that it survives a killed process. OSError names the
    file if it can't be written, and at the end if it no longer exists. On a full disk the file still gets its
    end, without the last texts if there is no room.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self._file = path.open("wb", buffering=0)
        self._ends = deque([0], ROOM)  # where the texts end, in bytes
        self._failed = False

    @property
    def about(self) -> str:
        """The file's name."""
        return str(self.path)

    def put(self, text: str) -> None:
        """Append a text, as a whole or not at all."""
        data = memoryview(text.encode())
        end = self._ends[-1] + len(data)
        with self._naming():
            try:
                while data:
                    data = data[os.write(self._file.fileno(), data) :]
            except OSError:
                self._failed = True
                self._cut()
                if not self._ends[-1]:
                    self._file.close()
                raise
        self._ends.append(end)

    def finish(self) -> None:
        """Append the end of a complete file; does nothing here."""

    def __enter__(self) -> "TextFile":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        if self._failed:
            self._finish_early()
            return
        try:
            self.finish()
        except OSError:
            self._finish_early()
            raise
        finally:
            with self._naming():
                self._file.close()
        if not self.path.exists():
            raise OSError(f"{self.path}: was removed while it was written")

    def _finish_early(self) -> None:
        """Append the end to as many of the texts as leave room for it."""
        while self._ends and self._ends[-1]:
            with suppress(OSError):
                self.finish()
                break
            self._ends.pop()
            if self._ends:
                self._cut()
        with suppress(OSError):
            self._file.close()

    def _cut(self) -> None:
        """Keep only whole texts, unless the file is a pipe."""
        with suppress(OSError):
            self._file.truncate(self._ends[-1])
            self._file.seek(self._ends[-1])

    @contextmanager
    def _naming(self) -> Iterator[None]:
        """Name the file in errors, such as that of a full disk; Python does so only when opening it."""
        try:
            yield
        except BrokenPipeError:
            raise
        except OSError as error:
            raise OSError(error.errno, error.strerror, str(self.path)) from None
