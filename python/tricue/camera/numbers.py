# SPDX-License-Identifier: MIT
"""Checks of numbers: each returns the number, or raises TypeError or ValueError that names the argument."""

import math
import warnings
from numbers import Integral, Real
from typing import Any

MAX_ANGLE = 2 * math.pi  # radians, of a pan-tilt head; only those that turn several times have larger ones


def finite(value: Any, name: str, unit: str) -> float:
    """A number that is neither NaN nor infinite."""
    if not isinstance(value, Real) or isinstance(value, bool):
        raise TypeError(f"{name}: expected a number, {unit}, got {value!r:.80}")
    number = to_float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name}: expected a finite number, {unit}, got {value!r:.80}")
    return number


def to_float(value: Any) -> float:
    """A real number as a float; infinity if it is too large for one."""
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def positive(value: Any, name: str, unit: str) -> float:
    """A finite number above 0."""
    number = finite(value, name, unit)
    if not number > 0:
        raise ValueError(f"{name}: expected {unit} above 0, got {value!r:.80}")
    return number


def positive_whole(value: Any, name: str, unit: str) -> int:
    """A whole number above 0."""
    if not isinstance(value, Integral) or isinstance(value, bool):
        raise TypeError(f"{name}: expected a whole number, {unit}, got {value!r:.80}")
    return int(positive(value, name, unit))


def warn_of_degrees(value: float, name: str, unit: str) -> None:
    """Warn, at the line that calls the caller, of a number so large that it looks like degrees."""
    about = float(f"{value:.1g}")  # the same in most frames, as Python shows each text of a line only once
    got = f"about {about:g}, which looks like degrees; math.radians converts it"
    warnings.warn(f"{name}: expected {unit}, got {got}", UserWarning, stacklevel=3)


def pinhole(
    fx: Any, fy: Any, cx: Any, cy: Any, width: Any, height: Any
) -> tuple[float, float, float, float, int, int]:
    """The parameters of a pinhole camera, all in pixels: focal lengths and image size above 0."""
    return (
        positive(fx, "fx", "pixels"),
        positive(fy, "fy", "pixels"),
        finite(cx, "cx", "pixels"),
        finite(cy, "cy", "pixels"),
        positive_whole(width, "width", "pixels"),
        positive_whole(height, "height", "pixels"),
    )
