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
from tricue.track.depth_objects.projection import project_box

Floats = NDArray[np.float64]
Depth = NDArray[np.float32]
Mask = NDArray[np.uint8]

OWN_REGION = 1.1  # times the target's rectangle, which may be off by that, or miss a hand
SAME_DEPTH, SAME_DEPTH_SLOPE = 0.02, 0.005  # meters, and times z²: a sensor's noise
NOTHING_KNOWN = np.empty((0, 0), np.float32)


def without_others(k: Kernels, others: Depth, fg: Foreground) -> Mask:
    """(h, w) 0 where the depth is the one of ``others`` (h, w), meters, but for noise; otherwise 1."""
    return k.changed_depth(fg.depth, others, SAME_DEPTH, SAME_DEPTH_SLOPE)


def inside_box(box: Box, fg: Foreground) -> Mask:
    """(h, w) 1 in the region of a box, pixels of the frame, in which its target is; otherwise 0."""
    mask = np.zeros(fg.depth.shape, np.uint8)
    left, top, right, bottom = _region(Box(*(each / fg.step for each in box)), mask.shape)
    mask[top:bottom, left:right] = 1
    return mask


def remember_others(k: Kernels, others: Depth, fg: Foreground, target: Floats, reach: float) -> Depth:
    """The depths (h, w), meters, of what isn't the target; in its place what ``others`` had there, or NaN.

    Its own are the pixels in the region of its rectangle, state (5,), whose depth is within ``reach`` of its
    own, meters.
    """
    region = _region(project_box(target, fg.camera), fg.depth.shape)
    return k.remember_depth(fg.depth, others, region, float(target[2]), reach)


def enlarge(box: Box) -> Box:
    """The region, OWN_REGION times a box, in which its target is."""
    (x, y), width, height = box.center, OWN_REGION * box.width, OWN_REGION * box.height
    return Box(x - width / 2, y - height / 2, width, height)


def _region(box: Box, shape: tuple[int, ...]) -> tuple[int, int, int, int]:
    """First and end of the columns and rows, x0, y0, x1, y1, of the region of a box in an image."""
    left, top, right, bottom = enlarge(box).xyxy
    (height, width), floor, ceil = shape, math.floor, math.ceil
    first = _inside(floor(left), width), _inside(floor(top), height)
    return *first, _inside(ceil(right), width), _inside(ceil(bottom), height)


def _inside(pixel: int, size: int) -> int:
    return min(max(pixel, 0), size)
