# SPDX-License-Identifier: MIT
"""Learning from a frame with the target: velocity, disparity, blocks, outline and running means."""

import numpy as np

from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import OCCLUDED_BLOCK, TARGET_BLOCK, Blocks
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, around, moved
from tricue.track.flow_depth.state import FlowDepthState, Velocity
from tricue.track.flow_depth.verify import TargetEvidence, disparity_limits

MAX_OCCLUDED_FOR_OUTLINE = 0.05  # of the blocks, up to which the outline is learned
MAX_OCCLUDED_FOR_MEANS = 0.15  # of the blocks, up to which the running means are learned
MAX_OCCLUDED_FOR_FIRST_MEANS, FIRST_MEANS = 0.5, 12  # the same in the first learned frames; their number
MIN_SIZE_DISPARITY = 1.0  # cells, from which on the target's size follows its disparity
CENTER_VELOCITY_RATE = 0.3  # of the pixels' center's step; the learning rate of a velocity without flow


def learn(
    k: Kernels, state: FlowDepthState, cues: Cues, evidence: TargetEvidence, p: FlowDepthParams
) -> FlowDepthState:
    """The state after a frame in which the target was found."""
    model, velocity, disparity = evidence.model, state.velocity, state.disparity
    if not state.missed_seconds:
        velocity = (model.peaks[0], model.peaks[1]) if cues.flow else _follow_center(state, evidence)
        disparity = state.disparity if cues.disparity is None else model.peaks[-1]
        if p.velocity_smoothing:
            velocity = state.smooth_velocity(velocity, evidence.pixel_count)
    blocks = state.blocks
    if p.block_rules == "adaptive":
        blocks = blocks.resized(_estimate_size(state, disparity))
    blocks = blocks.voted(k, evidence.observed, evidence.limits, p)
    state = state._replace(
        region=cues.region,
        pixels=evidence.pixels,
        velocity=velocity,
        disparity=disparity,
        model=model,
        temporal_window=evidence.temporal_window,
        missed_seconds=0.0,
        occluded=False,
        score=min(evidence.pixel_count / max(state.mean_pixels, 1.0), 1.0),
        blocks=blocks,
        window=_target_window(blocks, evidence, p) or state.window,
    )
    return _learn_unoccluded(k, state, cues, evidence, p)


def _target_window(blocks: Blocks, evidence: TargetEvidence, p: FlowDepthParams) -> Rectangle | None:
    """The window around the blocks, section 4.5, and also around the target pixels if they count."""
    window = blocks.window
    if p.target_window == "outline":
        return window
    return evidence.temporal_window if window is None else around(window, evidence.temporal_window)


def _estimate_size(state: FlowDepthState, disparity: float) -> float:
    """The factor by which the target has grown: the growth of its disparity for parallel cameras.

    The size is kept if that disparity is so small that noise would dominate.
    """
    offset = state.disparity_offset
    now, first = disparity + offset, state.first_disparity + offset
    return now / first if min(now, first) >= MIN_SIZE_DISPARITY else state.blocks.size


def _learn_unoccluded(
    k: Kernels, state: FlowDepthState, cues: Cues, evidence: TargetEvidence, p: FlowDepthParams
) -> FlowDepthState:
    """Learn the outline and the running means if few blocks are occluded."""
    states, outline = state.blocks.states, state.outline
    counts = np.bincount(states, minlength=OCCLUDED_BLOCK + 1).tolist()
    occluded = counts[OCCLUDED_BLOCK] / max(counts[TARGET_BLOCK] + counts[OCCLUDED_BLOCK], 1)
    if occluded <= MAX_OCCLUDED_FOR_OUTLINE and cues.disparity is not None:
        blocks, limits = state.blocks, disparity_limits(state, state.disparity, cues.disparity_scale, p)
        box, count = k.target_outline(
            evidence.pixels,
            cues.disparity.values,
            blocks.grid_in(cues.region),
            states,
            limits.target,
            limits.tolerance,
        )
        if count:
            outline = outline.learned(moved(box, *cues.region[:2]), blocks)
    is_first = state.learned_frames < FIRST_MEANS
    if occluded <= (MAX_OCCLUDED_FOR_FIRST_MEANS if is_first else MAX_OCCLUDED_FOR_MEANS):
        return state.with_means(evidence.pixel_count, outline)
    return state._replace(outline=outline)


def _follow_center(state: FlowDepthState, evidence: TargetEvidence) -> Velocity:
    """The velocity of the target pixels' center, used without flow; not in the paper."""
    (x, y), (new_x, new_y) = (
        ((x0 + x1) / 2, (y0 + y1) / 2) for x0, y0, x1, y1 in (state.temporal_window, evidence.temporal_window)
    )
    u, v = state.velocity
    return u + CENTER_VELOCITY_RATE * (new_x - x), v + CENTER_VELOCITY_RATE * (new_y - y)
