# SPDX-License-Identifier: MIT
"""Who is seen where: z-buffers (H, W) in metres, put together from the windows of single people."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.rendering.depth_view import DepthWindow


def merge_window(window: DepthWindow, depth: Array) -> tuple[tuple[slice, slice], Mask]:
    """Put a window into a z-buffer; returns its place there, and where in it the window is nearest."""
    place, part = window.inside(depth.shape[1], depth.shape[0])
    nearer: Mask = part < depth[place]
    np.minimum(depth[place], part, out=depth[place])
    return place, nearer


def find_visible_pixels(window: DepthWindow, depth: Array) -> tuple[Mask, float]:
    """The pixels (H, W) of a window that win a z-buffer that holds it, and their share of those it has alone.

    Pixels beyond the image's edge don't count; the share is 0 where all of them are.
    """
    place, part = window.inside(depth.shape[1], depth.shape[0])
    alone: NDArray[np.bool_] = np.isfinite(part)
    wins = np.zeros(depth.shape, bool)
    wins[place] = alone & (part <= depth[place])
    return wins, float(wins.sum() / max(alone.sum(), 1))


def box_of_mask(mask: Mask) -> Box | None:
    """The smallest box round a mask's pixels; None where there is none."""
    rows, columns = np.nonzero(mask)
    if len(rows) == 0:
        return None
    return Box(float(columns.min()), float(rows.min()), float(np.ptp(columns) + 1), float(np.ptp(rows) + 1))
