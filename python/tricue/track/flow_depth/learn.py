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

YOUNG, HALF = 12, 0.5  # frames learnt, before which it is also learnt while less is hidden
OUTLINE_FREE, USUAL_FREE = 0.05, 0.15  # of the blocks occluded, up to which these are learnt
LEAST = 1.0  # places of disparity, from which the target's size is known from it
FOLLOW = 0.3  # of a step of the target pixels' centre, that a velocity without flow takes


def accept(k: Kernels, state: FollowState, cues: Cues, judged: Judged, p: FlowDepthParams) -> None:
    """The target is where its pixels are: what velocity and disparity it has, and which blocks."""
    model = judged.model
    if not state.missed:
        measured = (model.peaks[0], model.peaks[1]) if cues.flow else _followed(state, judged.temporal)
        state.velocity = state.velocity_of(measured, judged.number)
        if cues.disparity is not None:
            state.disparity = model.peaks[-1]
    state.model, state.temporal = model, judged.temporal
    state.missed, state.covered = 0.0, False
    state.score = min(judged.number / max(state.usual, 1.0), 1.0)
    state.blocks = state.blocks._replace(size=_size(state)).voted(judged.seen, judged.nearest, p)
    state.window = state.blocks.window or state.window
    _learn_usual(k, state, cues, judged, p)


def _size(state: FollowState) -> float:
    """By which the target has grown: as the disparity of parallel cameras. It stays where that is so
    small, or none at all, that its noise would be most of the ratio.
    """
    now, first = state.disparity + state.shift, state.first + state.shift
    return now / first if min(now, first) >= LEAST else state.blocks.size


def _learn_usual(k: Kernels, state: FollowState, cues: Cues, judged: Judged, p: FlowDepthParams) -> None:
    """How large and how fast it is, in frames in which nothing hides it."""
    states = state.blocks.states
    occluded = int((states == OCCLUDED).sum()) / max(int((states != NOT_TARGET).sum()), 1)
    if occluded <= OUTLINE_FREE and cues.disparity is not None:
        mine = own_places(k, state, cues, states == TARGET)
        mine &= judged.pixels | alike(state, cues, state.disparity, p)
        box, number, _ = k.temporal_window(mine, 0, 0.0)
        if number:
            state.outline = state.outline.learnt(moved(box, *cues.region[:2]), state.blocks)
    if occluded <= (USUAL_FREE if state.known >= YOUNG else HALF):
        state.learn(judged.number)


def _followed(state: FollowState, temporal: Rectangle) -> Velocity:
    """Without flow: that of the target pixels' centre. The paper has none."""
    (x, y), (new_x, new_y) = (((x0 + x1) / 2, (y0 + y1) / 2) for x0, y0, x1, y1 in (state.temporal, temporal))
    u, v = state.velocity
    return u + FOLLOW * (new_x - x), v + FOLLOW * (new_y - y)
