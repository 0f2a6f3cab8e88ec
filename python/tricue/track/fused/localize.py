# SPDX-License-Identifier: MIT
"""Localize: the place in a window with the most evidence for the target."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Plane
from tricue.track.fused.experts.depth import DepthExpert
from tricue.track.fused.identity import IdentityFeatures
from tricue.track.fused.models import AppearanceModels
from tricue.track.fused.params import FusedParams
from tricue.track.fused.target import Target
from tricue.track.fused.window import CELL_PIXELS, HANN_WINDOW, INNER_SHARE, Window, extract_window

NO_TABLE: Plane = np.empty((0, 0, 0), np.float32)  # without the cue "color"
MAX_PEAK_CELLS = 6  # from a window's center; a peak farther off is localized again in a window around it


class LocalizationModel(NamedTuple):
    """The models and parameters with which the target is searched for.

    first_side: pixels, of the first box. typical: running means of the target's features; None until it is
    recognized after the first frame.
    """

    appearance: AppearanceModels
    depth: DepthExpert | None
    first_side: float
    typical: IdentityFeatures | None
    params: FusedParams

    def limit_growth(self, growth: float, target: Target) -> float:
        """A target's growth, limited so that its size stays within ``size_range``."""
        low, high = (bound * self.first_side / target.side for bound in self.params.size_range)
        return min(max(growth, low), high)


class Candidate(NamedTuple):
    """A place that may be the target's.

    right, down: patch pixels from the window's center. evidence: what the place was chosen by. response: of
    the learned filter there. first_responses: (32, 32) responses of the first frame's filter in the window.
    """

    target: Target
    window: Window
    right: float
    down: float
    evidence: float
    response: float
    first_responses: Plane
    features: IdentityFeatures


def localize(model: LocalizationModel, window: Window) -> Candidate:
    """The place in a window with the most evidence, to a fraction of a cell."""
    appearance, p = model.appearance, model.params
    table = appearance.color.table if "color" in p.cues else NO_TABLE
    filter_weight = p.filter_weight if "filter" in p.cues else 0.0
    found, responses = window.observation.k.localize_target(
        window.patch,
        HANN_WINDOW,
        (appearance.filter.applied, table, appearance.first_colors.roots),
        window.depth_posterior,
        (*window.size, p.surround_size, p.surround_weight, filter_weight, p.color_weight, INNER_SHARE),
    )
    right, down, evidence, response, contrast, _, first_response, sharpness, similarity = found.tolist()
    cell = CELL_PIXELS * window.pixel_size
    return Candidate(
        clamp_to_image(window.target.shift(*window.target.along(cell * right, cell * down)), window),
        window,
        CELL_PIXELS * right,
        CELL_PIXELS * down,
        evidence,
        response,
        responses[1],
        IdentityFeatures(sharpness, similarity, contrast, first_response),
    )


def recenter(model: LocalizationModel, candidate: Candidate) -> Candidate:
    """The candidate, localized again in a window around it if it is near its window's edge."""
    if not is_near_edge(candidate.right, candidate.down):
        return candidate
    observation = candidate.window.observation
    return localize(model, extract_window(observation, candidate.target, model.params.context))


def is_near_edge(right: float, down: float) -> bool:
    """Whether a place, in patch pixels from a window's center, is too near the edge to be measured there."""
    return max(abs(right), abs(down)) > CELL_PIXELS * MAX_PEAK_CELLS


def clamp_to_image(target: Target, window: Window) -> Target:
    """The target with its center moved into the window's image."""
    height, width = window.observation.shape
    return target.at(min(max(target.x, 0.0), width), min(max(target.y, 0.0), height))
