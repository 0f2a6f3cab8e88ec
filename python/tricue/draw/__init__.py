# SPDX-License-Identifier: MIT
"""Pictures and videos of tracks."""

from tricue.draw.flow_depth import block_picture, flow_depth_overlay
from tricue.draw.overlays import (
    STATUS_COLORS,
    OverlayWriter,
    depth_overlay,
    depth_picture,
    depth_range,
    overlay,
)
from tricue.draw.stereo import stereo_overlay

__all__ = [
    "STATUS_COLORS",
    "OverlayWriter",
    "block_picture",
    "depth_overlay",
    "depth_picture",
    "depth_range",
    "flow_depth_overlay",
    "overlay",
    "stereo_overlay",
]
