# SPDX-License-Identifier: MIT
"""What a frame in which the target was found changes: its velocity and disparity, its blocks and its
outline.
"""

from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import NOT_TARGET, OCCLUDED, TARGET
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, moved
from tricue.track.flow_depth.state import FollowState, Velocity
from tricue.track.flow_depth.verify import Judged, alike, own_places

YOUNG = 12  # frames learned, before which it is also learned while more is hidden
MAX_OCCLUDED_OUTLINE = 0.05  # of the blocks, up to which the outline is learned
MAX_OCCLUDED, MAX_OCCLUDED_YOUNG = 0.15, 0.5  # the same for velocity and number of pixels
MIN_DISPARITY = 1.0  # places, from which the target's size is known from it
FOLLOW_RATE = 0.3  # of a step of the target pixels' centre, that a velocity without flow takes


def accepted(k: Kernels, state: FollowState, cues: Cues, judged: Judged, p: FlowDepthParams) -> FollowState:
    """The target is where its pixels are: what velocity and disparity it has, and which blocks."""
    model = judged.model
    if not state.missed:
        measured = (model.peaks[0], model.peaks[1]) if cues.flow else _followed(state, judged.temporal)
        disparity = state.disparity if cues.disparity is None else model.peaks[-1]
        state = state._replace(velocity=state.velocity_of(measured, judged.number), disparity=disparity)
    blocks = state.blocks._replace(size=_size(state)).voted(judged.seen, judged.nearest, p)
    state = state._replace(
        model=model,
        temporal=judged.temporal,
        missed=0.0,
        covered=False,
        score=min(judged.number / max(state.usual, 1.0), 1.0),
        blocks=blocks,
        window=blocks.window or state.window,
    )
    return _learned_usual(k, state, cues, judged, p)


def _size(state: FollowState) -> float:
    """By which the target has grown: as the disparity of parallel cameras. It stays where that is so
    small, or none at all, that its noise would be most of the ratio.
    """
    now, first = state.disparity + state.shift, state.first + state.shift
    return now / first if min(now, first) >= MIN_DISPARITY else state.blocks.size


def _learned_usual(
    k: Kernels, state: FollowState, cues: Cues, judged: Judged, p: FlowDepthParams
) -> FollowState:
    """How large and how fast it is, in frames in which nothing hides it."""
    states = state.blocks.states
    occluded = int((states == OCCLUDED).sum()) / max(int((states != NOT_TARGET).sum()), 1)
    if occluded <= MAX_OCCLUDED_OUTLINE and cues.disparity is not None:
        mine = own_places(k, state, cues, states == TARGET)
        mine &= judged.pixels | alike(state, cues, state.disparity, p)
        box, number, _ = k.temporal_window(mine, 0, 0.0)
        if number:
            outline = state.outline.learned(moved(box, *cues.region[:2]), state.blocks)
            state = state._replace(outline=outline)
    if occluded <= (MAX_OCCLUDED if state.known >= YOUNG else MAX_OCCLUDED_YOUNG):
        state = state.learned(judged.number)
    return state


def _followed(state: FollowState, temporal: Rectangle) -> Velocity:
    """Without flow: that of the target pixels' centre. The paper has none."""
    (x, y), (new_x, new_y) = (((x0 + x1) / 2, (y0 + y1) / 2) for x0, y0, x1, y1 in (state.temporal, temporal))
    u, v = state.velocity
    return u + FOLLOW_RATE * (new_x - x), v + FOLLOW_RATE * (new_y - y)
