# SPDX-License-Identifier: MIT
"""Search for the target around its last place."""

from tricue.track.fused.experts.depth import covered_share, depth_continuity
from tricue.track.fused.identity import in_any_light
from tricue.track.fused.localize import Candidate, LocalizationModel, localize
from tricue.track.fused.measure import Match, measure_candidate
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target
from tricue.track.fused.window import Window, extract_window, extract_windows

NEIGHBORS = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]  # in half windows


def search_local(
    model: LocalizationModel, observation: PictureObservation, last: Target, mean_response: float
) -> Match:
    """Search where a followed target should be, and also around that if the filter responds weakly there.

    mean_response: running mean of the filter's response on the target.
    """
    p = model.params
    window = extract_window(observation, last, p.context)
    candidate = localize(model, window)
    if candidate.response < p.min_response_share * mean_response:
        neighbors = _neighboring_windows(observation, last, p.context)
        candidates = [_localize_beside(model, each, last) for each in neighbors]
        candidate = max([candidate, *candidates], key=lambda each: each.evidence)
    continuity = depth_continuity(candidate.window, candidate.right, candidate.down)
    return _measure_near(model, candidate, window, p.depth_continuity_weight * continuity)


def search_last_place(model: LocalizationModel, observation: PictureObservation, last: Target) -> Match:
    """Search for a missed target at its last place; :func:`redetect` searches the rest of the frame."""
    window = extract_window(observation, last, model.params.context)
    return _measure_near(model, localize(model, window), window, 0.0)


def _measure_near(model: LocalizationModel, candidate: Candidate, last: Window, bonus: float) -> Match:
    """A measured candidate, with a bonus added to its log-odds; last: the window around the last place."""
    match = measure_candidate(model, candidate)
    log_odds = match.log_odds + bonus
    if match.observation.kind == "color":
        log_odds = in_any_light(log_odds, match.structure_log_odds)
    return match._replace(log_odds=log_odds, covered=max(match.covered, covered_share(last)))


def _localize_beside(model: LocalizationModel, window: Window, last: Target) -> Candidate:
    """The best place in a neighboring window, its evidence reduced by the window's distance."""
    half = model.params.context * last.side / 2
    squared = (window.target.x - last.x) ** 2 + (window.target.y - last.y) ** 2
    candidate = localize(model, window)
    penalty = model.params.distance_penalty * squared / half**2
    return candidate._replace(evidence=candidate.evidence - penalty)


def _neighboring_windows(observation: PictureObservation, target: Target, context: float) -> list[Window]:
    """The eight windows around a target's own, each half a window away."""
    half = context * target.side / 2
    return extract_windows(observation, [target.shift(i * half, j * half) for i, j in NEIGHBORS], context)
