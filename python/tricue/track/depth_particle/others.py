# SPDX-License-Identifier: MIT
"""Pixels that certainly aren't the target: they weren't part of it before, and their depth hasn't changed.

So furniture that a person passes or stands beside doesn't become part of the person. If the camera moves,
depths change, and nothing is left out.
"""

import math

from tricue.arrays import Depth, Floats
from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.objects import Region
from tricue.track.depth_objects.projection import project_rectangle

OWN_REGION = 1.1  # times the target's rectangle, which may be inaccurate or miss a hand


def region_in(box: Box, fg: Foreground) -> Region:
    """The foreground's columns and rows, x0, y0, x1, y1, that may contain the target in a box, pixels."""
    seen = Box(*(each / fg.step for each in box))
    return _region(*seen.center, seen.width, seen.height, fg.depth.shape)


def remember_others(k: Kernels, others: Depth, fg: Foreground, target: Floats, reach: float) -> Depth:
    """The depths (h, w) of everything but the target, meters; at the target, those of ``others``, or NaN.

    The target's pixels are those in the region of its rectangle, state (5,), within ``reach`` of its depth,
    meters.
    """
    x, y, width, height, z = project_rectangle(target, fg.camera)
    return k.remember_depth(fg.depth, others, _region(x, y, width, height, fg.depth.shape), z, reach)


def enlarge(box: Box) -> Box:
    """The region, OWN_REGION times a box, that contains the box's target."""
    (x, y), width, height = box.center, OWN_REGION * box.width, OWN_REGION * box.height
    return Box(x - width / 2, y - height / 2, width, height)


def _region(x: float, y: float, width: float, height: float, shape: tuple[int, ...]) -> Region:
    """The region's columns and rows, x0, y0, x1, y1, for a box with this center."""
    width, height = OWN_REGION * width, OWN_REGION * height
    left, top, (rows, columns) = x - width / 2, y - height / 2, shape
    right, bottom = math.ceil(left + width), math.ceil(top + height)
    x0, y0 = min(max(math.floor(left), 0), columns), min(max(math.floor(top), 0), rows)
    return x0, y0, min(max(right, 0), columns), min(max(bottom, 0), rows)
