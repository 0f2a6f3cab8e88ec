# SPDX-License-Identifier: MIT
"""A body from what is segmented of it: its pieces joined, and completed where something cuts it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.signature import Signature

Floats = NDArray[np.float64]

ROOM = 1.3  # times the expected rectangle, in which its pieces are looked for
INSIDE = 0.8  # of a piece
PIECE = 0.4  # metres, that arms and legs reach to the front or back


class Body(NamedTuple):
    """State (5,) X, Y, Z, width, height, metres; whether it may go on at its left, right, top, bottom."""

    state: Floats
    cut: NDArray[np.bool_]
    signature: Signature

    @classmethod
    def of(cls, objects: Objects, index: int) -> "Body":
        """One object."""
        return cls(objects.states[index], objects.cut[index], Signature.of(objects, index))

    @property
    def whole(self) -> NDArray[np.bool_]:
        """(2,) whether the width and the height are seen whole."""
        return ~(self.cut[::2] | self.cut[1::2])

    def completed(self, expected: Floats, size: Floats) -> Floats:
        """The state as if nothing cut it; see :func:`completed`."""
        return np.array(completed(self.state.tolist(), self.cut.tolist(), expected.tolist(), size.tolist()))


def completed(state: list[float], cut: list[bool], expected: list[float], size: list[float]) -> list[float]:
    """A state of five numbers as if nothing cut it: of the usual ``size``, ending where it is free."""
    x, y, z, width, height = state
    x, width = _extended(x, width, cut[0], cut[1], expected[0], size[0])
    y, height = _extended(y, height, cut[2], cut[3], expected[1], size[1])
    return [x, y, z, width, height]


def _extended(
    middle: float, extent: float, before: bool, after: bool, expected: float, size: float
) -> tuple[float, float]:
    """An interval of the usual size, as near to the expected middle as what is seen of it allows."""
    half = (size - extent) / 2
    if half <= 0 or not (before or after):
        return middle, extent
    if before and after:
        return min(max(expected, middle - half), middle + half), size
    return (middle - half if before else middle + half), size


def joined(objects: Objects, index: int, expected: Floats) -> Body:
    """An object with its pieces: arms and legs that gaps cut off.

    A piece lies for the most part in the expected rectangle, state (5,), and not far from the object's depth.
    """
    body = Body.of(objects, index)
    pieces = _pieces(objects.states.tolist(), index, expected.tolist())
    return body if len(pieces) == 1 else _union(body, objects, pieces)


def _pieces(states: list[list[float]], index: int, expected: list[float]) -> list[int]:
    own = states[index][2]
    return [
        i
        for i, state in enumerate(states)
        if i == index or (abs(state[2] - own) < PIECE and _share_inside(state, expected) > INSIDE)
    ]


def _share_inside(state: list[float], expected: list[float]) -> float:
    """The share of a rectangle that is in the room round the expected one."""
    share = 1.0
    for middle, extent, at, size in zip(state[:2], state[3:], expected[:2], expected[3:], strict=True):
        low = max(middle - extent / 2, at - ROOM * size / 2)
        high = min(middle + extent / 2, at + ROOM * size / 2)
        share *= max(high - low, 0.0) / extent
    return share


def _union(body: Body, objects: Objects, pieces: list[int]) -> Body:
    """Box and centroid are those of all the pieces; depth and distributions stay the object's own."""
    states, areas = objects.states[pieces], objects.area[pieces]
    seen = states[:, [0, 1, 3, 4]] * (body.state[2] / states[:, 2:3])  # as if all were at its depth
    first, last = (seen[:, :2] - seen[:, 2:] / 2).min(axis=0), (seen[:, :2] + seen[:, 2:] / 2).max(axis=0)
    middle = (first + last) / 2
    centroids = states[:, :2] + objects.shift[pieces]
    shift = areas / areas.sum() @ centroids - middle
    return Body(
        np.concatenate([middle, body.state[2:3], last - first]),
        np.logical_or.reduce(objects.cut[pieces]),
        body.signature._replace(shift=shift),
    )
