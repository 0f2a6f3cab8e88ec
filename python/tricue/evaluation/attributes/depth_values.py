# SPDX-License-Identifier: MIT
"""The attribute measured from depth: how much of the target nearer surfaces hide."""

from collections.abc import Iterable

import numpy as np

from tricue.arrays import Floats
from tricue.camera.frame import Frame

NEARER = 0.9  # of the target's distance; nearer surfaces hide it
WINDOW = 5  # frames before and after, over whose depths the median is the target's distance
MAX_PIXELS = 400  # sampled in the inner half of the box
MIN_PIXELS = 20  # with measured depth


def depth_values(frames: Iterable[Frame], boxes: Floats) -> dict[str, Floats]:
    """{"occlusion": (M,)}; boxes: (M, 4) in the depth image. NaN without a true box or depth."""
    inner = [_inner_depths(frame, box) for frame, box in zip(frames, boxes, strict=False)]
    medians = np.full(len(boxes), np.nan)
    for index, depths in enumerate(inner):
        if depths.size >= MIN_PIXELS:
            medians[index] = np.median(depths)
    found = np.full(len(boxes), np.nan)
    for index, depths in enumerate(inner):
        if depths.size >= MIN_PIXELS:
            distance = np.nanmedian(medians[max(0, index - WINDOW) : index + WINDOW + 1])
            found[index] = (depths < NEARER * distance).mean()
    return {"occlusion": found}


def _inner_depths(frame: Frame, box: Floats) -> Floats:
    """Some measured depths in the middle half of a box, meters."""
    if frame.depth is None or np.isnan(box).any():
        return np.empty(0)
    x, y, width, height = box
    left, right = (max(0, round(x + share * width)) for share in (0.25, 0.75))
    top, bottom = (max(0, round(y + share * height)) for share in (0.25, 0.75))
    depths = frame.depth[top:bottom, left:right].ravel()
    depths = depths[np.isfinite(depths)]
    return depths[:: max(1, depths.size // MAX_PIXELS)].astype(np.float64)
