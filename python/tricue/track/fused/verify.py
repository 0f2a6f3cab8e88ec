# SPDX-License-Identifier: MIT
"""Verify: whether a match is the target, and the state after that decision.

The models may have learned an occluder, which then looks like the target in the next frames. So a missed
target needs higher log-odds to be recognized than a followed one. With depth, which shows occluders, that is
so only once the target is LOST.
"""

import math

from tricue.track.fused.clutter import NO_CLUTTER
from tricue.track.fused.identity import log_odds_of, score_of
from tricue.track.fused.measure import Match
from tricue.track.fused.params import FusedParams
from tricue.track.fused.state import FusedState

VERIFIED_TIME_CONSTANT = 0.65  # seconds; of running means over frames in which the target is recognized


def verify(state: FusedState, match: Match, p: FusedParams) -> FusedState:
    """Move the target to the match if that may be the target; count the frame as missed if it isn't."""
    occluded = match.covered > p.max_covered
    needed = _min_log_odds(state, match, p)
    features = match.candidate.features
    recognized = not occluded and match.log_odds >= needed
    # A LOST target may be anywhere, so a match is less likely to be it. The score is shifted so that a match
    # with just the needed log-odds gets ``min_score``, as for a followed target.
    score = score_of(match.log_odds - needed + log_odds_of(p.min_score)) if state.is_lost(p) else match.score
    if not recognized:
        score = min(score, p.min_score)
    moved = not occluded and match.score >= p.min_score_to_move
    target = match.target if moved else state.target
    if not (moved and recognized):
        return state.replace(
            target=target,
            moved=moved,
            features=features,
            score=score,
            occluded=occluded,
            motion=state.motion.interrupt(),
            clutter=state.clutter if match.best_seen is None else state.clutter.add(match.best_seen),
            missed_frames=state.missed_frames + 1,
            missed_seconds=state.missed_seconds + state.seconds,
        )
    rate = running_mean_rate(state.frames, state.seconds)
    return state.replace(
        target=target,
        moved=True,
        features=features,
        score=score,
        occluded=occluded,
        motion=state.motion.follow(state.target, target, state.seconds),
        clutter=NO_CLUTTER,
        memory=state.memory.keep(state.models),
        missed_frames=0,
        missed_seconds=0.0,
        recognized_side=match.target.side,
        mean_response=state.mean_response + rate * (match.candidate.response - state.mean_response),
        typical=features if state.typical is None else state.typical.blend(features, rate),
    )


def running_mean_rate(frames: int, seconds: float) -> float:
    """The weight of the latest frame in a running mean, which starts as the mean of all frames.

    frames: their number. seconds: since the previous frame.
    """
    return max(1 / frames, 1 - math.exp(-seconds / VERIFIED_TIME_CONSTANT))


def _min_log_odds(state: FusedState, match: Match, p: FusedParams) -> float:
    """The log-odds that a match needs to be recognized."""
    sees_occluders = match.observation.depth_source is not None
    if state.is_lost(p) or (state.missed_frames and not sees_occluders):
        return state.clutter.min_log_odds(p)
    return log_odds_of(p.min_score)
