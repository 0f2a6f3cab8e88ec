# SPDX-License-Identifier: MIT
"""Measure a candidate: its size, its depth, the covered share, and its log-odds of being the target."""

from typing import NamedTuple

from tricue.track.fused.experts.depth import DepthMeasurement, covered_share, measure_depth
from tricue.track.fused.identity import (
    APPEARANCE,
    DEPTH_PICTURE_OFFSET,
    STRUCTURE,
    score_of,
)
from tricue.track.fused.localize import Candidate, LocalizationModel, recenter
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target


class Recognition(NamedTuple):
    """A candidate, and its log-odds of being the target.

    log_odds: from the whole appearance. structure_log_odds: from the structure, which light doesn't change.
    """

    candidate: Candidate
    log_odds: float
    structure_log_odds: float


class Match(NamedTuple):
    """A candidate that was measured.

    target: its place, with the size and turn measured there. log_odds, structure_log_odds: of being the
    target, from all evidence, and from the structure, which light doesn't change. covered: the share of its
    box that an occluder covers. best_seen: log-odds of the best match in a search of the whole frame; None
    without such a search.
    """

    candidate: Candidate
    target: Target
    log_odds: float
    structure_log_odds: float
    depth: DepthMeasurement | None
    covered: float
    best_seen: float | None = None

    @property
    def observation(self) -> PictureObservation:
        """The frame, with the depth at which the target was expected there."""
        return self.candidate.window.observation

    @property
    def score(self) -> float:
        """The probability that this is the target, for a target that is followed."""
        return score_of(self.log_odds)


def measure_candidate(model: LocalizationModel, candidate: Candidate) -> Match:
    """Recognize a candidate, and measure its size and depth."""
    return measure(model, recognize(model, candidate))


def recognize(model: LocalizationModel, candidate: Candidate) -> Recognition:
    """The candidate, recentered, and its log-odds by appearance."""
    candidate = recenter(model, candidate)
    features = candidate.features
    offset_of_kind = DEPTH_PICTURE_OFFSET if candidate.window.observation.kind == "depth" else 0.0
    return Recognition(
        candidate,
        log_odds=features.log_odds(model.typical, APPEARANCE) + offset_of_kind,
        structure_log_odds=features.log_odds(model.typical, STRUCTURE),
    )


def measure(model: LocalizationModel, recognition: Recognition) -> Match:
    """Measure the size and depth of a recognized candidate."""
    candidate, p = recognition.candidate, model.params
    observation = candidate.window.observation
    depth, predicted = None, candidate.target
    if model.depth is not None:
        depth = measure_depth(observation, candidate.target, observation.expected_depth)
        if depth is not None:
            predicted = predicted.scale(model.depth.growth(depth, predicted.side))
    growth = model.appearance.size.growth(observation, predicted) if "size" in p.cues else 1.0
    measured = predicted.scale(growth)
    recognized = score_of(recognition.log_odds) >= p.min_score
    if "turn" in p.cues and observation.depth_source is None and recognized:
        measured = measured.turn_by(model.appearance.turn.turn(observation, predicted))
    return Match(
        candidate,
        target=measured.scale(model.limit_growth(1.0, measured)),
        log_odds=recognition.log_odds,
        structure_log_odds=recognition.structure_log_odds,
        depth=depth,
        covered=covered_share(candidate.window, candidate.right, candidate.down),
    )
