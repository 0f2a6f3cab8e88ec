# SPDX-License-Identifier: MIT
"""Kernels' arguments, some of which are tuples of several."""

from collections.abc import Mapping, Sequence
from typing import Any

Place = int | tuple[int, int]  # of an argument, or of a part of one that is a tuple


def argument(arguments: Sequence[Any], place: Place) -> Any:
    """The argument, or part of one, at a place."""
    if isinstance(place, int):
        return arguments[place]
    first, second = place
    return arguments[first][second]


def with_parts(
    arguments: dict[str, Any], parts: Mapping[str, Sequence[str]], changes: Mapping[str, Any]
) -> dict[str, Any]:
    """Named arguments with other values of some of them, or of parts, which are named, too."""
    changed = {**arguments, **{name: value for name, value in changes.items() if name in arguments}}
    for name, names in parts.items():
        if any(part in changes for part in names):
            changed[name] = tuple(
                changes.get(part, usual) for part, usual in zip(names, arguments[name], strict=True)
            )
    unknown = changes.keys() - arguments.keys() - {part for names in parts.values() for part in names}
    assert not unknown, f"neither arguments nor parts: {unknown}"
    return changed


def grouped(values: Mapping[str, Any], parts: Mapping[str, Sequence[str]]) -> dict[str, Any]:
    """Named arguments, from values of which some are parts of tuples."""
    inside = {part for names in parts.values() for part in names}
    arguments = {name: value for name, value in values.items() if name not in inside}
    return arguments | {name: tuple(values[part] for part in names) for name, names in parts.items()}


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
