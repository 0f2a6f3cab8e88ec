# SPDX-License-Identifier: MIT
"""The search for the target among a frame's objects: near its prediction, or anywhere once it is lost."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.initialize import find_people
from tricue.track.depth_particle.matching import (
    FOLLOWED,
    MISSED,
    NO_COSTS,
    SIGNATURE_COST,
    TargetObject,
    best_match,
    complete_body,
)
from tricue.track.depth_particle.motion import MAX_NOISE_TIME, BodyMotion, RectanglePrediction
from tricue.track.depth_particle.occluder import follow_occluder, remove_occluder
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.state import DepthParticleState

MAX_SEARCH_TIME = 10.0  # seconds over which the search region of a lost target grows


class SearchResult(NamedTuple):
    """The result of a search.

    target: the target's object, if found. motion: with its mean size raised to the visible part where it was
    a lower bound. occluder: (3,) meters, the position of what hides the target, if anything.
    """

    target: TargetObject | None
    motion: BodyMotion
    occluder: Floats | None


def find_target(
    k: Kernels,
    state: DepthParticleState,
    fg: Foreground,
    objects: Objects,
    prediction: RectanglePrediction,
    seconds: float,
    p: DepthParticleParams,
) -> SearchResult:
    """Search for the target among a frame's objects. seconds: since the last frame."""
    expected = state.motion.state + prediction.drift
    time = min(seconds + state.missed_seconds, MAX_SEARCH_TIME if state.is_lost(p) else MAX_NOISE_TIME)
    candidates, occluder = _candidates(state, objects, seconds, p)
    best = best_match(
        k,
        candidates,
        expected,
        state.motion,
        state.signature,
        time,
        FOLLOWED if state.missed_seconds == 0 else MISSED,
        complete=p.complete,
        other_costs=_other_costs(k, state, fg, candidates, p),
    )
    if best is None:
        return SearchResult(None, state.motion, occluder)
    if not p.complete:
        motion = state.motion.grow(candidates.states[best, 3:])
        return SearchResult(TargetObject.from_object(candidates, best), motion, occluder)
    return SearchResult(*complete_body(k, candidates, best, expected, state.motion), occluder)


def _other_costs(
    k: Kernels, state: DepthParticleState, fg: Foreground, objects: Objects, p: DepthParticleParams
) -> Floats:
    """The costs (C,), nats, for a depth histogram unlike the target's and for not being human; or none."""
    if not (p.human_filter or p.depth_signature) or len(objects.states) == 0:
        return NO_COSTS
    costs = np.zeros(len(objects.states))
    if p.depth_signature:
        costs += SIGNATURE_COST * state.model.distance(k, fg, np.ascontiguousarray(objects.states))
    if p.human_filter:
        others = np.ones(len(costs), np.bool_)
        others[find_people(objects, p)] = False
        costs[others] = np.inf
    return costs


def _candidates(
    state: DepthParticleState, objects: Objects, seconds: float, p: DepthParticleParams
) -> tuple[Objects, Floats | None]:
    """All objects but the occluder, and the occluder's position (3,), meters, if there is one."""
    if state.occluder is None:
        return objects, None
    index = follow_occluder(objects, state.occluder, p.max_speed, seconds)
    occluder = state.occluder if index is None else objects.states[index, :3]
    return remove_occluder(objects, occluder), occluder
