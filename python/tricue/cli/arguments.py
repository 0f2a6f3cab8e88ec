# SPDX-License-Identifier: MIT
"""Options and types of arguments that several commands share."""

import argparse

from tricue.camera.box import Box, as_box


def add_common(command: argparse.ArgumentParser) -> None:
    """Options of every command that runs a tracker."""
    command.add_argument(
        "--kernels", default="native", choices=("native", "reference"), help="default %(default)s"
    )
    command.add_argument("--seed", type=int, default=0, help="of the random numbers, default %(default)s")


def count(text: str) -> int:
    """A whole number above 0."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"expected a whole number above 0, got {text!r}")
    return int(text)


def words(text: str) -> list[str]:
    """Words with commas between."""
    found = [word.strip() for word in text.split(",") if word.strip()]
    if not found:
        raise argparse.ArgumentTypeError(f"expected names with commas between, got {text!r}")
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


def angles(text: str) -> tuple[float, ...]:
    """One angle or two, H,V in degrees."""
    try:
        found = tuple(float(number) for number in text.split(","))
    except ValueError:
        found = ()
    if len(found) not in (1, 2):
        raise argparse.ArgumentTypeError(f"expected one angle or two, H,V in degrees, got {text!r}")
    return found
