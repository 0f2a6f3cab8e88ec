# SPDX-License-Identifier: MIT
"""Checks whether a file can be written, without touching it, and names it in errors while it is."""

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def check_writable(path: Path) -> None:
    """Raise OSError, which names the file, if it can't be written; nothing is changed or created.

    Missing folders on its path are no problem, because the writer creates them.
    """
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        _check_folder(path)
        return
    if stat.S_ISREG(mode) or stat.S_ISDIR(mode):  # opening a pipe would look like its end to the reader
        os.close(os.open(path, os.O_WRONLY))


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Name the file in errors, such as that of a full disk; Python does so only when opening it."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(path)) from None


def _check_folder(path: Path) -> None:
    """Raise OSError if a new file can't be created."""
    folder = next(folder for folder in path.absolute().parents if folder.exists())
    if not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(path))
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
