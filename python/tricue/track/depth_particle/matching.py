# SPDX-License-Identifier: MIT
"""Which of the segmented objects is the target: by where it must be, its size, and its signature."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.body import completed
from tricue.track.depth_particle.signature import Signature
from tricue.track.depth_particle.walk import Walk

Floats = NDArray[np.float64]

NEAR = np.array([0.15, 0.35, 0.15])  # metres: standard deviation of X, Y, Z in no time,
PER_SECOND = np.array([0.45, 0.2, 0.45])  # and with time
SIZE = 0.2  # of the size, plus
SIZE_AT_LEAST = 0.05  # metres
LARGER = 0.3  # of its weight has a size that is more than what was ever seen of it
UNLIKE = 3.0  # nats of the most different signature
MIN_AREA, MIN_AREA_MISSED = 0.25, 0.45  # of the target's area has to be seen, and of one that was missed
MAX_COST, MAX_COST_MISSED = 8.0, 2.0  # nats up to which an object is the target, and one that was missed
BODY = 0.5  # metres round the middle of a body
FLAT = np.array([1.0, 0.3, 1.0])  # heights say less: they change with what is cut
REACHED = 0.3  # metres


class Found(NamedTuple):
    """An object that is the target: its state (5,), completed where it is cut, which of width and height are
    seen whole, and its signature.
    """

    state: Floats
    whole: NDArray[np.bool_]
    signature: Signature


def best_match(
    objects: Objects, expected: Floats, walk: Walk, signature: Signature, seconds: float, worst: float
) -> int | None:
    """The index of the object nearest to the expected state (5,) in position, size and signature, if any.

    The objects count as completed where something cuts them. Of the few that are near enough only one is
    mostly left: so they are looked at one by one.
    """
    deviation = (NEAR + PER_SECOND * seconds).tolist() + (SIZE * walk.size + SIZE_AT_LEAST).tolist()
    known, size, place = walk.known.tolist(), walk.size.tolist(), expected.tolist()
    enough = (MIN_AREA if worst >= MAX_COST else MIN_AREA_MISSED) * size[0] * size[1]
    best, least = None, worst
    for i, (state, cut) in enumerate(zip(objects.states.tolist(), objects.cut.tolist(), strict=True)):
        far = abs(state[2] - place[2]) / deviation[2]
        if far * far / 2 >= least or state[3] * state[4] < enough:
            continue
        cost = _cost(completed(state, cut, place, size), place, deviation, known)
        if not any(cut):
            cost += UNLIKE * signature.distance(objects, i)
        if cost < least:
            best, least = i, cost
    return best


def _cost(state: list[float], expected: list[float], deviation: list[float], known: list[bool]) -> float:
    """Half the squared distance, in nats. A size that was never seen whole is a lower bound, and its middle
    not known.
    """
    off = [(s - e) / d for s, e, d in zip(state, expected, deviation, strict=True)]
    for axis in range(2):
        if not known[axis]:
            off[axis] *= 0.5
            off[3 + axis] *= LARGER if off[3 + axis] > 0 else 1.0
    return sum(each * each for each in off) / 2


def without(objects: Objects, place: Floats) -> Objects:
    """The objects but for those at a place (3,), metres: what stands there, and its pieces."""
    away = np.linalg.norm(objects.states[:, [0, 2]] - place[[0, 2]], axis=1)
    return Objects(*(each[away > BODY] for each in objects))


def cover(objects: Objects, expected: Floats, nearer: float) -> int | None:
    """The index of what covers most of the expected rectangle, state (5,), from in front, if anything."""
    if len(objects.states) == 0:
        return None
    near = objects.states[:, 2] < expected[2] - nearer
    # Seen from the camera: at the distance 1.
    centers, halves = (
        objects.states[:, each] / objects.states[:, 2:3] for each in (slice(0, 2), slice(3, 5))
    )
    center, half = expected[:2] / expected[2], expected[3:] / expected[2]
    low = np.maximum(centers - halves / 2, center - half / 2)
    high = np.minimum(centers + halves / 2, center + half / 2)
    covered = np.prod(np.maximum(high - low, 0), axis=1) * near
    best = int(np.argmax(covered))
    return best if covered[best] > 0 else None


def same(objects: Objects, place: Floats, fastest: float, seconds: float) -> int | None:
    """The index of the object nearest to where something was, (3,) metres, as far as it can have gone."""
    if len(objects.states) == 0:
        return None
    away = np.linalg.norm((objects.states[:, :3] - place) * FLAT, axis=1)
    best = int(np.argmin(away))
    return best if away[best] < REACHED + fastest * seconds else None
