# SPDX-License-Identifier: MIT
"""Measure a candidate: its size, its depth, what covers it, and its log-odds of being the target."""

from typing import NamedTuple

from tricue.track.fused.experts import size
from tricue.track.fused.experts.depth import DepthMeasurement, measure_depth
from tricue.track.fused.experts.flow import FlowPatch, measure_growth
from tricue.track.fused.experts.size import ScaleSamples
from tricue.track.fused.identity import IdentityFeatures, probability
from tricue.track.fused.localize import Candidate, TargetModel, peak_offset, recenter
from tricue.track.fused.outline import Outline, measure_outline
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import INNER_SHARE, PATCH_PIXELS, Window

OUTER_SIZE = 2.0  # of the box: the surround of depth_continuity
FULL_WEIGHT_SIGMA = 0.25  # meters; a vaguer expected depth counts less in depth_continuity
MAX_GROWTH_PER_FRAME = 1.25  # times


class Match(NamedTuple):
    """A candidate that was measured.

    appearance_log_odds, log_odds: of its being the target by its appearance, and by all that is known.
    response: of the learned filter. covered: the share of its box that an occluder covers.
    """

    target: Target
    observation: TargetObservation
    features: IdentityFeatures
    appearance_log_odds: float
    log_odds: float
    response: float
    depth: DepthMeasurement | None
    covered: float
    flow_patch: FlowPatch | None
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
    flow_patch = FlowPatch.cut(window, *offset) if "flow" in p.cues else None
    growth = _predict_growth(model, candidate, depth, flow_patch)
    predicted = candidate.target.scale(growth)
    samples = size.sample_scales(observation, predicted, appearance.color.table, p)
    step, factor = _measure_scale(model, candidate, samples, growth)
    low, high = (bound * model.first_side / candidate.target.side for bound in p.size_range)
    features = IdentityFeatures(
        peak_sharpness=candidate.peak_sharpness,
        rank_distance=appearance.identity.rank_distance(samples.ranks[step]),
        color_similarity=appearance.identity.color_similarity(window, *offset),
        contrast=candidate.contrast,
        first_response=candidate.responses[1],
    )
    covered = covered_share(window, *offset)
    log_odds = features.log_odds(_calibration_key(model, window))
    return Match(
        target=candidate.target.scale(min(max(factor, low), high)),
        observation=observation,
        features=features,
        appearance_log_odds=log_odds,
        log_odds=log_odds,
        response=candidate.responses[0],
        depth=depth,
        covered=covered,
        flow_patch=flow_patch,
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


def _predict_growth(
    model: TargetModel, candidate: Candidate, depth: DepthMeasurement | None, flow_patch: FlowPatch | None
) -> float:
    """The ratio of the target's size to the last one, by its depth, or else by the flow of its pixels."""
    if depth is not None and model.depth is not None:
        growth = model.depth.length / (depth.z * candidate.target.side)
    elif model.flow_patch is not None and flow_patch is not None:
        growth = measure_growth(model.flow_patch, flow_patch, candidate.window) or 1.0
    else:
        return 1.0
    return min(max(growth, 1 / MAX_GROWTH_PER_FRAME), MAX_GROWTH_PER_FRAME)


def _measure_scale(
    model: TargetModel, candidate: Candidate, samples: ScaleSamples, growth: float
) -> tuple[int, float]:
    """The step of scale with most evidence, and the ratio of the size there to the last one."""
    appearance, p, k = model.appearance, model.params, candidate.window.observation.k
    evidence = size.scale_steps(p).prior
    if "ranks" in p.cues:
        evidence = evidence + p.rank_weight * appearance.size.response(k, samples)
    if "edges" in p.cues and candidate.posterior is not None:
        center = PATCH_PIXELS / 2 + candidate.right, PATCH_PIXELS / 2 + candidate.down
        width, height = (growth * each for each in candidate.window.size)
        level = appearance.edge_level
        edges = size.edge_evidence(k, candidate.posterior, center, (width, height), p, level)
        evidence = evidence + p.edge_weight * edges
    best = int(evidence.argmax())
    return best, growth * p.scale_step ** (best - p.scales // 2 + peak_offset(evidence, best))


def _calibration_key(model: TargetModel, window: Window) -> str:
    if window.observation.kind == "depth":
        return "depth"
    return "color" if model.depth is None or window.depth is None else "both"
