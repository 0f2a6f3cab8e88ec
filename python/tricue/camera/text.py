# SPDX-License-Identifier: MIT
"""Text files that others wrote: UTF-8, or UTF-16 as Excel and PowerShell write it."""

import codecs
import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def encoding_of(content: bytes) -> str:
    """UTF-16 for a text that begins with its byte order mark, else UTF-8, with or without its own."""
    marks = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
    return "utf-16" if content.startswith(marks) else "utf-8-sig"


@contextmanager
def open_text(path: Path, errors: str = "replace") -> Iterator[io.TextIOWrapper]:
    """A text file, opened once, as it may be a pipe. errors: as :func:`open` takes it."""
    with path.open("rb") as file:
        yield io.TextIOWrapper(file, encoding=encoding_of(file.peek(2)), errors=errors)


def read_text(path: Path) -> str:
    """The whole text of a file; bytes that aren't in its encoding are replaced."""
    with open_text(path) as file:
        return file.read()


def read_lines(path: Path) -> list[str]:
    """The lines of a text file, see :func:`lines_of`."""
    return list(lines_of(path))


def lines_of(path: Path) -> Iterator[str]:
    """The lines of a text file one by one, without empty ones at the end; bytes that aren't in its encoding
    are replaced.
    """
    empty = list[str]()
    with open_text(path) as file:
        for line in file:
            empty.append(line.removesuffix("\n"))
            if line.strip():
                yield from empty
                empty.clear()
