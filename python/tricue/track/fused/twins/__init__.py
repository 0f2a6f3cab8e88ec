# SPDX-License-Identifier: MIT
"""NumPy twins of the fused tracker's kernels, until native ones stand beside them in the tree of kernels."""

from tricue.track.fused.twins.box_contrast import box_contrast
from tricue.track.fused.twins.correlation_response import correlation_response
from tricue.track.fused.twins.correlation_train import correlation_train
from tricue.track.fused.twins.edge_shares import edge_shares
from tricue.track.fused.twins.gradient_color_cells import gradient_color_cells
from tricue.track.fused.twins.sample_windows import sample_windows
from tricue.track.fused.twins.scale_response import scale_response
from tricue.track.fused.twins.scale_train import scale_train

__all__ = [
    "box_contrast",
    "correlation_response",
    "correlation_train",
    "edge_shares",
    "gradient_color_cells",
    "sample_windows",
    "scale_response",
    "scale_train",
]
