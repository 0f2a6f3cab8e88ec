# SPDX-License-Identifier: MIT
"""Whether a file can be written, found out without touching it."""

import errno
import os
import stat
from pathlib import Path


def check_writable(path: Path) -> None:
    """OSError that names a file that can't be written; what is there stays, and nothing is made.

    Folders that are missing on the way to it count as there: who writes makes them.
    """
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        _check_folder(path)
        return
    if stat.S_ISREG(mode) or stat.S_ISDIR(mode):  # a pipe's reader would take it for its end
        os.close(os.open(path, os.O_WRONLY))


def _check_folder(path: Path) -> None:
    """OSError where a new file can't be made."""
    folder = next(folder for folder in path.absolute().parents if folder.exists())
    if not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(path))
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
