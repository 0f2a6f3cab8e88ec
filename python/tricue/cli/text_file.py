# SPDX-License-Identifier: MIT
"""Text files that are written line by line: what is written is on the disk, and errors name the file."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


class TextFile:
    """A new text file, and its folder where there is none; use it in ``with``.

    Each :meth:`put` is handed to the system at once, so that it is kept where the process is killed.
    OSError with the file's name where it can't be written, and at the end where it is no longer there.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self._file = path.open("w", encoding="utf-8", newline="")

    @property
    def about(self) -> str:
        """The file's name."""
        return str(self.path)

    def put(self, text: str) -> None:
        """Append some text."""
        with self._naming():
            try:
                self._file.write(text)
                self._file.flush()
            except OSError:
                with suppress(OSError):
                    self._file.close()  # which fails, too, and closes it
                raise

    def finish(self) -> None:
        """Append what a whole file ends with; does nothing here."""

    def __enter__(self) -> "TextFile":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        if self._file.closed:
            return
        try:
            self.finish()
        finally:
            with self._naming():
                self._file.close()
        if not self.path.exists():
            raise OSError(f"{self.path}: was removed while it was written")

    @contextmanager
    def _naming(self) -> Iterator[None]:
        """Name the file in an error, such as that of a full disk; Python names only what it opens."""
        try:
            yield
        except BrokenPipeError:
            raise
        except OSError as error:
            raise OSError(error.errno, error.strerror, str(self.path)) from None
