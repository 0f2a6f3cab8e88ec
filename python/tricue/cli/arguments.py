# SPDX-License-Identifier: MIT
"""Options and argument types shared by several commands."""

import argparse
import math
import os
import re
import sys
from pathlib import Path
from typing import NamedTuple

from tricue.camera.box import Box, as_box
from tricue.errors import one_line
from tricue.track.base.registry import tracker_class

MAX_COUNT = 1_000_000  # of processes, seeds or frames read ahead
MAX_FRAME = 1_000_000_000


def add_common(command: argparse.ArgumentParser) -> None:
    """Options of every command that runs a tracker."""
    command.add_argument(
        "--kernels", default="native", choices=("native", "reference"), help="default %(default)s"
    )
    command.add_argument(
        "--seed", type=seed, default=0, help="seed of the random numbers, default %(default)s"
    )


def count(text: str) -> int:
    """A whole number above 0, at most MAX_COUNT."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"expected a whole number above 0, got {text!r}")
    if int(text) > MAX_COUNT:
        raise argparse.ArgumentTypeError(f"expected at most {MAX_COUNT:,}, got {text}")
    return int(text)


def number(text: str) -> float:
    """A finite number."""
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise argparse.ArgumentTypeError(f"expected a finite number, got {text!r}")
    return found


def seed(text: str) -> int:
    """A whole number from 0 on."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"expected a whole number from 0 on, got {text!r}")
    return int(text)


def share(text: str) -> float:
    """A number from 0 to 1."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 <= number <= 1:
        raise argparse.ArgumentTypeError(f"expected a share, 0 to 1, got {text!r}")
    return number


def output_file(text: str) -> Path:
    """The path of a file to write; not that of a folder, of which Path would drop the slash at the end."""
    if text.endswith(("/", os.sep)):
        raise argparse.ArgumentTypeError(f"expected a file's name, got the folder {text!r}")
    return Path(text)


def words(text: str) -> list[str]:
    """Words separated by commas."""
    found = [word.strip() for word in text.split(",") if word.strip()]
    if not found:
        raise argparse.ArgumentTypeError(f"expected names separated by commas, got {text!r}")
    return found


def box(text: str) -> Box:
    """A box x,y,width,height."""
    try:
        return as_box([float(number) for number in text.split(",")])
    except ValueError as error:
        reason = (
            str(error)
            if str(error).startswith("box:")
            else f"expected four numbers x,y,width,height, got {text!r}"
        )
        raise argparse.ArgumentTypeError(reason.removeprefix("box: ")) from None


class StartBox(NamedTuple):
    """A box to start on, and the number of its frame from 0; None for the first one."""

    box: Box
    frame: int | None = None


def start_box(text: str) -> StartBox:
    """A box x,y,width,height, or, for a frame other than the first, FRAME:x,y,width,height."""
    number, colon, numbers = text.rpartition(":")
    if colon and not number.isdecimal():
        raise argparse.ArgumentTypeError(f"expected FRAME:x,y,width,height, got {text!r}")
    return StartBox(box(numbers), frame_number(number) if colon else None)


def frame_number(text: str) -> int:
    """A whole number from 0 on, at most MAX_FRAME."""
    if not text.isdecimal() or int(text) > MAX_FRAME:
        raise argparse.ArgumentTypeError(f"expected a frame's number, 0 to {MAX_FRAME:,}, got {text!r}")
    return int(text)


def seconds(text: str) -> float:
    """A number of seconds above 0."""
    return _above_0(text, "seconds")


def meters(text: str) -> float:
    """A number of meters above 0."""
    return _above_0(text, "meters")


def _above_0(text: str, unit: str) -> float:
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not 0 < found < math.inf:
        raise argparse.ArgumentTypeError(f"expected {unit} above 0, got {text!r}")
    return found


def angles(text: str) -> tuple[float, ...]:
    """One angle or two, H,V in degrees."""
    try:
        found = tuple(float(number) for number in text.split(","))
    except ValueError:
        found = ()
    if len(found) not in (1, 2):
        raise argparse.ArgumentTypeError(f"expected one angle or two, H,V in degrees, got {text!r}")
    return found


def topics(text: str) -> dict[str, str]:
    """Topics of a recording by channel, color=/a,depth=/b."""
    found = dict(part.strip().split("=", 1) for part in text.split(",") if "=" in part)
    if len(found) != text.count(",") + 1 or not all(found) or not all(found.values()):
        raise argparse.ArgumentTypeError(f"expected color=/topic,depth=/topic,right=/topic, got {text!r}")
    return found


def add_topics(command: argparse.ArgumentParser) -> None:
    """Add the option that chooses a recording's topics."""
    command.add_argument(
        "--topics",
        type=topics,
        metavar="CHANNEL=TOPIC,...",
        help="topics to read from a recording: color=/a,depth=/b",
    )


def find_modules_here() -> None:
    """Make modules in the working folder importable, as Python does for a script there."""
    if "" not in sys.path and (here := str(Path.cwd())) not in sys.path:
        sys.path.insert(0, here)


def tracker_name(text: str) -> str:
    """A tracker's name, ``module:Class`` of a module that is installed or in the working folder, or
    ``path/to/file.py:Class``.
    """
    if ":" in text:
        find_modules_here()
    try:
        tracker_class(text)
    except (ImportError, OSError, SyntaxError, TypeError, ValueError) as error:
        raise argparse.ArgumentTypeError(one_line(error).removeprefix("name: ")) from None
    return text


def tracker_names(text: str) -> list[str]:
    """Tracker names as :func:`tracker_name` takes them, separated by commas."""
    return [tracker_name(name) for name in words(text)]


def any_tracker_names(text: str) -> list[str]:
    """Names of any trackers, separated by commas. A TraX program's command is all the rest, with commas."""
    find_modules_here()
    found = re.search(r"(?:^|,)\s*((?:[^,:=]+=)?trax:.*)", text, re.DOTALL)
    if found is None:
        return words(text)
    return [*(words(text[: found.start()]) if found.start() else ()), found[1]]
