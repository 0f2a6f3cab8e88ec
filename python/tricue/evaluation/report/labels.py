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

    @property
    def size(self) -> float:
        return (self.right - self.left) * (self.high - self.low)

    def shared(self, other: "_Area") -> float:
        """Size of the part that both have."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.high, other.high) - max(self.low, other.low)
        return max(width, 0.0) * max(height, 0.0)


_AXES = _Area(0.0, 1.0, 0.0, 1.0)


def place(points: Sequence[tuple[float, float]], names: Sequence[str]) -> list[Label]:
    """A label for each point (x, y), shares of the axes: to its right or left, at the first free position.

    If none is free, the label is where the least of it is off the axes or, then, covers points and labels.
    """
    taken = [_Area(x - _POINT, x + _POINT, y - _POINT, y + _POINT) for x, y in points]

    def cost(label: Label, name: str) -> tuple[float, float]:
        area = _area(label, name)
        return area.size - area.shared(_AXES), sum(map(area.shared, taken))

    placed = []
    for (x, y), name in zip(points, names, strict=True):
        positions = [_label(x, y + step, side) for step in _STEPS for side in ("left", "right")]
        label = min(positions, key=lambda each: cost(each, name))
        taken.append(_area(label, name))
        placed.append(label)
    return placed


def _label(x: float, y: float, side: str) -> Label:
    return Label(x + 1.4 * _POINT * (1 if side == "left" else -1), y, side)


def _area(label: Label, name: str) -> _Area:
    width = sum(_CAPITAL if letter.isupper() else _LETTER for letter in name)
    left = label.x if label.side == "left" else label.x - width
    return _Area(left, left + width, label.y - _LINE / 2, label.y + _LINE / 2)
