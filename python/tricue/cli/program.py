# SPDX-License-Identifier: MIT
"""The command line: parses the arguments, runs the command, and prints errors on one line.

Exit codes are those of Unix tools: 0, 1 if evaluate, compare or doctor has something to report, 2 for an
error, and 128 plus the signal's number after a signal.
"""

import argparse
import importlib
import io
import os
import re
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import tricue
from tricue.cli.option_names import by_options
from tricue.cli.signals import clean_exits
from tricue.errors import one_line
from tricue.start import INTERRUPTED, raise_interrupts

USAGE = 2
CLOSED_PIPE = 141
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]\d+)?")
MAX_LISTED = 3  # of the arguments that aren't known

# The help text of each command, implemented in the module of the same name.
COMMANDS = {
    "demo": "track a scene with known truth",
    "track": "track in a video, a folder, a camera",
    "open": "draw boxes in a video, track and correct, in the browser",
    "info": "describe a video, a folder, a sequence",
    "evaluate": "compare trackers with OpenCV's on a data set",
    "compare": "compare two evaluations, and say what got worse",
    "calibrate": "measure a tracker's parameters on your own images",
    "reproduce": "repeat an experiment of the papers",
    "vot-workspace": "let the VOT toolkit run trackers",
    "doctor": "tell what is installed, what works, and what is missing",
}


class Parser(argparse.ArgumentParser):
    """A parser that prints errors on one line, without the usage."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Report unknown options here, so that the error names the command, whose help lists its options."""
        options, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {_listed(unknown)}")
        self._refuse_empty(args or ())
        return options, unknown

    def _refuse_empty(self, words: Sequence[str]) -> None:
        """Report empty arguments, because as a path each would be the folder where the command is started."""
        for word in words:
            if not word:
                self.error("an argument is empty; is a shell variable unset?")
            if re.fullmatch(r"--[a-z-]+=", word):
                self.error(f"argument {word[:-1]}: it is empty; is a shell variable unset?")

    def error(self, message: str) -> NoReturn:
        if found := re.fullmatch(r"argument (--[a-z-]+): expected one argument", message):
            message += f"; one that begins with a minus needs {found[1]}="
        self.exit(USAGE, f"{self.prog}: {message}; see {self.prog} --help\n")


def _listed(words: Sequence[str]) -> str:
    """The first of them. A shell turns img/*.jpg into the names of all images, for which a hint says what to
    give instead.
    """
    from tricue.data.files import is_image  # only errors need it

    more = f" and {len(words) - MAX_LISTED} more" if len(words) > MAX_LISTED else ""
    hint = "; give the folder of several images" if all(is_image(Path(word)) for word in words) else ""
    return f"{' '.join(words[:MAX_LISTED])}{more}{hint}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code: 2 for an error (one line on stderr), 130 for Ctrl-C."""
    silence_opencv()
    _replace_closed_streams()
    for stream in (sys.stdout, sys.stderr):  # a terminal may not support all letters of a file's name
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        raise_interrupts()
        command = next((word for word in words if not word.startswith("-")), "")
        options = parser(command).parse_args(words)
    except KeyboardInterrupt:  # importing the command takes a while
        print("tricue: interrupted", file=sys.stderr)
        return INTERRUPTED
    try:
        with _one_line_warnings(options.command), clean_exits():
            code: int = options.run(options)
            sys.stdout.flush()
        return code
    except BrokenPipeError:
        os.dup2(
            os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno()
        )  # Python flushes it once more at the end
        return CLOSED_PIPE
    except (ImportError, OSError, RuntimeError, TypeError, ValueError) as error:
        print(f"tricue {options.command}: {by_options(one_line(error))}", file=sys.stderr)
        return USAGE
    except KeyboardInterrupt:
        print(f"tricue {options.command}: interrupted", file=sys.stderr)
        return INTERRUPTED


def parser(chosen: str = "") -> argparse.ArgumentParser:
    """The commands, with the options of the chosen one; only its module is imported."""
    top = Parser(prog="tricue", description=tricue.__doc__)
    top.add_argument("--version", action="version", version=f"tricue {tricue.__version__}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, about in COMMANDS.items():
        command = commands.add_parser(
            name, help=about, description=about, formatter_class=argparse.RawDescriptionHelpFormatter
        )
        if name == chosen:
            module = importlib.import_module(f"tricue.cli.{name.replace('-', '_')}")
            command.epilog = module.EXAMPLES
            module.add_options(command)
            command.set_defaults(run=module.run)
    return top


@contextmanager
def _one_line_warnings(command: str) -> Iterator[None]:
    """Print warnings on one line, and those that differ only in numbers once, because frames repeat them."""
    shown: set[tuple[str, int, str]] = set()

    def show(message: Warning | str, _category: object, filename: str, lineno: int, *_: object) -> None:
        warning = filename, lineno, NUMBER.sub("", str(message))
        if warning not in shown:
            shown.add(warning)
            print(f"tricue {command}: warning: {by_options(str(message))}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.showwarning = show  # type: ignore[assignment]  # it takes all that it is given
        yield


def _replace_closed_streams() -> None:
    """Read nothing and write nowhere if a service starts the command without standard streams."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open(mode, encoding="utf-8"))  # noqa: SIM115 (until the end)


def silence_opencv() -> None:
    """Keep OpenCV and FFmpeg from writing to stderr; relevant errors are raised as exceptions."""
    os.environ.setdefault("OPENCV_LOG_LEVEL", "SILENT")
    os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
