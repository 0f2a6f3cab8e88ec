# SPDX-License-Identifier: MIT
"""Whether the files that a command writes may be written: over nothing that it reads, and each once."""

from collections.abc import Iterable, Sequence
from pathlib import Path


def check_not_read(outputs: Sequence[Path], read: Iterable[Path]) -> None:
    """ValueError for an output that is, by whatever name, one of the files that are read."""
    there = [path for path in outputs if _identity(path)]
    inputs = set(filter(None, map(_identity, read))) if there else set()
    for path in there:
        if _identity(path) in inputs:
            raise ValueError(f"{path}: expected a file to write to that isn't read")


def check_different(outputs: Sequence[Path]) -> None:
    """ValueError for a file that is there twice."""
    files = [path for path in outputs if path.is_file() or not path.exists()]  # not /dev/null
    names = [_identity(path) or path.resolve() for path in files]
    for index, path in enumerate(files):
        if names[index] in names[:index]:
            raise ValueError(f"{path}: expected a file for each output, got this one twice")


def _identity(path: Path) -> tuple[int, int] | None:
    """What all names of a file have in common, links and hard links too; None where there is no such file."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_dev, found.st_ino
