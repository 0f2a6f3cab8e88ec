# SPDX-License-Identifier: MIT
"""What surely isn't the target: pixels that weren't the target's, and still have the depth that they had.

So furniture that a person passes, or stands beside, is no part of the person. Where the camera moves, depths
change, and nothing is left out.
"""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.objects import Region
from tricue.track.depth_objects.projection import project_rectangle

Floats = NDArray[np.float64]
Depth = NDArray[np.float32]

OWN_REGION = 1.1  # times the target's rectangle, which may be off by that, or miss a hand


def region_in(box: Box, fg: Foreground) -> Region:
    """The columns and rows of the foreground, x0, y0, x1, y1, in which the target in a box is, pixels."""
    seen = Box(*(each / fg.step for each in box))
    return _region(*seen.center, seen.width, seen.height, fg.depth.shape)


def remember_others(k: Kernels, others: Depth, fg: Foreground, target: Floats, reach: float) -> Depth:
    """The depths (h, w), meters, of what isn't the target; in its place what ``others`` had there, or NaN.

    Its own are the pixels in the region of its rectangle, state (5,), whose depth is within ``reach`` of its
    own, meters.
    """
    x, y, width, height, z = project_rectangle(target, fg.camera)
    return k.remember_depth(fg.depth, others, _region(x, y, width, height, fg.depth.shape), z, reach)


def enlarge(box: Box) -> Box:
    """The region, OWN_REGION times a box, in which its target is."""
    (x, y), width, height = box.center, OWN_REGION * box.width, OWN_REGION * box.height
    return Box(x - width / 2, y - height / 2, width, height)


def _region(x: float, y: float, width: float, height: float, shape: tuple[int, ...]) -> Region:
    """First and end of the columns and rows, x0, y0, x1, y1, of the region of a box of this center."""
    width, height = OWN_REGION * width, OWN_REGION * height
    left, top, (rows, columns) = x - width / 2, y - height / 2, shape
    right, bottom = math.ceil(left + width), math.ceil(top + height)
    x0, y0 = min(max(math.floor(left), 0), columns), min(max(math.floor(top), 0), rows)
    return x0, y0, min(max(right, 0), columns), min(max(bottom, 0), rows)
