# SPDX-License-Identifier: MIT
"""Measure a candidate: its size, its depth, what covers it, and its log-odds of being the target."""

from typing import NamedTuple

from tricue.track.fused.experts.depth import DepthMeasurement, measure_depth
from tricue.track.fused.identity import (
    APPEARANCE,
    DEPTH_PICTURE_OFFSET,
    STRUCTURE,
    IdentityFeatures,
    probability,
)
from tricue.track.fused.localize import Candidate, TargetModel, recenter
from tricue.track.fused.outline import Outline, measure_outline
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import INNER_SHARE, Window

OUTER_SIZE = 2.0  # of the box: the surround of depth_continuity
FULL_WEIGHT_SIGMA = 0.25  # meters; a vaguer expected depth counts less in depth_continuity
MAX_GROWTH_PER_FRAME = 1.25  # times


class Match(NamedTuple):
    """A candidate that was measured.

    log_odds, structure_log_odds: of its being the target, by all that is known, and by what light doesn't
    change. response: of the learned filter. covered: the share of its box that an occluder covers.
    """

    target: Target
    observation: TargetObservation
    features: IdentityFeatures
    log_odds: float
    structure_log_odds: float
    response: float
    depth: DepthMeasurement | None
    covered: float
    outline: Outline | None

    @property
    def score(self) -> float:
        """Probability of its being the target."""
        return probability(self.log_odds)


def measure_candidate(model: TargetModel, candidate: Candidate) -> Match:
    """Measure the size and depth of what is at a candidate's place, and its log-odds by appearance."""
    candidate = recenter(model, candidate)
    appearance, p, window = model.appearance, model.params, candidate.window
    observation, offset = window.observation, (candidate.right, candidate.down)
    depth = None
    if model.depth is not None:
        depth = measure_depth(observation, candidate.target, observation.expected_depth)
    predicted = candidate.target.scale(_growth_by_depth(model, candidate, depth))
    growth = appearance.size.growth(observation, predicted) if "size" in p.cues else 1.0
    measured = predicted.scale(growth)
    low, high = (bound * model.first_side / measured.side for bound in p.size_range)
    features = IdentityFeatures(
        peak_sharpness=candidate.peak_sharpness,
        color_similarity=appearance.first_colors.similarity(window, *offset),
        contrast=candidate.contrast,
        first_response=candidate.responses[1],
    )
    covered = covered_share(window, *offset)
    offset_of_kind = DEPTH_PICTURE_OFFSET if observation.kind == "depth" else 0.0
    return Match(
        target=measured.scale(min(max(1.0, low), high)),
        observation=observation,
        features=features,
        log_odds=features.log_odds(model.typical, APPEARANCE) + offset_of_kind,
        structure_log_odds=features.log_odds(model.typical, STRUCTURE),
        response=candidate.responses[0],
        depth=depth,
        covered=covered,
        outline=measure_outline(window, *offset, covered),
    )


def covered_share(window: Window, right: float = 0.0, down: float = 0.0) -> float:
    """The share of a target's box, so many patch pixels off the window's center, that an occluder covers."""
    if window.depth is None:
        return 0.0
    return float(window.depth[1][window.inner(right, down, INNER_SHARE)].mean())


def depth_continuity(candidate: Candidate) -> float:
    """How far a candidate stands apart at the expected depth, in [0, 1].

    Mean P(target | depth) in its box less that around it, less where the expectation is vague; 0 without
    depth.
    """
    window = candidate.window
    expected = window.observation.expected_depth
    if window.depth is None or expected is None:
        return 0.0
    inner, outer = (
        window.depth[0][window.inner(candidate.right, candidate.down, share)]
        for share in (INNER_SHARE, OUTER_SIZE)
    )
    inside, outside = float(inner.sum()), float(outer.sum()) - float(inner.sum())
    contrast = inside / inner.size - outside / max(outer.size - inner.size, 1)
    return max(contrast, 0.0) * min(FULL_WEIGHT_SIGMA / expected.sigma, 1.0) ** 2


def _growth_by_depth(model: TargetModel, candidate: Candidate, depth: DepthMeasurement | None) -> float:
    """The ratio of the target's size to the last one, by its depth; 1 without."""
    if depth is None or model.depth is None:
        return 1.0
    growth = model.depth.length / (depth.z * candidate.target.side)
    return min(max(growth, 1 / MAX_GROWTH_PER_FRAME), MAX_GROWTH_PER_FRAME)
