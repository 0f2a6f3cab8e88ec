# SPDX-License-Identifier: MIT
"""Localize: the place in a window with most evidence for the target."""

import math
from typing import NamedTuple

import numpy as np

from tricue.track.fused.arrays import Plane
from tricue.track.fused.experts import PixelExpert, combine_posteriors
from tricue.track.fused.experts.depth import DepthExpert
from tricue.track.fused.identity import IdentityFeatures
from tricue.track.fused.params import FusedParams
from tricue.track.fused.state import AppearanceModels
from tricue.track.fused.target import Target
from tricue.track.fused.window import CELL_PIXELS, Window, extract_windows

NO_CONTRAST: Plane = np.empty((0, 0), np.float32)
MAX_PEAK_CELLS = 6  # from a window's center; a peak farther off is localized again in a window of its own


class TargetModel(NamedTuple):
    """All that the target is searched by.

    typical: features of it in the last frames, None after the first.
    """

    appearance: AppearanceModels
    depth: DepthExpert | None
    first_side: float
    typical: IdentityFeatures | None
    params: FusedParams

    def limit_growth(self, growth: float, target: Target) -> float:
        """The growth of a target, or the nearest that leaves its size within ``size_range``."""
        low, high = (bound * self.first_side / target.side for bound in self.params.size_range)
        return min(max(growth, low), high)


class Candidate(NamedTuple):
    """A place that may be the target's.

    right, down: patch pixels from the window's center. evidence: what it was chosen by. responses: of the
    learned and of the first frame's filter there. first_responses: (32, 32) of the latter in the window.
    posterior: (64, 64) P(target | pixel), None without such experts.
    """

    target: Target
    window: Window
    right: float
    down: float
    evidence: float
    responses: tuple[float, float]
    first_responses: Plane
    peak_sharpness: float
    contrast: float
    posterior: Plane | None


def localize(model: TargetModel, window: Window) -> Candidate:
    """The place in a window with most evidence, to a part of a cell."""
    appearance, p = model.appearance, model.params
    k, responses = window.observation.k, appearance.filter.responses(window)
    posterior = combine_posteriors(k, [each.posterior(window) for each in _pixel_experts(model)])
    contrast = NO_CONTRAST
    if posterior is not None:
        contrast = k.box_contrast(posterior, *window.size, p.surround_size, p.surround_weight)
    filter_weight = p.filter_weight if "filter" in p.cues else 0.0
    peak = k.evidence_peak(responses, contrast, filter_weight, p.color_weight)
    right, down, evidence, response, contrast_there, nearby, first_nearby = peak.tolist()
    cell = CELL_PIXELS * window.pixel_size
    target = clamp_to_image(window.target.shift(cell * right, cell * down), window)
    return Candidate(
        target,
        window,
        CELL_PIXELS * right,
        CELL_PIXELS * down,
        evidence,
        (response, first_nearby),
        responses[1],
        _peak_sharpness(responses[0], nearby),
        contrast_there,
        posterior,
    )


def recenter(model: TargetModel, candidate: Candidate) -> Candidate:
    """The candidate itself, or localized again in a window around it, if it was near its window's edge."""
    if max(abs(candidate.right), abs(candidate.down)) <= CELL_PIXELS * MAX_PEAK_CELLS:
        return candidate
    observation = candidate.window.observation
    return localize(model, extract_windows(observation, [candidate.target], model.params.context)[0])


def _pixel_experts(model: TargetModel) -> list[PixelExpert]:
    experts: list[PixelExpert] = [model.appearance.color] if "color" in model.params.cues else []
    return [*experts, model.depth] if model.depth is not None else experts


def clamp_to_image(target: Target, window: Window) -> Target:
    """The target with its center moved into the window's image."""
    height, width = window.observation.shape
    x, y = min(max(target.x, 0.0), width), min(max(target.y, 0.0), height)
    return Target(x, y, target.width, target.height)


def _peak_sharpness(response: Plane, peak: float) -> float:
    """Standard deviations by which a response's peak stands above its mean."""
    mean = float(response.sum()) / response.size
    power = float(np.vdot(response, response)) / response.size
    return (peak - mean) / max(math.sqrt(max(power - mean * mean, 0.0)), 1e-6)
