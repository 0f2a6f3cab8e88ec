# SPDX-License-Identifier: MIT
"""Segmented objects as rectangles in meters, which the image's border or an occluder may cut."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Flags, Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape

Shares = NDArray[np.float32]
Objects = tuple[Floats, Flags, Shares, Shares]
ExpectedBody = tuple[Floats, Floats, Flags]


def complete_rectangle(state: Floats, cut: Flags, expected: Floats, size: Floats) -> Floats:
    """A state (5,) extended to ``size`` (2,) beyond the sides (4,) that are cut.

    If opposite sides are cut, it is centered as near to the expected state as its visible part allows.
    """
    whole: Floats = state.copy()
    for axis in range(2):
        before, after = cut[2 * axis : 2 * axis + 2]
        half = (size[axis] - state[3 + axis]) / 2
        if half <= 0 or not (before or after):
            continue
        low, high = state[axis] - half, state[axis] + half
        if before and after:
            whole[axis] = np.clip(expected[axis], low, high)
        else:
            whole[axis] = low if before else high
        whole[3 + axis] = size[axis]
    return whole


def require_objects(objects: Objects) -> None:
    """Refuse arrays of other shapes, or with numbers that aren't finite."""
    measured, cut, columns, rows = objects
    count = len(measured)
    require_shape("measured", measured, (count, 8))
    require_finite("measured", measured)
    for name, values in (("cut", cut), ("columns", columns), ("rows", rows)):
        if len(values) != count:
            refuse(name, f"{count} rows", len(values))
    if rows.shape[1] != columns.shape[1]:
        refuse("rows", f"{columns.shape[1]} bins", rows.shape[1])


def require_expected(expected: ExpectedBody) -> None:
    """Refuse an expected state (5,) that isn't finite, and a size (2,) that isn't above 0."""
    state, size, _ = expected
    require_shape("state", state, (5,))
    require_finite("state", state)
    require_shape("size", size, (2,))
    require_finite("size", size)
    if not size.min() > 0:
        refuse("size", "numbers above 0", float(size.min()))
