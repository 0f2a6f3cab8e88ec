# SPDX-License-Identifier: MIT
"""The state after the first frame: the target's disparity, blocks and outline are taken from the box."""

import numpy as np

from tricue.camera.box import Box
from tricue.errors import NoDepthInBoxError
from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.cue_input import CueInput
from tricue.track.flow_depth.initial_disparity import MIN_DISPARITY_CELLS, find_initial_disparity
from tricue.track.flow_depth.outline import PixelOutline
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, cells_of, grown
from tricue.track.flow_depth.reduced_frame import ReducedFrame
from tricue.track.flow_depth.state import FlowDepthState
from tricue.track.flow_depth.verged_geometry import VergedGeometry

BOX_MARGIN = 0.15, 0.1  # of the box's width and height at each side, excluded from the first disparity


def initialize(
    k: Kernels,
    checked: CueInput,
    reduced: ReducedFrame,
    geometry: VergedGeometry,
    target: Box,
    p: FlowDepthParams,
) -> FlowDepthState:
    """The state after the first frame.

    NoDepthInBoxError if the box's cells share no disparity, unless flow is the only cue.
    """
    x0, y0, x1, y1 = (value / reduced.step for value in target.xyxy)
    window = x0, y0, x1, y1
    disparity = _initialize_disparity(k, reduced, window, target) if "disparity" in p.cues else 0.0
    blocks = Blocks.of(window, p)
    region = cells_of(window, reduced.gray.shape)
    return FlowDepthState(
        shape=checked.image.shape,
        geometry=geometry,
        reduced=reduced,
        window=window,
        shift=(0.0, 0.0),
        candidate=window,
        temporal_window=window,
        blocks=blocks,
        outline=PixelOutline.of(window, blocks),
        velocity=(0.0, 0.0),
        disparity=disparity,
        first_disparity=disparity,
        timestamp=checked.frame.timestamp,
        region=region,
        pixels=np.zeros((region[3] - region[1], region[2] - region[0]), np.uint8),
    )


def _initialize_disparity(k: Kernels, reduced: ReducedFrame, window: Rectangle, target: Box) -> float:
    """The disparity of the first window without its margin, cells."""
    x0, y0, x1, y1 = cells_of(window, reduced.gray.shape)
    across, along = BOX_MARGIN
    inner = grown((x0, y0, x1, y1), -across * (x1 - x0), -along * (y1 - y0))
    middle = cells_of(inner, reduced.gray.shape)
    count = max(middle[2] - middle[0], 0) * max(middle[3] - middle[1], 0)
    if count < MIN_DISPARITY_CELLS:
        side = reduced.step
        raise NoDepthInBoxError(
            f"box: expected a target with a disparity in {MIN_DISPARITY_CELLS} cells of {side}x{side} pixels "
            f"or more, got {count} in the middle of {tuple(target)}"
        )
    disparity = find_initial_disparity(k, reduced, middle)
    if disparity is None:
        raise NoDepthInBoxError(f"box: expected a target with a disparity, got hardly any in {tuple(target)}")
    return disparity
