# SPDX-License-Identifier: MIT
"""Re-detect: search for the target in the whole frame."""

import math

from tricue.track.fused.localize import LocalizationModel, localize
from tricue.track.fused.measure import Match, Recognition, measure, recognize
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.position_filter import back_project
from tricue.track.fused.proposals import LostTarget, propose_windows


def redetect(
    model: LocalizationModel,
    observation: PictureObservation,
    lost: LostTarget,
    local: Match,
    min_log_odds: float,
) -> Match:
    """The best match in the whole frame; local: the match where the target should be.

    The candidates with the most evidence are verified. A match elsewhere needs ``min_log_odds``, and higher
    log-odds than the local match. Candidates below ``min_log_odds`` aren't measured, because the penalty for
    distance can only lower their log-odds.
    """
    windows = propose_windows(model, observation, lost)
    candidates = sorted((localize(model, each) for each in windows), key=lambda each: -each.evidence)
    recognitions = [recognize(model, each) for each in candidates[: model.params.candidates]]
    seen = max([local.log_odds, *map(_lower_log_odds, recognitions)])
    local = local._replace(log_odds=local.log_odds - _distance_penalty(model, lost, local))
    matches = [
        _match_elsewhere(model, lost, each) for each in recognitions if _lower_log_odds(each) >= min_log_odds
    ]
    best = max(matches, key=lambda each: each.log_odds, default=local)
    found = best.log_odds >= min_log_odds and best.log_odds > local.log_odds
    return (best if found else local)._replace(best_seen=seen)


def _lower_log_odds(recognition: Recognition) -> float:
    """Those of the whole appearance, or of the structure if they are lower: elsewhere, both must match."""
    return min(recognition.log_odds, recognition.structure_log_odds)


def _match_elsewhere(model: LocalizationModel, lost: LostTarget, recognition: Recognition) -> Match:
    """A candidate measured away from where the target should be.

    Its structure must match, too, because look-alikes may have the same colors. If no depth was measured,
    which would tell its size, distance lowers the log-odds of the structure as well.
    """
    match = measure(model, recognition)
    penalty = _distance_penalty(model, lost, match)
    structure = match.structure_log_odds - (penalty if match.depth is None else 0.0)
    return match._replace(log_odds=min(match.log_odds - penalty, structure))


def _distance_penalty(model: LocalizationModel, lost: LostTarget, match: Match) -> float:
    """The log-odds that a match loses by its distance from the target's predicted place."""
    return 0.5 * _distance(model, lost, match) ** 2


def _distance(model: LocalizationModel, lost: LostTarget, match: Match) -> float:
    """The Mahalanobis distance from the target's predicted place; in 3D if depths are known."""
    if lost.position is not None and match.depth is not None:
        return lost.position.distance(*back_project(match.observation, match.target, match.depth))
    sigma = lost.target.side * model.params.lost_position_noise * (1 + lost.missed_frames)
    return math.hypot(match.target.x - lost.target.x, match.target.y - lost.target.y) / sigma
