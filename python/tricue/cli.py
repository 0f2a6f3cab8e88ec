# SPDX-License-Identifier: MIT
"""The command line: parses, calls, prints."""

import argparse
import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import NoReturn

import tricue
from tricue.errors import one_line
from tricue.verbs import VERBS

USAGE, INTERRUPTED = 2, 130


class Parser(argparse.ArgumentParser):
    """Errors in one line, without the usage in front."""

    def error(self, message: str) -> NoReturn:
        self.exit(USAGE, f"{self.prog}: {message}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; the exit code: 0, 2 for an error (one line on stderr), 130 after Ctrl-C."""
    silence_opencv()
    options = parser().parse_args(arguments)
    try:
        with _warnings_in_a_line(options.verb):
            code: int = options.run(options)
        return code
    except (ImportError, OSError, RuntimeError, TypeError, ValueError) as error:
        print(f"tricue {options.verb}: {one_line(error)}", file=sys.stderr)
        return USAGE
    except KeyboardInterrupt:
        print(f"tricue {options.verb}: interrupted", file=sys.stderr)
        return INTERRUPTED


def parser() -> argparse.ArgumentParser:
    """The verbs and their options."""
    top = Parser(prog="tricue", description=tricue.__doc__)
    top.add_argument("--version", action="version", version=f"tricue {tricue.__version__}")
    found = top.add_subparsers(dest="verb", metavar="VERB", required=True)
    for each in VERBS:
        verb = found.add_parser(
            each.name,
            help=each.about,
            description=each.about,
            epilog=each.examples,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        each.add_options(verb)
        verb.set_defaults(run=each.run)
    return top


@contextmanager
def _warnings_in_a_line(verb: str) -> Iterator[None]:
    """Warnings as short as errors; a place in the code warns once, for the next frames would say the same."""
    told: set[tuple[str, int]] = set()

    def show(message: Warning | str, _category: object, filename: str, lineno: int, *_: object) -> None:
        if (filename, lineno) not in told:
            told.add((filename, lineno))
            print(f"tricue {verb}: warning: {message}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.showwarning = show  # type: ignore[assignment]  # it takes all that it is given
        yield


def silence_opencv() -> None:
    """OpenCV and FFmpeg write to stderr by themselves; what matters of it comes as an exception."""
    os.environ.setdefault("OPENCV_LOG_LEVEL", "SILENT")
    os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
