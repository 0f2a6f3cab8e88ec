# SPDX-License-Identifier: MIT
"""Finds a head in a stereo pair, or in an image with depth: by its shape, its outline and its size in meters.

Among the things that have a head's size and shape and stand in front of the rest, it is the one that best has
a head's outline, too. This needs no face, no colors, and no training.
"""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.base.stereo_matching import StereoMatching
from tricue.track.head_detection.head_outline import find_outline
from tricue.track.head_detection.heads_in_disparities import heads_in_disparities

Map = NDArray[np.float32]

SEARCH_WIDTH = 320  # pixels, approximate width to which disparities and depth are reduced
MATCHING, LEFT_RIGHT_TOLERANCE = StereoMatching(window=7, uniqueness=0), 1
NEAREST, MAX_DISPARITY = 0.25, 4000  # highest disparity, as a share of the width, and in pixels
MIN_SIDE = 12  # pixels
DEPTH_BASELINE = 0.5  # meters, to convert depth to disparities
MIN_PROMINENCE = 0.5  # a ball in the air, without shoulders, has 0.4
OUTLINE_WEIGHT = 3.0  # of an outline's evidence relative to a head's prominence
MIN_SCORE = 2.5  # things that aren't heads have less, except some that have shoulders


def find_head_in_pair(k: Kernels, left: Image, right: Image, baseline: float) -> Box | None:
    """The box of the head that stands out most in a rectified pair, BGR or gray each; None without one.

    baseline: meters, of the rig. The box is that of the head's upright ellipse, in pixels of the left image.
    """
    height, width = left.shape[:2]
    step = max(1, round(width / SEARCH_WIDTH))
    size = (width // step, height // step)
    if min(size) < MIN_SIDE:
        return None
    reduced = k.reduce_gray(left, step), k.reduce_gray(right, step)
    limits = 0, min(math.ceil(size[0] * NEAREST), MAX_DISPARITY)
    disparities = k.sad_disparity(*reduced, (0, 0, *size), False, limits, MATCHING, LEFT_RIGHT_TOLERANCE)
    return _best_head(k, left, disparities, baseline)


def find_head_in_depth(k: Kernels, image: Image, depth: Map, focal_length: float) -> Box | None:
    """The same in an image, BGR or gray, with depth (h, w), meters, 0 or NaN where missing.

    focal_length: along x, in pixels of the depth. Depth has the same view as the image, but may be a few
    pixels off.
    """
    step = max(1, round(depth.shape[1] / SEARCH_WIDTH))
    thinned = depth[::step, ::step]
    if min(thinned.shape) < MIN_SIDE:
        return None
    disparities = np.full(thinned.shape, np.nan, np.float32)
    with np.errstate(over="ignore"):  # from depths near 0
        np.divide(focal_length / step * DEPTH_BASELINE, thinned, out=disparities, where=thinned > 0)
    return _best_head(k, image, disparities, DEPTH_BASELINE)


def _best_head(k: Kernels, image: Image, disparities: Map, baseline: float) -> Box | None:
    """The head with the highest score in an image and its disparities, which may have fewer pixels."""
    (height, width), (rows, columns) = image.shape[:2], disparities.shape
    across, down = width / columns, height / rows
    best, found = MIN_SCORE, None
    for prominence, (x, y, box_width, box_height) in heads_in_disparities(disparities, baseline):
        if prominence < MIN_PROMINENCE:
            continue
        outline = find_outline(k, image, Box(x * across, y * down, box_width * across, box_height * down))
        score = prominence + OUTLINE_WEIGHT * outline.evidence
        if score > best:
            best, found = score, outline.box
    return found
