# SPDX-License-Identifier: MIT
"""The sides of its box beyond which a segmented object may extend."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse
from tricue.reference.base.depth_pixels import has_depth, require_camera, require_table

Cut = tuple[int, float, float, float]  # border, beside, occluder_margin, share

PLACES = 12  # read beside each side
ALONG = (2 * np.arange(PLACES) + 1) / PLACES - 1


def cut_sides(
    depth: NDArray[np.float32],
    table: Floats,
    camera: Floats,
    cut: Cut,
) -> NDArray[np.bool_]:
    """Reads the places beside each side of one box at a time."""
    _require(table, camera, cut)
    border, beside, occluder_margin, share = cut
    height, width = depth.shape
    sides = np.zeros((len(table), 4), np.bool_)
    for i, (x, y, w, h, _, z, _) in enumerate(table):
        at_border = x < border, x + w > width - border, y < border, y + h > height - border
        half_width, half_height = w / 2 + beside * camera[0] / z, h / 2 + beside * camera[1] / z
        across, down = x + w / 2 + ALONG * half_width, y + h / 2 + ALONG * half_height
        left, right = x + w / 2 - half_width, x + w / 2 + half_width
        top, bottom = y + h / 2 - half_height, y + h / 2 + half_height
        for side, (u, v) in enumerate(((left, down), (right, down), (across, top), (across, bottom))):
            nearer_share = _count_nearer(depth, u, v, z - occluder_margin) / PLACES
            sides[i, side] = at_border[side] or nearer_share > share
    return sides


def _count_nearer(depth: NDArray[np.float32], x: Floats, y: Floats, limit: float) -> int:
    x, y = np.broadcast_arrays(x, y)
    inside = (x >= 0) & (x < depth.shape[1]) & (y >= 0) & (y < depth.shape[0])
    seen = depth[y[inside].astype(np.intp), x[inside].astype(np.intp)]
    return int(np.count_nonzero(has_depth(seen) & (seen.astype(np.float64) < limit)))


def _require(table: Floats, camera: Floats, cut: Cut) -> None:
    border, beside, occluder_margin, share = cut
    require_table(table)
    require_camera(camera)
    if border < 0:
        refuse("border", "no negative number", border)
    for name, value in (("beside", beside), ("occluder_margin", occluder_margin)):
        if not 0 <= value < np.inf:
            refuse(name, "a finite number, not negative", float(value))
    if not 0 <= share <= 1:
        refuse("share", "a number in [0, 1]", float(share))
