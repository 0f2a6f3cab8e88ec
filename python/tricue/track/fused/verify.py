# SPDX-License-Identifier: MIT
"""Whether what was found is the target, and what follows from that for the state."""

import math

from tricue.track.fused.examine import Found
from tricue.track.fused.params import FusedParams
from tricue.track.fused.state import State
from tricue.track.fused.view import Target

USUAL_RATE = 0.05  # per frame, of what is usual where the target is
SLOWING = 0.5  # of the velocity, a frame in which the target isn't where it should be


def judged(state: State, found: Found, p: FusedParams) -> State:
    """Make what was found the state; what is surely something else, or hidden, only counts as missed."""
    hidden = found.hidden > p.hidden_above
    recognised = not hidden and _recognised(state, found, p)
    score = found.score if recognised else min(found.score, p.lost_below)
    state = state._replace(marks=found.marks, score=score, hidden=hidden, glance=None)
    if hidden or score < p.hopeless:
        u, v = state.velocity
        return _missed(state._replace(velocity=(SLOWING * u, SLOWING * v)))
    jumped = _far(state.target, found.target, p)
    state = state._replace(target=found.target, velocity=_velocity(state, found.target, jumped, p))
    if not recognised:
        return _missed(state)
    return state._replace(
        missed=0,
        unseen=0.0,
        side=found.target.side,
        usual=_blended(state.usual, found.answer),
        sure=_blended(state.sure, found.by_look),
        structure=_blended(state.structure, found.marks.by_structure),
        glance=None if jumped else found.glance,
    )


def _recognised(state: State, found: Found, p: FusedParams) -> bool:
    """By its score; without depth also by its structure, which does not go at once; and, when it was missed,
    only if it is about as sure as it used to be, which a look-alike never is.
    """
    if found.score < p.lost_below:
        return False
    if found.measured is None and found.marks.by_structure < state.structure - p.collapse:
        return False
    return state.missed == 0 or found.log_odds >= p.again * state.sure


def _missed(state: State) -> State:
    """One more frame without it."""
    return state._replace(missed=state.missed + 1, unseen=state.unseen + state.seconds)


def _far(before: Target, after: Target, p: FusedParams) -> bool:
    return math.hypot(after.x - before.x, after.y - before.y) > p.context / 2 * before.side


def _velocity(state: State, target: Target, jumped: bool, p: FusedParams) -> tuple[float, float]:
    if jumped:
        return 0.0, 0.0
    (u, v), rate = state.velocity, p.velocity_rate
    right, down = target.x - state.target.x, target.y - state.target.y
    return u + rate * (right - u), v + rate * (down - v)


def _blended(usual: float, now: float) -> float:
    return usual + USUAL_RATE * (now - usual)
