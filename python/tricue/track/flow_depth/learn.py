# SPDX-License-Identifier: MIT
"""What a frame with the target teaches: its velocity, disparity, blocks, outline and running means."""

import numpy as np

from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import NOT_TARGET_BLOCK, OCCLUDED_BLOCK, Blocks
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, around, moved
from tricue.track.flow_depth.state import FlowDepthState, Velocity
from tricue.track.flow_depth.verify import Verdict, disparity_limits

MAX_OCCLUDED_FOR_OUTLINE = 0.05  # of the blocks, up to which the outline is learned
MAX_OCCLUDED_FOR_MEANS = 0.15  # of the blocks, up to which the running means are learned
MAX_OCCLUDED_FOR_FIRST_MEANS, FIRST_MEANS = 0.5, 12  # the same in the first learned frames; how many
MIN_SIZE_DISPARITY = 1.0  # cells, from which the target's size follows its disparity
CENTER_VELOCITY_RATE = 0.3  # of a step of the target pixels' center, that a velocity without flow takes


def learn(
    k: Kernels, state: FlowDepthState, cues: Cues, verdict: Verdict, p: FlowDepthParams
) -> FlowDepthState:
    """The state after a frame in which the target was found."""
    model = verdict.model
    if not state.missed:
        window = verdict.temporal_window
        measured = (model.peaks[0], model.peaks[1]) if cues.flow else _follow_center(state, window)
        disparity = state.disparity if cues.disparity is None else model.peaks[-1]
        if p.velocity_smoothing:
            measured = state.smooth_velocity(measured, verdict.pixel_count)
        state = state._replace(velocity=measured, disparity=disparity)
    blocks = state.blocks
    if p.block_rules == "adaptive":
        blocks = blocks._replace(size=_estimate_size(state))
    blocks = blocks.voted(k, verdict.observed, verdict.limits, p)
    state = state._replace(
        model=model,
        temporal_window=verdict.temporal_window,
        missed=0.0,
        occluded=False,
        score=min(verdict.pixel_count / max(state.mean_pixels, 1.0), 1.0),
        blocks=blocks,
        window=_target_window(blocks, verdict, p) or state.window,
    )
    return _learn_unoccluded(k, state, cues, verdict, p)


def _target_window(blocks: Blocks, verdict: Verdict, p: FlowDepthParams) -> Rectangle | None:
    """The window around the blocks, section 4.5, and around the target pixels where they count, too."""
    window = blocks.window
    if p.target_window == "outline":
        return window
    return verdict.temporal_window if window is None else around(window, verdict.temporal_window)


def _estimate_size(state: FlowDepthState) -> float:
    """The factor by which the target has grown: that of its disparity for parallel cameras.

    The size stays where that disparity is so small that its noise would decide.
    """
    now, first = (each + state.disparity_offset for each in (state.disparity, state.first_disparity))
    return now / first if min(now, first) >= MIN_SIZE_DISPARITY else state.blocks.size


def _learn_unoccluded(
    k: Kernels, state: FlowDepthState, cues: Cues, verdict: Verdict, p: FlowDepthParams
) -> FlowDepthState:
    """The outline and the running means, learned where few blocks are occluded."""
    states = state.blocks.states
    mine = int(np.count_nonzero(states != NOT_TARGET_BLOCK))
    occluded = int(np.count_nonzero(states == OCCLUDED_BLOCK)) / max(mine, 1)
    if occluded <= MAX_OCCLUDED_FOR_OUTLINE and cues.disparity is not None:
        blocks, (disparity, tolerance, _) = state.blocks, disparity_limits(state, state.disparity, p)
        box, count = k.target_outline(
            verdict.pixels,
            cues.disparity.values,
            blocks.corners,
            blocks.place_in(cues.region),
            states,
            disparity,
            tolerance,
        )
        if count:
            outline = state.outline.learned(moved(box, *cues.region[:2]), state.blocks)
            state = state._replace(outline=outline)
    is_first = state.learned_frames < FIRST_MEANS
    if occluded <= (MAX_OCCLUDED_FOR_FIRST_MEANS if is_first else MAX_OCCLUDED_FOR_MEANS):
        state = state.with_means(verdict.pixel_count)
    return state


def _follow_center(state: FlowDepthState, window: Rectangle) -> Velocity:
    """The velocity of the target pixels' center, where there is no flow; ours, the paper has none."""
    (x, y), (new_x, new_y) = (
        ((x0 + x1) / 2, (y0 + y1) / 2) for x0, y0, x1, y1 in (state.temporal_window, window)
    )
    u, v = state.velocity
    return u + CENTER_VELOCITY_RATE * (new_x - x), v + CENTER_VELOCITY_RATE * (new_y - y)
