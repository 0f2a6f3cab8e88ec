# SPDX-License-Identifier: MIT
"""Which of the segmented objects is the target: by its predicted position, its size and its signature."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.body import complete_rectangle
from tricue.track.depth_particle.motion import BodyMotion
from tricue.track.depth_particle.signature import Signature

Floats = NDArray[np.float64]

# Standard deviations of an object that is the target, from the predicted state.
POSITION_DEVIATION = (0.15, 0.35, 0.15)  # meters of X, Y, Z, plus
POSITION_DEVIATION_RATE = (0.45, 0.2, 0.45)  # meters per second since the target was seen
SIZE_DEVIATION_SHARE = 0.2  # of the size, plus
SIZE_DEVIATION = 0.05  # meters

UNKNOWN_CENTER_WEIGHT = 0.5  # of the position along an axis on which the size is only a lower bound
LARGER_SIZE_WEIGHT = 0.3  # of a size that exceeds such a lower bound
SIGNATURE_COST = 3.0  # nats, of the most different signature
MIN_AREA_SHARE, MIN_AREA_SHARE_MISSED = 0.25, 0.45  # of the target's area is visible; after it was missed
MAX_COST, MAX_COST_MISSED = 8.0, 2.0  # nats, of an object that is the target; after it was missed


class TargetObject(NamedTuple):
    """The object that is the target.

    state: (5,) completed where it is cut. whole: (2,) whether the whole width and the whole height are
    visible.
    """

    state: Floats
    whole: NDArray[np.bool_]
    signature: Signature


def best_match(
    objects: Objects,
    expected: Floats,
    motion: BodyMotion,
    signature: Signature,
    seconds: float,
    max_cost: float,
    *,
    complete: bool = True,
    other_costs: Sequence[float] | None = None,
) -> int | None:
    """The index of the object of the least cost against the expected state (5,), if any is below max_cost.

    The cost is in nats, of position, size and signature; ``other_costs``, of each object, come on top.
    complete: whether objects count as completed where they are cut. seconds: since the target was seen.
    """
    # Hardly more than one object is near enough: a loop over those is faster than arrays.
    known, size, target = motion.size_known.tolist(), motion.mean_size.tolist(), expected.tolist()
    deviation = [
        *[d + r * seconds for d, r in zip(POSITION_DEVIATION, POSITION_DEVIATION_RATE, strict=True)],
        *[SIZE_DEVIATION_SHARE * each + SIZE_DEVIATION for each in size],
    ]
    min_area = (MIN_AREA_SHARE if max_cost >= MAX_COST else MIN_AREA_SHARE_MISSED) * size[0] * size[1]
    best, best_cost = None, max_cost
    for i, (state, cut) in enumerate(zip(objects.states.tolist(), objects.cut.tolist(), strict=True)):
        z_off = abs(state[2] - target[2]) / deviation[2]
        if z_off * z_off / 2 >= best_cost or state[3] * state[4] < min_area:
            continue
        whole_state = complete_rectangle(state, cut, target, size) if complete else state
        cost = _cost(whole_state, target, deviation, known)
        if cost >= best_cost:
            continue
        if not any(cut):
            cost += SIGNATURE_COST * signature.distance(objects, i)
        if other_costs is not None:
            cost += other_costs[i]
        if cost < best_cost:
            best, best_cost = i, cost
    return best


def _cost(state: list[float], expected: list[float], deviation: list[float], known: list[bool]) -> float:
    """Half the squared Mahalanobis distance, nats.

    A size never visible as a whole is a lower bound, and the center along its axis is uncertain.
    """
    off = [(s - e) / d for s, e, d in zip(state, expected, deviation, strict=True)]
    for axis in range(2):
        if not known[axis]:
            off[axis] *= UNKNOWN_CENTER_WEIGHT
            off[3 + axis] *= LARGER_SIZE_WEIGHT if off[3 + axis] > 0 else 1.0
    return sum(each * each for each in off) / 2
