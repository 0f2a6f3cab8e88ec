# SPDX-License-Identifier: MIT
"""Verify: whether a match is the target, and the state that follows from it."""

from tricue.track.fused.measure import Match
from tricue.track.fused.params import FusedParams
from tricue.track.fused.state import State

VERIFIED_MEAN_RATE = 0.05  # per frame, of the running means over frames in which the target is recognized


def verify(state: State, match: Match, p: FusedParams) -> State:
    """Move the target to the match if that may be it; count the frame as missed unless it is recognized."""
    occluded = match.covered > p.max_covered
    recognized = not occluded and _is_recognized(state, match, p)
    score = match.score if recognized else min(match.score, p.min_score)
    state = state._replace(features=match.features, score=score, occluded=occluded)
    if occluded or score < p.min_score_to_move:
        return _count_missed(state)
    state = state._replace(target=match.target)
    if not recognized:
        return _count_missed(state)
    structure = match.features.structure_log_odds
    rate = max(1 / state.frames, VERIFIED_MEAN_RATE)  # the mean of all frames at first
    return state._replace(
        missed_frames=0,
        missed_seconds=0.0,
        recognized_side=match.target.side,
        mean_response=_blend(state.mean_response, match.response, rate),
        mean_log_odds=_blend(state.mean_log_odds, match.appearance_log_odds, rate),
        mean_structure_log_odds=_blend(state.mean_structure_log_odds, structure, rate),
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


def _blend(mean: float, value: float, rate: float) -> float:
    return mean + rate * (value - mean)
