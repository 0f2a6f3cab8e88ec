# SPDX-License-Identifier: MIT
"""Z-buffers (H, W) in meters, merged from the windows of single people, and the visible pixels."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.rendering.depth_view import DepthWindow


def merge_window(window: DepthWindow, depth: Array) -> tuple[tuple[slice, slice], Mask]:
    """Merge a window into a z-buffer, in place.

    Returns the slices of the window in the z-buffer, and where in them the window is the nearest.
    """
    place, part = window.inside(depth.shape[1], depth.shape[0])
    nearer: Mask = part < depth[place]
    np.minimum(depth[place], part, out=depth[place])
    return place, nearer


def find_visible_pixels(window: DepthWindow, depth: Array) -> tuple[Mask, float]:
    """The pixels (H, W) at which a window is the nearest in a z-buffer, and their share of its pixels.

    depth: the z-buffer that the window was merged into. Only pixels inside the image count; without any the
    share is 0.
    """
    place, part = window.inside(depth.shape[1], depth.shape[0])
    alone: NDArray[np.bool_] = np.isfinite(part)
    visible = np.zeros(depth.shape, bool)
    visible[place] = alone & (part <= depth[place])
    return visible, float(visible.sum() / max(alone.sum(), 1))


def box_of_mask(mask: Mask) -> Box | None:
    """The bounding box of a mask's pixels; None for an empty mask."""
    rows, columns = np.nonzero(mask)
    if len(rows) == 0:
        return None
    return Box(float(columns.min()), float(rows.min()), float(np.ptp(columns) + 1), float(np.ptp(rows) + 1))
