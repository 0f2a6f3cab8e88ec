# SPDX-License-Identifier: MIT
"""Positions of the names beside the points of a plot, without overlaps."""

from collections.abc import Sequence
from typing import NamedTuple

# Shares of the axes' width or height; letters are as wide as in the widest common fonts.
_LETTER, _CAPITAL, _LINE, _POINT = 0.020, 0.026, 0.062, 0.028
_STEPS = (0.0, 0.03, -0.03, 0.06, -0.06, 0.09, -0.09, 0.12, -0.12)  # up or down from the point


class Label(NamedTuple):
    """(x, y): its end beside the point, as shares of the axes from the lower left. side: which end."""

    x: float
    y: float
    side: str


class _Area(NamedTuple):
    left: float
    right: float
    low: float
    high: float

    def overlaps(self, other: "_Area") -> bool:
        return min(self.right, other.right) > max(self.left, other.left) and min(self.high, other.high) > max(
            self.low, other.low
        )


def place(points: Sequence[tuple[float, float]], names: Sequence[str]) -> list[Label]:
    """A label for each point (x, y), shares of the axes: to its right or left, at the first free position.

    If none is free, the label is at the point's height.
    """
    taken = [_Area(x - _POINT, x + _POINT, y - _POINT, y + _POINT) for x, y in points]
    placed = []
    for (x, y), name in zip(points, names, strict=True):
        positions = [_label(x, y + step, side) for step in _STEPS for side in ("left", "right")]
        free = [
            each
            for each in positions
            if _fits(area := _area(each, name)) and not any(map(area.overlaps, taken))
        ]
        label = (free or [positions[0] if x < 0.7 else positions[1]])[0]
        taken.append(_area(label, name))
        placed.append(label)
    return placed


def _label(x: float, y: float, side: str) -> Label:
    return Label(x + 1.4 * _POINT * (1 if side == "left" else -1), y, side)


def _area(label: Label, name: str) -> _Area:
    width = sum(_CAPITAL if letter.isupper() else _LETTER for letter in name)
    left = label.x if label.side == "left" else label.x - width
    return _Area(left, left + width, label.y - _LINE / 2, label.y + _LINE / 2)


def _fits(area: _Area) -> bool:
    return area.left >= 0 and area.right <= 1 and area.low >= 0 and area.high <= 1
