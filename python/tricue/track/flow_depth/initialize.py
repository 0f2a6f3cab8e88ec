# SPDX-License-Identifier: MIT
"""The first frame: the target's disparity, its blocks and its outline are those of the box."""

import numpy as np

from tricue.camera.box import Box
from tricue.errors import NoDepthInBoxError
from tricue.kernels import Kernels
from tricue.track.base.validation import Moving
from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.cues import own_disparity
from tricue.track.flow_depth.outline import Outline
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, grown, places_of
from tricue.track.flow_depth.state import FollowState
from tricue.track.flow_depth.view import Lens, View

INSIDE = 0.15, 0.1  # of the box's width and height, not looked at for its disparity


def initialize(
    k: Kernels, checked: Moving, view: View, lens: Lens, target: Box, p: FlowDepthParams
) -> FollowState:
    """The state after the first frame. ValueError where what is in the box has no disparity in common."""
    x0, y0, x1, y1 = (value / view.step for value in target.xyxy)
    window = x0, y0, x1, y1
    disparity = _disparity(k, view, window, target) if "disparity" in p.cues else 0.0
    blocks = Blocks.of(window, p)
    region = places_of(window, view.gray.shape)
    return FollowState(
        shape=checked.image.shape,
        lens=lens,
        view=view,
        window=window,
        temporal=window,
        blocks=blocks,
        outline=Outline.of(window, blocks),
        velocity=(0.0, 0.0),
        disparity=disparity,
        first=disparity,
        timestamp=checked.frame.timestamp,
        region=region,
        pixels=np.zeros((region[3] - region[1], region[2] - region[0]), np.uint8),
    )


def _disparity(k: Kernels, view: View, window: Rectangle, target: Box) -> float:
    """In the first window, places."""
    x0, y0, x1, y1 = places_of(window, view.gray.shape)
    across, along = INSIDE
    inner = grown((x0, y0, x1, y1), -across * (x1 - x0), -along * (y1 - y0))
    disparity = own_disparity(k, view, places_of(inner, view.gray.shape))
    if disparity is None:
        raise NoDepthInBoxError(f"box: expected a target with a disparity, got hardly any in {tuple(target)}")
    return disparity
