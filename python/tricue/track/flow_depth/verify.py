# SPDX-License-Identifier: MIT
"""A frame judged by what is known of the target: distributions, pixels and blocks, sections 4.1 to 4.4."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import TARGET, Seen
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.model import Expected, Model, Places, estimate
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, grown, moved
from tricue.track.flow_depth.state import FollowState

Flags = NDArray[np.bool_]
Mask = NDArray[np.uint8]

MARGIN = 4.0  # places, at least, to each side of the window
LARGER = 0.1  # of the margin, for each frame that it was not seen
LONGEST = 20  # of them
CHANGE, REACH = 0.03, 0.3  # of the disparity, in a frame, and as far as histograms reach at least
PART = 0.2  # of the largest region of target pixels, that others must have
FEWEST = 8  # target pixels
BACK = 0.1  # of the blocks, more of which may be hidden when it comes back than when it goes


class Judged(NamedTuple):
    """model: by which it was judged. disparity: the target's. pixels: (h, w) the target's, and how many;
    temporal: the rectangle round them. seen: what the blocks show. nearest: the disparity from which
    something hides it. hidden: share of its blocks that are.
    """

    model: Model
    disparity: float
    pixels: Mask
    number: int
    temporal: Rectangle
    seen: Seen
    nearest: float
    hidden: float

    def found(self, state: FollowState, p: FlowDepthParams) -> bool:
        """Whether the target is there: section 4.5, that it isn't when there are few pixels, or when nearly
        all is hidden.
        """
        share, most = (p.again, p.covered + BACK) if state.missed else (p.few, p.covered)
        return self.number >= max(share * state.usual, FEWEST) and self.hidden < most


def judge(k: Kernels, state: FollowState, cues: Cues, p: FlowDepthParams) -> Judged:
    """What the cues say of the target; a target that isn't seen is judged by the model from before."""
    x, y = cues.region[:2]
    model = state.model if state.missed and state.model is not None else _model(k, state, cues, p)
    box, count, pixels = _pixels(k, state, cues, model, p)
    disparity = state.disparity if state.missed or cues.disparity is None else model.peaks[-1]
    seen = _seen(k, state, cues, pixels, disparity, p)
    nearest = disparity + max(
        p.nearer * state.view.depth_scale(p), p.thickness * abs(disparity + state.shift)
    )
    hidden = state.blocks.covered(seen, nearest)
    return Judged(model, disparity, pixels, count, moved(box, x, y), seen, nearest, hidden)


def candidate(state: FollowState, p: FlowDepthParams) -> Rectangle:
    """The candidate region of section 4.1; larger while the target isn't seen."""
    x0, y0, x1, y1 = state.window
    larger = 1 + LARGER * min(state.missed * p.rate, LONGEST)
    least = MARGIN * state.view.scale
    across, along = p.margin * (x1 - x0), p.margin * (y1 - y0) / 2
    return grown(state.window, larger * max(across, least), larger * max(along, least))


def own_places(k: Kernels, state: FollowState, cues: Cues, chosen: Flags) -> Mask:
    """(h, w) the places of the cues' region that lie in chosen blocks."""
    x, y = cues.region[:2]
    return k.block_mask(state.blocks.rectangles[chosen] - [x, y, x, y], *cues.shape)


def alike(state: FollowState, cues: Cues, disparity: float, p: FlowDepthParams) -> Mask:
    """(h, w) the places that are about as far away as a disparity."""
    view = state.view
    thick = p.thickness * abs(disparity + state.shift) / view.scale
    most = np.float32(max(p.similar, thick) * view.depth_scale(p))
    near: Flags = np.abs(cues.disparities() - np.float32(disparity)) < most
    return near.view(np.uint8)


def _model(k: Kernels, state: FollowState, cues: Cues, p: FlowDepthParams) -> Model:
    """The target's distributions in the temporal window, section 4.2."""
    scale = state.view.scale
    x, y = cues.region[:2]
    expected = []
    if cues.flow is not None:
        spread = p.flow_change if state.settled else p.flow_reach
        expected += [Expected(each, spread * scale, p.flow_reach * scale) for each in state.velocity]
    moving = np.ones(cues.shape, np.uint8)
    if cues.disparity is not None:
        deep = state.view.depth_scale(p)
        most = abs(state.disparity + state.shift)
        change = max(p.depth_change * deep, CHANGE * most)
        expected.append(Expected(state.disparity, change, max(p.depth_reach * deep, REACH * most)))
        # What has another depth, as the background in the first window, moves otherwise.
        off = np.abs(cues.disparity.values - np.float32(state.disparity))
        moving = (~(off > np.float32(p.similar * deep))).view(np.uint8)
    blocks = state.blocks
    own = own_places(k, state, cues, (blocks.states == TARGET) & (blocks.firm > 0))
    return estimate(k, cues, expected, moved(state.temporal, -x, -y), Places(own, moving), state.model, p)


def _pixels(
    k: Kernels, state: FollowState, cues: Cues, model: Model, p: FlowDepthParams
) -> tuple[tuple[int, int, int, int], int, Mask]:
    """The target pixels of section 4.3, cleaned: the box round them, their number, and which."""
    x, y = cues.region[:2]
    window, around = (moved(each, -x, -y) for each in (state.window, candidate(state, p)))
    least = p.posterior if len(p.cues) > 1 else p.posterior_alone
    values = [reading.values for reading in cues.readings]
    mask, _ = k.target_pixels(
        values, model.densities, model.ranges, window, around, least, model.alternatives
    )
    return k.temporal_window(mask, p.neighbours, PART)


def _seen(
    k: Kernels, state: FollowState, cues: Cues, pixels: Mask, disparity: float, p: FlowDepthParams
) -> Seen:
    """What the blocks show, section 4.4."""
    x, y = cues.region[:2]
    rectangles = state.blocks.rectangles - [x, y, x, y]
    values = cues.disparities()
    places, targets, readings, mean = k.block_counts(pixels, values, rectangles)
    _, near, _, _ = k.block_counts(alike(state, cues, disparity, p), values, rectangles)
    known = places if cues.disparity is None else readings
    return Seen(places, targets, known, mean, near)
