# SPDX-License-Identifier: MIT
"""Verify: whether a match is the target, and the state that follows from it."""

import math

from tricue.track.fused.measure import Match
from tricue.track.fused.params import FusedParams
from tricue.track.fused.state import State
from tricue.track.fused.target import Target

VERIFIED_MEAN_RATE = 0.05  # per frame, of the running means over frames in which the target is recognized
MISSED_VELOCITY_FACTOR = 0.5  # per frame in which the box isn't moved


def verify(state: State, match: Match, p: FusedParams) -> State:
    """Move the target to the match if that may be it; count the frame as missed unless it is recognized."""
    occluded = match.covered > p.max_covered
    recognized = not occluded and _is_recognized(state, match, p)
    score = match.score if recognized else min(match.score, p.min_score)
    state = state._replace(features=match.features, score=score, occluded=occluded, flow_patch=None)
    if occluded or score < p.min_score_to_move:
        u, v = state.velocity
        velocity = MISSED_VELOCITY_FACTOR * u, MISSED_VELOCITY_FACTOR * v
        return _count_missed(state._replace(velocity=velocity))
    jumped = _has_jumped(state.target, match.target, p)
    state = state._replace(target=match.target, velocity=_smooth_velocity(state, match.target, jumped, p))
    if not recognized:
        return _count_missed(state)
    structure = match.features.structure_log_odds
    return state._replace(
        missed_frames=0,
        missed_seconds=0.0,
        recognized_side=match.target.side,
        mean_response=_update_mean(state.mean_response, match.response),
        mean_log_odds=_update_mean(state.mean_log_odds, match.appearance_log_odds),
        mean_structure_log_odds=_update_mean(state.mean_structure_log_odds, structure),
        flow_patch=None if jumped else match.flow_patch,
    )


def _is_recognized(state: State, match: Match, p: FusedParams) -> bool:
    """By its score; without depth also by its structure, which doesn't change at once.

    After a missed frame only with a share of the log-odds that it had, which a look-alike never reaches.
    """
    if match.score < p.min_score:
        return False
    min_structure = state.mean_structure_log_odds - p.max_structure_drop
    if match.depth is None and match.features.structure_log_odds < min_structure:
        return False
    return state.missed_frames == 0 or match.log_odds >= p.min_recovery_share * state.mean_log_odds


def _count_missed(state: State) -> State:
    return state._replace(
        missed_frames=state.missed_frames + 1, missed_seconds=state.missed_seconds + state.seconds
    )


def _has_jumped(before: Target, after: Target, p: FusedParams) -> bool:
    """Whether it was found outside of the window around its last place."""
    return math.hypot(after.x - before.x, after.y - before.y) > p.context / 2 * before.side


def _smooth_velocity(state: State, target: Target, jumped: bool, p: FusedParams) -> tuple[float, float]:
    """Pixels per frame; 0 after a jump."""
    if jumped:
        return 0.0, 0.0
    (u, v), rate = state.velocity, p.velocity_rate
    right, down = target.x - state.target.x, target.y - state.target.y
    return u + rate * (right - u), v + rate * (down - v)


def _update_mean(mean: float, value: float) -> float:
    return mean + VERIFIED_MEAN_RATE * (value - mean)
