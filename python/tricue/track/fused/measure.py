# SPDX-License-Identifier: MIT
"""Measure a candidate: its size, its depth, what covers it, and its log-odds of being the target."""

from typing import NamedTuple

from tricue.track.fused.experts.depth import DepthMeasurement, covered_share, measure_depth
from tricue.track.fused.identity import (
    APPEARANCE,
    DEPTH_PICTURE_OFFSET,
    STRUCTURE,
    IdentityFeatures,
    probability,
)
from tricue.track.fused.localize import Candidate, TargetModel, recenter
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import Window


class Match(NamedTuple):
    """A candidate that was measured.

    window, right, down: where it was measured, so many patch pixels off the window's center.
    log_odds, structure_log_odds: of its being the target, by all that is known, and by what light doesn't
    change. response: of the learned filter. covered: the share of its box that an occluder covers.
    """

    target: Target
    window: Window
    right: float
    down: float
    features: IdentityFeatures
    log_odds: float
    structure_log_odds: float
    response: float
    depth: DepthMeasurement | None
    covered: float

    @property
    def observation(self) -> TargetObservation:
        """The frame, given the depth at which the target was expected there."""
        return self.window.observation

    @property
    def score(self) -> float:
        """Probability of its being the target."""
        return probability(self.log_odds)


def measure_candidate(model: TargetModel, candidate: Candidate) -> Match:
    """Measure the size and depth of what is at a candidate's place, and its log-odds by appearance."""
    candidate = recenter(model, candidate)
    appearance, p, window = model.appearance, model.params, candidate.window
    observation, offset = window.observation, (candidate.right, candidate.down)
    depth, predicted = None, candidate.target
    if model.depth is not None:
        depth = measure_depth(observation, candidate.target, observation.expected_depth)
        if depth is not None:
            predicted = predicted.scale(model.depth.growth(depth, predicted.side))
    growth = appearance.size.growth(observation, predicted) if "size" in p.cues else 1.0
    measured = predicted.scale(growth)
    features = IdentityFeatures(
        peak_sharpness=candidate.peak_sharpness,
        color_similarity=appearance.first_colors.similarity(window, *offset),
        contrast=candidate.contrast,
        first_response=candidate.responses[1],
    )
    offset_of_kind = DEPTH_PICTURE_OFFSET if observation.kind == "depth" else 0.0
    return Match(
        target=measured.scale(model.limit_growth(1.0, measured)),
        window=window,
        right=candidate.right,
        down=candidate.down,
        features=features,
        log_odds=features.log_odds(model.typical, APPEARANCE) + offset_of_kind,
        structure_log_odds=features.log_odds(model.typical, STRUCTURE),
        response=candidate.responses[0],
        depth=depth,
        covered=covered_share(window, *offset),
    )
