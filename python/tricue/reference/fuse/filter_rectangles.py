# SPDX-License-Identifier: MIT
"""A step of the particle filter over rectangles in front of a depth camera (Sabeti, Parvizi, Wu 2008)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import Detection, Dynamics, refuse, require_finite, require_shape
from tricue.reference.cues.depth.depth_contrast import RectanglePattern, depth_contrast, grid_pattern
from tricue.reference.cues.depth.depth_distance import depth_distance
from tricue.reference.cues.depth.rectangle_histogram import rectangle_histogram
from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.rectangle_prior import MeanSize, MeasuredState, rectangle_prior
from tricue.reference.fuse.resample import resample
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize

NUMBERS = 5  # in a state
MIN_LIKELIHOOD = 1e-12

Likelihood = tuple[Floats, float, float, RectanglePattern, float, float, bool, float, float]


def filter_rectangles(
    depth: NDArray[np.float32],
    camera: Floats,
    before: tuple[Floats, Floats, float],
    noise: Floats,
    dynamics: Dynamics,
    bounds: tuple[Floats, Floats],
    detection: Detection,
    refinement: tuple[Floats, float],
    likelihood: Likelihood,
    prior: tuple[MeanSize, MeasuredState],
) -> tuple[Floats, Floats, Floats, Floats, Floats, Floats]:
    """Calls one twin after the other, for one or two rounds of sampling."""
    by = _Likelihood(*likelihood)
    _require(before, noise, refinement, by)
    view = _View(depth, camera, by)
    particles, weights, offset = before

    def log_likelihood(states: Floats) -> Floats:
        return np.asarray(view.log_likelihood(states) + rectangle_prior(states, *prior))

    previous = particles[resample(weights, offset)]
    states = propose(previous, dynamics, noise[0], detection, bounds)
    weights, _ = reweight(log_likelihood(states), states, previous, dynamics, detection)
    mean, covariance, _ = summarize(states, weights)
    if len(noise) > 1:
        states = _draw_around(mean, *refinement, bounds[0][2], noise[1])
        weights = _normalized(log_likelihood(states))
        mean, covariance, _ = summarize(states, weights)
    return states, weights, mean, covariance, view.measure(mean[None])[0], view.histogram(mean)


class _Likelihood(NamedTuple):
    """How depths give a likelihood: the fields of the argument."""

    model: Floats
    middle: float
    span: float
    places: RectanglePattern
    reach: float
    occluder_margin: float
    linear: bool
    sharpness: float
    contrast: float


class _View(NamedTuple):
    """A depth image, and how rectangles are measured in it."""

    depth: NDArray[np.float32]
    camera: Floats
    by: _Likelihood

    def measure(self, states: Floats) -> Floats:
        """(N, 4) as by depth_contrast, but with the distance to the model in the model's own levels."""
        by = self.by
        is_one_range = by.middle == 0 and by.span == by.reach
        model = by.model if is_one_range else np.zeros(1), by.reach
        seen = depth_contrast(self.depth, self.camera, states, model, by.places, by.occluder_margin)
        if not is_one_range:
            rectangles, places = self._in_pixels(states), grid_pattern(*by.places[:2])
            model = by.model, by.span
            each = depth_distance(self.depth, rectangles, model, places, by.occluder_margin)
            seen[:, 0] = each[:, 0]
        return seen

    def log_likelihood(self, states: Floats) -> Floats:
        """(N,) log-likelihoods of the depths in and around the rectangles."""
        distance, inside, _, around = self.measure(states).T
        likeness = -self.by.sharpness * distance * distance
        if self.by.linear:
            likeness = np.log(np.maximum(1 - distance, MIN_LIKELIHOOD))
        logs: Floats = likeness + self.by.contrast * (inside - around)
        return logs

    def histogram(self, state: Floats) -> Floats:
        """(L,) histogram of the depths inside one rectangle."""
        by, rectangle = self.by, self._in_pixels(state[None])[0]
        return rectangle_histogram(
            self.depth, rectangle, len(by.model), grid_pattern(*by.places[:2]), by.span
        )

    def _in_pixels(self, states: Floats) -> Floats:
        """(N, 5): center x, y, width, height, pixels, and the depth to which the model is relative."""
        (fx, fy, cx, cy), (x, y, z, width, height) = self.camera, states.T
        per_x, per_y, middle = fx / z, fy / z, self.by.middle
        near = z if middle == 0 else np.full_like(z, middle)
        return np.column_stack(
            [x * per_x + (cx + 0.5), y * per_y + (cy + 0.5), width * per_x, height * per_y, near]
        )


def _draw_around(mean: Floats, scale: Floats, min_size: float, nearest: float, noise: Floats) -> Floats:
    states = mean + scale * noise
    states[:, 2] = np.maximum(states[:, 2], nearest)
    states[:, 3:] = np.maximum(states[:, 3:], min_size)
    return states


def _normalized(log_weights: Floats) -> Floats:
    """Normalized weights: reweight without a detection leaves the likelihoods unchanged."""
    states = np.zeros((len(log_weights), 1))
    one = np.ones(1)
    return reweight(log_weights, states, states, (one, one), (one, np.eye(1), 0.0))[0]


def _require(
    before: tuple[Floats, Floats, float], noise: Floats, refinement: tuple[Floats, float], by: _Likelihood
) -> None:
    particles, weights, _ = before
    require_shape("particles", particles, (len(weights), NUMBERS))
    require_finite("particles", particles)
    if not 1 <= len(noise) <= 2:
        refuse("noise", "1 to 2", len(noise))
    for each in noise:
        require_shape("noise", each, (len(particles), NUMBERS))
        require_finite("noise", each)
    scale, min_size = refinement
    require_shape("scale", scale, (NUMBERS,))
    require_finite("scale", scale)
    if np.any(scale < 0):
        refuse("scale", "no negative number", float(scale.min()))
    if not 0 < min_size < np.inf:
        refuse("min_size", "a finite number above 0", float(min_size))
    if not 0 <= by.middle < np.inf:
        refuse("middle", "a finite number, not negative", float(by.middle))
    for name, number in (("sharpness", by.sharpness), ("contrast", by.contrast)):
        if not np.isfinite(number):
            refuse(name, "a finite number", float(number))
