# SPDX-License-Identifier: MIT
"""The target's pixels and blocks in image pixels, as drawn in figure 8."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.track.flow_depth.state import FlowDepthState


def target_mask(state: FlowDepthState) -> NDArray[np.uint8]:
    """A mask (H, W): 255 at the target's pixels, else 0."""
    cells = np.zeros(state.reduced.gray.shape, np.uint8)
    x0, y0, x1, y1 = state.region
    cells[y0:y1, x0:x1] = 255 * state.pixels
    height, width = state.shape[:2]
    step = state.reduced.step
    mask = cv2.resize(cells, None, fx=step, fy=step, interpolation=cv2.INTER_NEAREST)
    below, right = height - mask.shape[0], width - mask.shape[1]
    return np.asarray(cv2.copyMakeBorder(mask, 0, below, 0, right, cv2.BORDER_CONSTANT), np.uint8)


def block_boxes(state: FlowDepthState, block_state: int) -> tuple[Box, ...]:
    """The boxes of the blocks in a state of figure 7."""
    chosen = state.blocks.rectangles[state.blocks.states == block_state] * state.reduced.step
    return tuple(Box.from_xyxy(*row) for row in chosen.tolist())
