# SPDX-License-Identifier: MIT
"""Which segmented object is the target (Sabeti, Parvizi, Wu 2008, section IV.A)."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.cues.depth.detail.object_features import (
    ExpectedBody,
    Objects,
    complete_rectangle,
    require_expected,
    require_objects,
)

Deviation = tuple[float, float, float, float, float]
Costs = tuple[Deviation, tuple[float, float], float, float, float]


def match_object(
    objects: Objects, others: Floats, expected: ExpectedBody, signature: Floats, costs: Costs, complete: bool
) -> int:
    """Computes the cost of every object, and returns the index of the lowest."""
    require_objects(objects)
    require_expected(expected)
    _require(objects, others, signature, costs)
    measured, cut, columns, rows = objects
    expected_state, size, known = expected
    (*place, share, base), unknown, signature_cost, max_cost, min_area = costs
    scale = np.array([*place, *(share * size + base)])
    best, least = -1, max_cost
    for i, state in enumerate(measured[:, :5]):
        if state[3] * state[4] < min_area:
            continue
        seen = complete_rectangle(state, cut[i], expected_state, size) if complete else state
        off = (seen - expected_state) / scale
        off[:2] *= np.where(known, 1, unknown[0])
        off[3:] *= np.where(known | (off[3:] <= 0), 1, unknown[1])
        cost = float(off @ off) / 2
        if not cut[i].any():
            distributions = np.concatenate([columns[i], rows[i]], dtype=np.float64)
            cost += signature_cost * float(np.abs(distributions - signature[:-2]).sum()) / 4
        if others.size:
            cost += float(others[i])
        if cost < least:
            best, least = i, cost
    return best


def _require(objects: Objects, others: Floats, signature: Floats, costs: Costs) -> None:
    measured, _, columns, _ = objects
    deviation, unknown, signature_cost, *_ = costs
    if others.size:
        require_shape("others", others, (len(measured),))
    require_shape("signature", signature, (2 * columns.shape[1] + 2,))
    for name, number in zip(("x", "y", "z"), deviation, strict=False):
        if not 0 < number < np.inf:
            refuse(name, "a finite number above 0", number)
    for name, number in zip(("share", "base"), deviation[3:], strict=True):
        if not 0 <= number < np.inf:
            refuse(name, "a finite number, not negative", number)
    if not deviation[3] + deviation[4] > 0:
        refuse("base", "a number above 0 where share is 0", deviation[4])
    for name, number in zip(("center", "larger", "signature_cost"), (*unknown, signature_cost), strict=True):
        if not np.isfinite(number):
            refuse(name, "a finite number", number)
