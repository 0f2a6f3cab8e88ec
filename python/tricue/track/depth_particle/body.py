# SPDX-License-Identifier: MIT
"""A body from segmented objects: its pieces are joined, and it is completed where it is cut."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.signature import Signature

Floats = NDArray[np.float64]

PIECE_REGION = 1.3  # times the expected rectangle, in which pieces of the body are looked for
MIN_PIECE_INSIDE = 0.8  # of a piece's area, in that region
MAX_JOINED_SIZE = 1.15  # times the usual size, of a body with its pieces
MAX_PIECE_DEPTH = 0.4  # meters, from the body's depth to that of a stretched arm or leg


class Body(NamedTuple):
    """State (5,) X, Y, Z, width, height, meters; cut (4,) as in :class:`Objects`; and signature."""

    state: Floats
    cut: NDArray[np.bool_]
    signature: Signature

    @classmethod
    def from_object(cls, objects: Objects, index: int) -> "Body":
        """A body of one piece."""
        return cls(objects.states[index], objects.cut[index], Signature.from_object(objects, index))

    @property
    def whole(self) -> NDArray[np.bool_]:
        """(2,) whether the whole width and the whole height are visible."""
        left, right, top, bottom = self.cut.tolist()
        return np.array((not (left or right), not (top or bottom)))

    def complete(self, expected: Floats, size: Floats) -> Floats:
        """The state as if nothing cut it; see :func:`complete_rectangle`."""
        return np.array(
            complete_rectangle(self.state.tolist(), self.cut.tolist(), expected.tolist(), size.tolist())
        )


def complete_rectangle(
    state: list[float], cut: list[bool], expected: list[float], size: list[float]
) -> list[float]:
    """A state of five numbers as if nothing cut it: extended to ``size`` beyond the sides that are cut.

    Cut at opposite sides, it is as near to the middle of the expected state as its visible part allows.
    """
    x, y, z, width, height = state
    x, width = _extend(x, width, cut[0], cut[1], expected[0], size[0])
    y, height = _extend(y, height, cut[2], cut[3], expected[1], size[1])
    return [x, y, z, width, height]


def _extend(
    middle: float, extent: float, cut_before: bool, cut_after: bool, expected: float, size: float
) -> tuple[float, float]:
    """Middle and extent of an interval, extended to ``size`` beyond the ends that are cut."""
    half = (size - extent) / 2
    if half <= 0 or not (cut_before or cut_after):
        return middle, extent
    if cut_before and cut_after:
        return min(max(expected, middle - half), middle + half), size
    return (middle - half if cut_before else middle + half), size


def join_pieces(objects: Objects, index: int, expected: Floats, size: Floats) -> Body:
    """An object with the pieces of its body, such as arms and legs, that gaps separate from it.

    A piece lies for the most part in the region of the expected rectangle, state (5,), near the object's
    depth, and with it the body is more nearly of the usual size (2,), and hardly larger.
    """
    body, own = Body.from_object(objects, index), [index]
    for piece in _find_pieces(objects.states.tolist(), index, expected.tolist()):
        joined = _unite(body, objects, [*own, piece])
        limit = MAX_JOINED_SIZE * np.maximum(size, body.state[3:])
        fits = bool((joined.state[3:] <= limit).all())
        if fits and _misfit(joined, size) < _misfit(body, size):
            body, own = joined, [*own, piece]
    return body


def _misfit(body: Body, size: Floats) -> float:
    """How far a body is from the size (2,): the sum of its squared logarithmic ratios."""
    return float(np.square(np.log(body.state[3:] / size)).sum())


def _find_pieces(states: list[list[float]], index: int, expected: list[float]) -> list[int]:
    depth = states[index][2]
    return [
        i
        for i, state in enumerate(states)
        if i != index
        and abs(state[2] - depth) < MAX_PIECE_DEPTH
        and _share_inside(state, expected) > MIN_PIECE_INSIDE
    ]


def _share_inside(state: list[float], expected: list[float]) -> float:
    """The share of a rectangle's area in the region of the expected one."""
    share = 1.0
    for middle, extent, center, size in zip(state[:2], state[3:], expected[:2], expected[3:], strict=True):
        low = max(middle - extent / 2, center - PIECE_REGION * size / 2)
        high = min(middle + extent / 2, center + PIECE_REGION * size / 2)
        share *= max(high - low, 0.0) / extent
    return share


def _unite(body: Body, objects: Objects, pieces: list[int]) -> Body:
    """Box and centroid are those of all pieces; depth and distributions stay the object's own."""
    states, areas = objects.states[pieces], objects.area[pieces]
    at_depth = states[:, [0, 1, 3, 4]] * (body.state[2] / states[:, 2:3])  # as if all were at its depth
    centers, extents = at_depth[:, :2], at_depth[:, 2:]
    first, last = (centers - extents / 2).min(axis=0), (centers + extents / 2).max(axis=0)
    middle = (first + last) / 2
    centroids = states[:, :2] + objects.centroid_offset[pieces]
    offset = areas / areas.sum() @ centroids - middle
    return Body(
        np.concatenate([middle, body.state[2:3], last - first]),
        np.logical_or.reduce(objects.cut[pieces]),
        body.signature.with_centroid(offset),
    )
