# SPDX-License-Identifier: MIT
"""Heads in disparities: head-sized ellipses on shoulders and a chest, in front of the rest.

A head's width in pixels follows from its disparity and the baseline alone. So each layer of disparities is
scaled to the same head width, and the same masks are slid over all layers.
"""

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box

Map = NDArray[np.float32]

HEAD_WIDTH, HEAD_HEIGHT = 0.17, 0.22  # meters, of a head with hair
CELLS = 6  # pixels per head width in the scaled layers
LAYER_STEP = 1.1  # ratio of one layer's disparity to the next
LAYER_SHARE, MIN_LAYER = 0.12, 0.8  # half a layer's thickness: of its disparity; at least, pixels
FREE = 1.5  # least difference of the surroundings from the head, in half thicknesses of the layer
MIN_HEAD, MAX_HEAD = 5.0, 0.66  # width of a head, in pixels, and as a share of the disparities' height
MIN_DISPARITY = 2.0  # pixels; behind a farther head the background differs by less than the matching errors
ABOVE, BELOW = 1, 2  # head heights by which a layer is padded at its border, where people are cut off
BODY_HIDDEN = 0.2  # share of a shoulder, or of the chest, that may be hidden or unmatched
FULL_WEIGHT = 0.1  # weight of the shares' sum, to decide between places with equal smallest shares


class HeadCandidate(NamedTuple):
    """prominence: how much of a head, of a body and of free space around the head is seen; at most 1.2.

    box: that of the head's upright ellipse, pixels of the disparities.
    """

    prominence: float
    box: Box


def _masks() -> dict[str, Map]:
    """The masks of head, body and surroundings, defined in head widths from the head's center."""
    rows, columns = round(4.2 * CELLS), round(3.2 * CELLS)
    x = ((np.arange(columns) + 0.5 - columns / 2) / CELLS)[None]
    y = ((np.arange(rows) + 0.5) / CELLS - 1.4)[:, None]
    aspect = HEAD_HEIGHT / HEAD_WIDTH
    radius = np.hypot(x / 0.5, y / (0.5 * aspect))
    beside = (np.abs(y) < 0.55) & (np.abs(x) > 0.68) & (np.abs(x) < 1.25)
    on_shoulders = (y > 1.25) & (y < 1.75) & (np.abs(x) > 0.45) & (np.abs(x) < 1.0)
    on_chest = (y > 1.8) & (y < 2.8) & (np.abs(x) < 0.8)
    above = (y < -0.85) & (y > -1.35) & (np.abs(x) < 0.5)
    places = {
        "head": radius < 0.9,
        "left": beside & (x < 0),
        "right": beside & (x > 0),
        "above": above,
        "left shoulder": on_shoulders & (x < 0),
        "right shoulder": on_shoulders & (x > 0),
        "chest": on_chest,
    }
    return {name: (place / place.sum()).astype(np.float32) for name, place in places.items()}


MASKS = _masks()
MASK_SHAPE = MASKS["head"].shape
HEAD_CENTER = (MASK_SHAPE[1] / 2, 1.4 * CELLS)  # x, y in the masks


def heads_in_disparities(disparities: Map, baseline: float) -> list[HeadCandidate]:
    """The best head in each layer of disparities (H, W), pixels, NaN where missing.

    baseline: meters, between the cameras.
    """
    height = disparities.shape[0]
    disparity, found = max(MIN_DISPARITY, MIN_HEAD * baseline / HEAD_WIDTH), []
    while (head := HEAD_WIDTH / baseline * disparity) < MAX_HEAD * height:
        tolerance = max(MIN_LAYER, LAYER_SHARE * disparity)
        difference = np.abs(disparities - np.float32(disparity))
        layer = (difference <= tolerance).astype(np.float32)
        # This doesn't require them to be behind the head: unmatched pixels are background that only one
        # camera sees beside a head, and without texture the background matches at random.
        free = (~(difference <= FREE * tolerance)).astype(np.float32)
        best = _best_place(layer, free, CELLS / head)
        if best is not None:
            score, x, y = best
            box = Box.from_ellipse(x, y, head / 2, head / 2 * HEAD_HEIGHT / HEAD_WIDTH)
            found.append(HeadCandidate(score, box))
        disparity *= LAYER_STEP
    return found


def _best_place(layer: Map, outside: Map, scale: float) -> tuple[float, float, float] | None:
    """Score and center (layer pixels) of the most head-like place; None if the layer is too small."""
    height, width = layer.shape
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    mode = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    border = (ABOVE * CELLS, BELOW * CELLS, CELLS, CELLS)
    if size[0] + sum(border[2:]) < MASK_SHAPE[1] or size[1] + sum(border[:2]) < MASK_SHAPE[0]:
        return None

    def shares(picture: Map, *names: str) -> Map:
        """The smallest share among the named masks, at every position of the masks."""
        resized = cv2.resize(picture, size, interpolation=mode)
        padded = cv2.copyMakeBorder(resized, *border, cv2.BORDER_REPLICATE)
        correlated = [cv2.matchTemplate(padded, MASKS[name], cv2.TM_CCORR) for name in names]
        return np.asarray(np.minimum.reduce(correlated), np.float32)

    head, free = shares(layer, "head"), shares(outside, "left", "right", "above")
    body = shares(layer, "left shoulder", "right shoulder", "chest") + np.float32(BODY_HIDDEN)
    total = np.minimum(np.minimum(head, free), body) + FULL_WEIGHT * (head + free)
    _, score, _, (x, y) = cv2.minMaxLoc(total)
    return (
        float(score),
        (x + HEAD_CENTER[0] - CELLS) * width / size[0],
        (y + HEAD_CENTER[1] - ABOVE * CELLS) * height / size[1],
    )
