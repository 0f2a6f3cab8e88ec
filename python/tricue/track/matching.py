# SPDX-License-Identifier: MIT
"""Which of the segmented objects is the target: by where it must be, its size, and its signature."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.depth_objects import SLICES, Objects
from tricue.track.walk import Walk

Floats = NDArray[np.float64]

NEAR = np.array([0.15, 0.35, 0.15])  # metres: standard deviation of X, Y, Z in no time,
PER_SECOND = np.array([0.45, 0.2, 0.45])  # and with time
SIZE = 0.2  # of the size, plus
SIZE_AT_LEAST = 0.05  # metres
LARGER = 0.3  # of its weight has a size that is more than what was ever seen of it
UNLIKE = 3.0  # nats of the most different signature
ENOUGH, ENOUGH_AGAIN = 0.25, 0.45  # of the target's area has to be seen, and of one that was missed
WORST, WORST_AGAIN = 8.0, 2.0  # nats up to which an object is the target, and one that was missed
BODY = 0.5  # metres round the middle of a body
FLAT = np.array([1.0, 0.3, 1.0])  # heights say less: they change with what is cut
REACHED = 0.3  # metres
RATE = 0.1  # per frame, of the signature


class Signature(NamedTuple):
    """How a target is spread over its box: (SLICES,) each of columns and rows, and (2,) metres from the box's
    centre to the centroid.
    """

    columns: Floats
    rows: Floats
    shift: Floats

    @classmethod
    def unknown(cls) -> "Signature":
        """Even."""
        return cls(np.full(SLICES, 1 / SLICES), np.full(SLICES, 1 / SLICES), np.zeros(2))

    @classmethod
    def of(cls, objects: Objects, index: int) -> "Signature":
        """An object's."""
        columns, rows = (each[index].astype(np.float64) for each in (objects.columns, objects.rows))
        return cls(columns, rows, objects.shift[index])

    def distances(self, objects: Objects) -> Floats:
        """(C,) in [0, 1]: how differently objects are spread over their boxes."""
        columns = np.abs(objects.columns - self.columns).sum(axis=1)
        rows = np.abs(objects.rows - self.rows).sum(axis=1)
        distances: Floats = (columns + rows) / 4
        return distances

    def learnt(self, new: "Signature") -> "Signature":
        """With another one blended in."""
        return Signature(*(old + RATE * (each - old) for old, each in zip(self, new, strict=True)))


class Found(NamedTuple):
    """An object that is the target: its state (5,), completed where it is cut, which of width and height are
    seen whole, and its signature.
    """

    state: Floats
    whole: NDArray[np.bool_]
    signature: Signature


def best_match(
    states: Floats,
    objects: Objects,
    expected: Floats,
    walk: Walk,
    signature: Signature,
    seconds: float,
    worst: float,
) -> int | None:
    """The index of the object nearest to the expected state (5,) in position, size and signature, if any.

    states: (C, 5), the objects' own, completed where something cuts them.
    """
    if len(states) == 0:
        return None
    deviation = np.concatenate([NEAR + PER_SECOND * seconds, SIZE * walk.size + SIZE_AT_LEAST])
    off = (states - expected) / deviation
    # A size that was never seen whole is a lower bound, and its middle not known.
    off[:, :2][:, ~walk.known] *= 0.5
    larger = off[:, 3:] > 0
    off[:, 3:] *= np.where(larger & ~walk.known, LARGER, 1.0)
    cost = 0.5 * (off * off).sum(axis=1)
    cost += np.where(objects.whole.all(axis=1), UNLIKE * signature.distances(objects), 0.0)
    enough = ENOUGH if worst >= WORST else ENOUGH_AGAIN
    cost[objects.states[:, 3:].prod(axis=1) < enough * walk.size.prod()] = np.inf
    best = int(np.argmin(cost))
    return best if cost[best] < worst else None


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
