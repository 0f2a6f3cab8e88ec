# SPDX-License-Identifier: MIT
"""Which of a frame's objects is the target: where it is expected, or, once it is lost, anywhere."""

from typing import NamedTuple

from tricue.track.base.prediction import Prediction
from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.body import joined
from tricue.track.depth_particle.matching import (
    MAX_COST,
    MAX_COST_MISSED,
    Floats,
    Found,
    best_match,
    same,
    without,
)
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.state import State
from tricue.track.depth_particle.walk import MAX_SPREAD_TIME, Walk

MAX_SEARCH_TIME = 10.0  # seconds; a lost target is looked for as far as it can have gone in that time


class Search(NamedTuple):
    """found: the object that is the target, if any. walk: its size, if it was never seen whole, has grown to
    what is seen of it. occluder: where what hides the target is now, (3,) metres, if anything does.
    """

    found: Found | None
    walk: Walk
    occluder: Floats | None


def find_target(
    state: State, objects: Objects, prediction: Prediction, seconds: float, p: DepthParticleParams
) -> Search:
    """Look for the target among a frame's objects. seconds: since the last frame."""
    expected = state.walk.state + prediction.drift
    time = min(seconds + state.missed, MAX_SEARCH_TIME if state.lost(p) else MAX_SPREAD_TIME)
    candidates, occluder = _candidates(state, objects, seconds, p)
    worst = MAX_COST if state.missed == 0 else MAX_COST_MISSED
    best = best_match(candidates, expected, state.walk, state.signature, time, worst)
    if best is None:
        return Search(None, state.walk, occluder)
    target = joined(candidates, best, expected)
    walk = state.walk.outgrown(target.state[3:])
    return Search(
        Found(target.completed(expected, walk.size), target.whole, target.signature), walk, occluder
    )


def _candidates(
    state: State, objects: Objects, seconds: float, p: DepthParticleParams
) -> tuple[Objects, Floats | None]:
    """All objects but what hides the target, which is followed as long as the target is missed."""
    if state.occluder is None:
        return objects, None
    index = same(objects, state.occluder, p.fastest, seconds)
    occluder = state.occluder if index is None else objects.states[index, :3]
    return without(objects, occluder), occluder
