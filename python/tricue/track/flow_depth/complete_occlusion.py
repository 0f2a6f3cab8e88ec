# SPDX-License-Identifier: MIT
"""Complete occlusion as printed in section 4.5: it begins and ends with jumps of the window's disparity."""

from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import OCCLUDED_BLOCK, Blocks
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.state import FlowDepthState
from tricue.track.flow_depth.verify import TargetEvidence, disparity_limits, estimate_in_frame


def is_occluded(
    state: FlowDepthState, cues: Cues, evidence: TargetEvidence, blocks: Blocks, p: FlowDepthParams
) -> bool:
    """Whether the target is completely occluded in this frame, with its blocks after the frame's votes.

    It is if its disparity has become much larger, and if it has too few pixels and an occluded block.
    """
    if evidence.disparity > disparity_limits(state, state.disparity, cues.disparity_scale, p).occluder:
        return True
    return not evidence.has_pixels(state, p.min_pixels) and bool((blocks.states == OCCLUDED_BLOCK).any())


def is_back(state: FlowDepthState, disparity: float, cues: Cues, p: FlowDepthParams) -> bool:
    """Whether the disparity in the window is much smaller than in the frame before: the occluder is gone."""
    return state.occluder_disparity > disparity_limits(state, disparity, cues.disparity_scale, p).occluder


def disparity_in_window(k: Kernels, state: FlowDepthState, cues: Cues, p: FlowDepthParams) -> float:
    """The disparity that most of the target window has, cells."""
    expected = state.occluder_disparity if state.occluded else state.disparity
    in_window = state._replace(disparity=expected, temporal_window=state.window)
    return estimate_in_frame(k, in_window, cues, p).peaks[-1]
