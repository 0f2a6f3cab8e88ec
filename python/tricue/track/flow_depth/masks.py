# SPDX-License-Identifier: MIT
"""Masks of a region's cells: those in blocks, and those at a disparity."""

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.state import FlowDepthState

Flags = NDArray[np.bool_]
Mask = NDArray[np.uint8]


def mask_blocks(k: Kernels, state: FlowDepthState, cues: Cues, chosen: Flags) -> Mask:
    """(h, w) 1 at the cells of the cues' region that lie in chosen blocks; chosen: (N,)."""
    return k.block_mask(state.blocks.rectangles_in(cues.region)[chosen], *cues.shape)


def mask_disparity(state: FlowDepthState, cues: Cues, disparity: float, p: FlowDepthParams) -> Mask:
    """(h, w) 1 at the cells whose disparity is within the tolerance of one, cells; 0 without a disparity."""
    tolerance = np.float32(disparity_tolerance(state, disparity, p))
    near: Flags = np.abs(cues.disparities() - np.float32(disparity)) < tolerance
    return near.view(np.uint8)


def disparity_tolerance(state: FlowDepthState, disparity: float, p: FlowDepthParams) -> float:
    """By how much a disparity may differ from the target's, cells, to be similar to it."""
    reduced = state.reduced
    thickness = p.thickness * abs(disparity + state.disparity_offset) / reduced.scale
    return max(p.disparity_tolerance, thickness) * reduced.disparity_scale(p)
