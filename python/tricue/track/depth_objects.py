# SPDX-License-Identifier: MIT
"""Objects in depth, section IV.A: divisions of the range, (32)-(36), and their connected components."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.depth_params import DepthParticleParams
from tricue.track.foreground import Foreground

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

SLICES = 16  # of an object's width and height, in its horizontal and vertical distribution
EDGE = 2  # pixels from the border within which an object may go on outside
FEET = 0.35  # metres over the floor, from which somebody still stands on it
LEGS = 0.7  # as wide as a body's box on average
ROOM = 1.3  # times the expected rectangle, in which its pieces are looked for
INSIDE = 0.8  # of a piece
PIECE = 0.4  # metres, that arms and legs reach to the front or back
BESIDE = 0.08  # metres from an object, where something nearer may cover more of it,
COVERED = 0.15  # on so much of a side
ALONG = (np.arange(12) + 0.5) / 6 - 1
SIDES = tuple(
    np.stack(np.broadcast_arrays(u, v), axis=1)
    for u, v in ((-1.0, ALONG), (1.0, ALONG), (ALONG, -1.0), (ALONG, 1.0))
)
NOTHING = np.zeros(1)
CENTERS = (np.arange(SLICES) + 0.5) / SLICES - 0.5


class Objects(NamedTuple):
    """C objects, largest first; with their signatures, horizontal and vertical distribution.

    states: (C, 5) X, Y, Z of the box's centre, width and height, metres; Z is the mean depth.
    rectangles: (C, 4) left, top, width, height in the frame's pixels.
    cut: (C, 4) whether it may go on at its left, right, top, bottom: at the image's border, or behind
        something nearer.
    shift: (C, 2) from the box's centre to the centroid, metres.
    columns, rows: (C, SLICES) each of sum 1. area: (C,) square metres.
    """

    states: Floats
    rectangles: Floats
    cut: NDArray[np.bool_]
    shift: Floats
    columns: Singles
    rows: Singles
    area: Floats

    @property
    def whole(self) -> NDArray[np.bool_]:
        """(C, 2) whether the width and the height are seen whole."""
        return ~(self.cut[:, ::2] | self.cut[:, 1::2])

    @property
    def boxes(self) -> list[Box]:
        return [Box(*rectangle) for rectangle in self.rectangles.tolist()]


def segment(k: Kernels, fg: Foreground, plane: Floats, p: DepthParticleParams) -> Objects:
    """Divide the range at the minima of the depth's density, and each division into connected objects."""
    depth = fg.depth
    mask = np.isfinite(depth).view(np.uint8)
    if p.edges:
        mask &= k.depth_edges(depth, p.edge_gap, p.edge_slope) ^ 1
    counts = k.depth_histogram(depth, mask, p.near, p.far, p.levels)
    level = (p.far - p.near) / p.levels
    density = k.depth_density(counts, p.bandwidth / level)
    _, minima = k.density_extrema(density, p.prominence * float(density.max()))
    dividers = np.concatenate([[p.near], p.near + (minima[:254] + 0.5) * level, [p.far]])
    labels = k.divide_depth(depth, mask, dividers)
    least = p.least_area * fg.camera[0] * fg.camera[1] / p.far**2
    area = int(min(max(8.0, least), depth.size + 1.0))
    table, _, columns, rows, _ = k.depth_components(labels, depth, p.near, p.far, 1, SLICES, area)
    cut = _at_border(table, depth.shape) | _behind(k, fg, table, p)
    return _standing(_described(table, cut, columns, rows, fg), plane, fg)


def _at_border(table: Floats, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    x, y, w, h = table.T[:4]
    return np.stack([x < EDGE, x + w > shape[1] - EDGE, y < EDGE, y + h > shape[0] - EDGE], axis=1)


def _behind(k: Kernels, fg: Foreground, table: Floats, p: DepthParticleParams) -> NDArray[np.bool_]:
    """(C, 4) whether there is something nearer right beside it."""
    x, y, w, h, _, z, _ = table.T
    fx, fy = fg.camera[:2]
    more_x, more_y = 2 * BESIDE * fx / z, 2 * BESIDE * fy / z
    larger = np.stack([x + w / 2, y + h / 2, w + more_x, h + more_y, z], axis=1)
    nearer = [k.depth_distance(fg.depth, larger, NOTHING, side, p.reach, p.nearer)[:, 2] for side in SIDES]
    return np.stack(nearer, axis=1) > COVERED


def _described(
    table: Floats, cut: NDArray[np.bool_], columns: Singles, rows: Singles, fg: Foreground
) -> Objects:
    """The table's boxes in pixels of the frame, and in metres."""
    fx, fy, cx, cy = fg.camera
    x, y, w, h, pixels, z, _ = table.T
    per_x, per_y = z / fx, z / fy
    area = pixels * per_x * per_y
    states = ((x + w / 2 - 0.5 - cx) * per_x, (y + h / 2 - 0.5 - cy) * per_y, z, w * per_x, h * per_y)
    shift = ((columns @ CENTERS) * w * per_x, (rows @ CENTERS) * h * per_y)
    rectangles = table[:, :4] * fg.step
    rectangles[:, :2] -= (fg.step - 1) / 2  # a thinned pixel is in the middle of what it stands for
    return Objects(np.stack(states, axis=1), rectangles, cut, np.stack(shift, axis=1), columns, rows, area)


def _standing(objects: Objects, plane: Floats, fg: Foreground) -> Objects:
    """Give those that end where the floor was taken out their feet back: down to the floor."""
    if not plane.any() or len(objects.states) == 0:
        return objects
    states, rectangles = objects.states.copy(), objects.rectangles.copy()
    feet = states[:, :3] + np.outer(states[:, 4] / 2, [0.0, 1.0, 0.0])
    above = (feet @ plane[:3] + plane[3]) / max(-plane[1], 0.1)
    added = np.where((above > 0) & (above < FEET) & ~objects.cut[:, 3], above, 0.0)
    states[:, 1] += added / 2
    states[:, 4] += added
    rectangles[:, 3] += added * fg.camera[1] * fg.step / states[:, 2]
    # The centroid, too, comes down by its share of the missing strip.
    missing = LEGS * added / states[:, 4]
    low = states[:, 4] / 2 - added / 2
    down = objects.shift[:, 1] - added / 2
    shift = np.stack([objects.shift[:, 0], down + missing * (low - down)], axis=1)
    return objects._replace(states=states, rectangles=rectangles, shift=shift)


def joined(objects: Objects, index: int, expected: Floats) -> Objects:
    """The objects with one of them replaced by its union with its pieces: arms and legs that gaps cut off.

    A piece lies for the most part in the expected rectangle, state (5,), and not far from the object's depth.
    """
    left, top = (objects.states[:, :2] - objects.states[:, 3:] / 2).T
    right, bottom = (objects.states[:, :2] + objects.states[:, 3:] / 2).T
    low, high = expected[:2] - ROOM * expected[3:] / 2, expected[:2] + ROOM * expected[3:] / 2
    wide = np.minimum(right, high[0]) - np.maximum(left, low[0])
    tall = np.minimum(bottom, high[1]) - np.maximum(top, low[1])
    share = np.maximum(wide, 0) * np.maximum(tall, 0) / (objects.states[:, 3] * objects.states[:, 4])
    near = np.abs(objects.states[:, 2] - objects.states[index, 2]) < PIECE
    pieces = near & (share > INSIDE)
    pieces[index] = True
    if pieces.sum() == 1:
        return objects
    return _with_union(objects, index, np.flatnonzero(pieces))


def _with_union(objects: Objects, index: int, pieces: NDArray[np.intp]) -> Objects:
    """Boxes and centroids are those of all the pieces; depth and distributions stay the object's own."""
    states, rectangles, cut = objects.states.copy(), objects.rectangles.copy(), objects.cut.copy()
    corners = rectangles[pieces]
    first, last = corners[:, :2].min(axis=0), (corners[:, :2] + corners[:, 2:]).max(axis=0)
    own = states[index].copy()
    per_pixel = own[3:] / rectangles[index, 2:]
    center = rectangles[index, :2] + rectangles[index, 2:] / 2
    states[index, :2] += ((first + last) / 2 - center) * per_pixel
    states[index, 3:] = (last - first) * per_pixel
    rectangles[index] = np.concatenate([first, last - first])
    cut[index] = cut[pieces].any(axis=0)
    shift, share = objects.shift.copy(), objects.area[pieces] / objects.area[pieces].sum()
    centroids = objects.states[pieces, :2] + objects.shift[pieces]
    shift[index] = share @ centroids - states[index, :2]
    return objects._replace(states=states, rectangles=rectangles, cut=cut, shift=shift)


def completed(objects: Objects, expected: Floats, size: Floats) -> Floats:
    """The states as if nothing cut the objects: of the usual ``size``, ending on the side that is free."""
    states: Floats = objects.states.copy()
    middle, extent = objects.states[:, :2], objects.states[:, 3:]
    before, after = objects.cut[:, ::2], objects.cut[:, 1::2]
    half = (extent - size) / 2
    shorter = (before | after) & (half < 0)
    if shorter.any():
        between = np.minimum(np.maximum(expected[:2], middle + half), middle - half)
        moved = np.where(before & after, between, middle + np.where(before, half, -half))
        states[:, :2] = np.where(shorter, moved, middle)
        states[:, 3:] = np.where(shorter, size, extent)
    return states
