# SPDX-License-Identifier: MIT
"""Kernels' arguments, some of which are tuples of several."""

from collections.abc import Sequence
from typing import Any

Place = int | tuple[int, int]  # of an argument, or of a part of one that is a tuple


def argument(arguments: Sequence[Any], place: Place) -> Any:
    """The argument, or part of one, at a place."""
    if isinstance(place, int):
        return arguments[place]
    first, second = place
    return arguments[first][second]


def with_argument(arguments: Sequence[Any], place: Place, value: Any) -> list[Any]:
    """The arguments with another value at a place."""
    changed = list(arguments)
    if isinstance(place, int):
        changed[place] = value
    else:
        first, second = place
        parts = list(changed[first])
        parts[second] = value
        changed[first] = tuple(parts)
    return changed
