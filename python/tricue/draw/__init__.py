# SPDX-License-Identifier: MIT
"""Drawing of tracks: overlays on images, masks, paths from above, and videos."""

from tricue.draw.canvas import STATUS_COLORS
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.draw.masks import block_picture, flow_depth_overlay
from tricue.draw.overlays import depth_overlay, overlay
from tricue.draw.paths import draw_path, path_from_above, save_path
from tricue.draw.stereo import stereo_overlay
from tricue.draw.targets import TARGET_COLORS, targets_overlay
from tricue.draw.video import OverlayWriter

__all__ = [
    "STATUS_COLORS",
    "TARGET_COLORS",
    "OverlayWriter",
    "block_picture",
    "depth_overlay",
    "depth_picture",
    "depth_range",
    "draw_path",
    "flow_depth_overlay",
    "overlay",
    "path_from_above",
    "save_path",
    "stereo_overlay",
    "targets_overlay",
]
