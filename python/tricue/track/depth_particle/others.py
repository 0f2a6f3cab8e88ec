# SPDX-License-Identifier: MIT
"""What surely isn't the target: pixels that weren't the target's, and still have the depth that they had.

So furniture that a person passes, or stands beside, is no part of the person. Where the camera moves, depths
change, and nothing is left out.
"""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.projection import project_box

Floats = NDArray[np.float64]
Depth = NDArray[np.float32]
Mask = NDArray[np.uint8]

OWN_REGION = 1.1  # times the target's rectangle, which may be off by that, or miss a hand
SAME_DEPTH, SAME_DEPTH_SLOPE = np.float32(0.02), np.float32(0.005)  # meters, and times z²: a sensor's noise


def without_others(others: Depth, fg: Foreground) -> Mask:
    """(h, w) 0 where the depth is the one of ``others`` (h, w), meters, but for noise; otherwise 1."""
    depth = fg.depth
    same: NDArray[np.bool_] = np.abs(depth - others) <= SAME_DEPTH + SAME_DEPTH_SLOPE * depth * depth
    return (~same).view(np.uint8)


def inside_box(box: Box, fg: Foreground) -> Mask:
    """(h, w) 1 in the region of a box, pixels of the frame, in which its target is; otherwise 0."""
    mask = np.zeros(fg.depth.shape, np.uint8)
    mask[_region(Box(*(each / fg.step for each in box)))] = 1
    return mask


def remember_others(others: Depth | None, fg: Foreground, target: Floats, reach: float) -> Depth:
    """The depths (h, w), meters, of what isn't the target; in its place what ``others`` had there, or NaN.

    Its own are the pixels in the region of its rectangle, state (5,), whose depth is within ``reach`` of its
    own, meters.
    """
    new: Depth = fg.depth.copy()
    place = _region(project_box(target, fg.camera))
    inside = new[place]
    own = np.abs(inside - np.float32(target[2])) < reach
    inside[own] = np.nan if others is None else others[place][own]
    return new


def enlarge(box: Box) -> Box:
    """The region, OWN_REGION times a box, in which its target is."""
    (x, y), width, height = box.center, OWN_REGION * box.width, OWN_REGION * box.height
    return Box(x - width / 2, y - height / 2, width, height)


def _region(box: Box) -> tuple[slice, slice]:
    """The rows and columns of the region of a box."""
    left, top, right, bottom = enlarge(box).xyxy
    return _pixels(top, bottom), _pixels(left, right)


def _pixels(first: float, last: float) -> slice:
    return slice(max(math.floor(first), 0), max(math.ceil(last), 0))
