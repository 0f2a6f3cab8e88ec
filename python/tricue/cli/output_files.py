# SPDX-License-Identifier: MIT
"""Checks that a command's output files don't overwrite its input, and that each is written once."""

from collections.abc import Iterable, Sequence
from pathlib import Path


def check_not_read(outputs: Sequence[Path], read: Iterable[Path]) -> None:
    """Raise ValueError for an output that is, by any name, one of the input files."""
    there = [path for path in outputs if _identity(path)]
    inputs = set(filter(None, map(_identity, read))) if there else set()
    for path in there:
        if _identity(path) in inputs:
            raise ValueError(f"{path}: expected a file to write to that isn't read")


def check_different(outputs: Sequence[Path]) -> None:
    """Raise ValueError for a file that occurs twice."""
    files = [path for path in outputs if path.is_file() or not path.exists()]  # not /dev/null
    names = [_identity(path) or path.resolve() for path in files]
    for index, path in enumerate(files):
        if names[index] in names[:index]:
            raise ValueError(f"{path}: expected a file for each output, got this one twice")


def _identity(path: Path) -> tuple[int, int] | None:
    """What all names of a file, including links and hard links, have in common; None if it doesn't exist."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_dev, found.st_ino
