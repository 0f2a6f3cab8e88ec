# SPDX-License-Identifier: MIT
"""The part of a depth image in which a target can be, the support of the floor, and the measured region."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.base.checks import refuse
from tricue.reference.cues.depth.above_floor import above_floor
from tricue.reference.cues.depth.fill_gaps import fill_gaps
from tricue.reference.cues.depth.plane_support import plane_support


def find_foreground(
    depth: Depth,
    step: int,
    gaps: tuple[float, float, float, int],
    camera: Floats,
    plane: Floats,
    floor: tuple[float, int],
    space: tuple[float, float, float],
    margin: float,
) -> tuple[Depth, Floats, tuple[int, int, int, int]]:
    """Calls one twin after the other."""
    if step < 1:
        refuse("step", "at least 1", step)
    if not 0 <= margin <= 1:
        refuse("margin", "a number in [0, 1]", float(margin))
    filled = fill_gaps(np.ascontiguousarray(depth[::step, ::step]), *gaps)
    known = np.isfinite(filled)
    (top, bottom), (left, right) = (
        _measured_span(np.asarray(known.any(axis=axis)), margin) for axis in (1, 0)
    )
    kept = above_floor(filled, camera, plane, *space)
    return kept, plane_support(filled, camera, plane, *floor), (left, top, right, bottom)


def _measured_span(known: NDArray[np.bool_], share: float) -> tuple[int, int]:
    """The start and end of the measured part along a side; the side's own end if that is farther than a share
    of its length.
    """
    length, where = len(known), np.flatnonzero(known)
    if where.size == 0:
        return 0, length
    first, end = int(where[0]), int(where[-1]) + 1
    margin = share * length
    return first if first <= margin else 0, end if length - end <= margin else length
