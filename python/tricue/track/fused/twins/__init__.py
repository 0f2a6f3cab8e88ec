# SPDX-License-Identifier: MIT
"""NumPy twins of the fused tracker's kernels that have no native kernels yet."""

from tricue.track.fused.twins.box_contrast import box_contrast
from tricue.track.fused.twins.edge_shares import edge_shares
from tricue.track.fused.twins.scale_response import scale_response
from tricue.track.fused.twins.scale_train import scale_train

__all__ = [
    "box_contrast",
    "edge_shares",
    "scale_response",
    "scale_train",
]
