# SPDX-License-Identifier: MIT
"""What figure 8 shows of the target: its pixels and its blocks, in the image's pixels."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.track.flow_depth.state import FollowState


def mask_of(state: FollowState) -> NDArray[np.uint8]:
    """(H, W) 255 at the target's pixels."""
    places = np.zeros(state.view.gray.shape, np.uint8)
    x0, y0, x1, y1 = state.region
    places[y0:y1, x0:x1] = 255 * state.pixels
    height, width = state.shape[:2]
    step = state.view.step
    whole = cv2.resize(places, None, fx=step, fy=step, interpolation=cv2.INTER_NEAREST)
    below, right = height - whole.shape[0], width - whole.shape[1]
    return np.asarray(cv2.copyMakeBorder(whole, 0, below, 0, right, cv2.BORDER_CONSTANT), np.uint8)


def blocks_of(state: FollowState, wanted: int) -> tuple[Box, ...]:
    """The blocks in a state of figure 7."""
    chosen = state.blocks.rectangles[state.blocks.states == wanted] * state.view.step
    return tuple(Box.from_xyxy(*row) for row in chosen.tolist())
