# SPDX-License-Identifier: MIT
"""What the fused tracker learns of a target: at the start, of a new channel, and on its way."""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.fused.examine import Found
from tricue.track.fused.experts import posterior, size
from tricue.track.fused.experts.color import ColorExpert
from tricue.track.fused.experts.depth import DepthExpert, Measured, measure
from tricue.track.fused.experts.filter import FilterExpert
from tricue.track.fused.experts.size import SizeExpert
from tricue.track.fused.identity import Identity
from tricue.track.fused.localize import Known, best_place
from tricue.track.fused.observation import Seen
from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Expected, Sight
from tricue.track.fused.space import Space, locate
from tricue.track.fused.state import Models, State
from tricue.track.fused.view import Target, View, look

Floats = NDArray[np.float64]

ODD = 0.5  # of what the filter usually answers
STARTING = 0.1  # metres, of a target's relief that isn't known yet


def begin(k: Kernels, seen: Seen, target: Target, p: FusedParams) -> State:
    """The state after the first frame."""
    measured = measure(seen.sight(k, None), target, None)
    expected = None if measured is None else Expected(measured.z, STARTING)
    sight = seen.sight(k, expected)
    depth, space = _located(sight, target, measured, p)
    models = first_models(sight, target, p)
    known = Known(models, depth, None, target.side, p)
    view = look(sight, [target], p.context)[0]
    return State(
        shape=seen.shape,
        models={sight.kind: models},
        target=target,
        first_side=target.side,
        side=target.side,
        usual=best_place(known, view).answers[0],
        depth=depth,
        space=space,
        timestamp=seen.timestamp,
    )


def met(state: State, sight: Sight, p: FusedParams) -> State:
    """With models of a kind of picture that wasn't there before, learnt where the target should be now."""
    if sight.kind in state.models:
        return state
    return state._replace(models={**state.models, sight.kind: first_models(sight, state.target, p)})


def located(state: State, seen: Seen, k: Kernels, p: FusedParams) -> State:
    """With the depth of where the target was in the last frame, if it was never measured before."""
    if state.depth is not None or seen.ranger is None or state.missed:
        return state
    sight = seen.sight(k, None)
    depth, space = _located(sight, state.target, measure(sight, state.target, None), p)
    return state._replace(depth=depth, space=space)


def first_models(sight: Sight, target: Target, p: FusedParams) -> Models:
    """Of one view."""
    view = look(sight, [target], p.context)[0]
    color = ColorExpert.start(view)
    looks = size.looks(sight, target, color.table, p)
    own = posterior([color.opinion(view), None if view.depth is None else view.depth[0]])
    assert own is not None, "colors have an opinion"
    return Models(
        FilterExpert.start(view, p),
        color,
        SizeExpert.start(sight.k, looks, p),
        Identity.start(view, looks.ranks[p.scales // 2]),
        size.edge_level(sight.k, own, view.size, p.scale_step),
    )


def learnt(before: State, state: State, sight: Sight, found: Found, p: FusedParams) -> State:
    """With what was found blended in; its looks only where it was surely recognised, and only in some
    frames, at rates that are higher for it; where it wasn't found, nothing. before: the state until now.
    """
    if state.target is not found.target:
        return state
    again = before.lost(p)
    state = _outlined(_ranged(state, sight, found, again, p), found, p)
    if state.missed or state.score < p.learn_above or state.frames % p.learn_every:
        return state
    view = look(sight, [state.target], p.context)[0]
    models = _blended(state.models[sight.kind], view, _caution(state, found, p), p)
    return state._replace(models={**state.models, sight.kind: models})


def _caution(state: State, found: Found, p: FusedParams) -> float:
    """The share of the rates at which looks are learnt: a smaller one where by its structure it rather isn't
    the target, and the filter, too, answers less than usual. Something of its colors may be before it, which
    depth would show.
    """
    odd = found.marks.by_structure < 0 and found.answer < ODD * state.usual
    return p.learn_odd if odd and found.measured is None else 1.0


def _blended(models: Models, view: View, share: float, p: FusedParams) -> Models:
    sight = view.sight
    filter_rate, color_rate = share * _rate(p.filter_rate, p), share * _rate(p.color_rate, p)
    looks = size.looks(sight, view.target, models.color.table, p)
    return models._replace(
        filter=models.filter.learnt(view, filter_rate),
        color=models.color.learnt(view, color_rate),
        size=models.size.learnt(sight.k, looks, filter_rate),
        identity=models.identity.learnt(looks.ranks[p.scales // 2], filter_rate),
    )


def _rate(rate: float, p: FusedParams) -> float:
    """What a rate per frame comes to in the frames from one learning to the next."""
    return 1 - (1 - rate) ** p.learn_every


def _outlined(state: State, found: Found, p: FusedParams) -> State:
    """With the outline that was seen."""
    if found.outline is None or state.missed:
        return state
    rate = 1 - math.exp(-state.seconds / p.outline_time)
    return state._replace(outline=state.outline.moved(found.outline, rate))


def _ranged(state: State, sight: Sight, found: Found, again: bool, p: FusedParams) -> State:
    """With the depth that was measured in the 3-D filter."""
    if state.depth is None or state.space is None or found.measured is None or (again and state.missed):
        return state
    point, noise = locate(sight, state.target, found.measured)
    if again:
        return state._replace(space=Space.start(point, noise, p))
    depth = state.depth.learnt(found.measured, state.target.side * found.measured.z, p.depth_rate)
    return state._replace(depth=depth, space=state.space.corrected(sight.k, point, noise))


def _located(
    sight: Sight, target: Target, measured: Measured | None, p: FusedParams
) -> tuple[DepthExpert, Space] | tuple[None, None]:
    """What is known of depth after its first measurement."""
    if measured is None:
        return None, None
    point, noise = locate(sight, target, measured)
    start = DepthExpert(STARTING, target.side * measured.z)
    return start.learnt(measured, target.side * measured.z, 1.0), Space.start(point, noise, p)
