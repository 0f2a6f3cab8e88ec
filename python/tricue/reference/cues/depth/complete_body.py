# SPDX-License-Identifier: MIT
"""A body from segmented objects: its pieces are joined, and it is completed beyond the sides that are cut."""

import math
from typing import NamedTuple

import numpy as np

from tricue.reference.base.arrays import Flags, Floats
from tricue.reference.base.checks import refuse
from tricue.reference.cues.depth.detail.object_features import (
    ExpectedBody,
    Objects,
    complete_rectangle,
    require_expected,
    require_objects,
)


def complete_body(
    objects: Objects,
    index: int,
    expected: ExpectedBody,
    limits: tuple[float, float, float, float],
) -> tuple[Floats, Flags, Floats, Floats]:
    """Joins one piece after the other, then completes the joined body."""
    require_objects(objects)
    measured, cut, columns, rows = objects
    if not 0 <= index < len(measured):
        refuse("index", f"a number in [0, {len(measured)})", index)
    lengths = measured[:, [2, 3, 4, 7]]
    if not (lengths > 0).all():
        refuse("measured", "depths, sizes and areas above 0", float(lengths[~(lengths > 0)][0]))
    require_expected(expected)
    if np.isnan(limits).any():
        refuse("limits", "numbers", math.nan)
    (expected_state, size, known), (region, inside, joined_size, depth) = expected, limits
    z = measured[index, 2]
    body, own = _combine(measured, cut, [index], z), [index]
    for i, piece in enumerate(measured):
        if i == index or not abs(piece[2] - z) < depth:
            continue
        if not _share_inside(piece, expected_state, region) > inside:
            continue
        joined = _combine(measured, cut, [*own, i], z)
        fits = (joined.state[3:] <= joined_size * np.maximum(size, body.state[3:])).all()
        if fits and _misfit(joined, size) < _misfit(body, size):
            body, own = joined, [*own, i]
    grown = np.where(known, size, np.maximum(size, measured[index, 3:5]))
    state = complete_rectangle(body.state, body.cut, expected_state, grown)
    whole = ~(body.cut[::2] | body.cut[1::2])
    return state, whole, grown, np.concatenate([columns[index], rows[index], body.shift], dtype=np.float64)


class _Joined(NamedTuple):
    """State (5,), cut sides (4,), and centroid minus center (2,), of one or several objects."""

    state: Floats
    cut: Flags
    shift: Floats


def _combine(measured: Floats, cut: Flags, pieces: list[int], z: float) -> _Joined:
    """The box around all pieces as the camera sees them, at depth z."""
    each = measured[pieces]
    if len(pieces) == 1:
        return _Joined(each[0, :5], cut[pieces[0]], each[0, 5:7])
    at_depth = each[:, [0, 1, 3, 4]] * (z / each[:, 2:3])
    centers, extents = at_depth[:, :2], at_depth[:, 2:]
    first, last = (centers - extents / 2).min(axis=0), (centers + extents / 2).max(axis=0)
    middle = (first + last) / 2
    shares = each[:, 7:] / each[:, 7].sum()
    shift = (shares * (each[:, :2] + each[:, 5:7])).sum(axis=0) - middle
    sides = np.logical_or.reduce(cut[pieces])
    return _Joined(np.array([*middle, z, *(last - first)]), sides, shift)


def _share_inside(piece: Floats, expected: Floats, region: float) -> float:
    """The share of a rectangle's area in the region around the expected one."""
    low = np.maximum(piece[:2] - piece[3:5] / 2, expected[:2] - region * expected[3:] / 2)
    high = np.minimum(piece[:2] + piece[3:5] / 2, expected[:2] + region * expected[3:] / 2)
    return float(np.prod(np.maximum(high - low, 0) / piece[3:5]))


def _misfit(body: _Joined, size: Floats) -> float:
    """How far a body's size is from the mean size."""
    return float(np.square(np.log(body.state[3:] / size)).sum())
