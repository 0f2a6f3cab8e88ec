# SPDX-License-Identifier: MIT
"""Which of a frame's objects is the target: where it is expected, or, once it is lost, anywhere."""

from tricue.track.base.prediction import Prediction
from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.body import joined
from tricue.track.depth_particle.matching import WORST, WORST_AGAIN, Found, best_match, same, without
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.state import State
from tricue.track.depth_particle.walk import LONG

ANYWHERE = 10.0  # seconds; a lost target is looked for as far as it can have gone in that time


def find_target(state: State, prediction: Prediction, seconds: float, p: DepthParticleParams) -> Found | None:
    """The object that is the target, if any; a size never seen whole grows to what is seen of it.

    seconds: since the last frame.
    """
    expected = state.walk.state + prediction.drift
    time = min(seconds + state.missed, ANYWHERE if state.lost(p) else LONG)
    objects = candidates(state, seconds, p)
    worst = WORST if state.missed == 0 else WORST_AGAIN
    found = best_match(objects, expected, state.walk, state.signature, time, worst)
    if found is None:
        return None
    target = joined(objects, found, expected)
    state.walk = state.walk.outgrown(target.state[3:])
    return Found(target.completed(expected, state.walk.size), target.whole, target.signature)


def candidates(state: State, seconds: float, p: DepthParticleParams) -> Objects:
    """All objects but what hides the target, which is followed as long as the target is missed."""
    if state.front is None:
        return state.objects
    index = same(state.objects, state.front, p.fastest, seconds)
    if index is not None:
        state.front = state.objects.states[index, :3]
    return without(state.objects, state.front)
