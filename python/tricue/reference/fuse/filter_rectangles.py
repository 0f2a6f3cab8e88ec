# SPDX-License-Identifier: MIT
"""A step of the particle filter over rectangles in front of a depth camera (Sabeti, Parvizi, Wu 2008)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.cues.depth.depth_contrast import depth_contrast
from tricue.reference.cues.depth.depth_distance import depth_distance
from tricue.reference.cues.depth.rectangle_histogram import rectangle_histogram
from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.rectangle_prior import rectangle_prior
from tricue.reference.fuse.resample import resample
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize

NUMBERS = 5  # in a state
MIN_LIKELIHOOD = 1e-12


def filter_rectangles(
    depth: NDArray[np.float32],
    camera: Floats,
    particles: Floats,
    weights: Floats,
    offset: float,
    noise: Floats,
    dynamics: tuple[Floats, Floats],
    bounds: tuple[Floats, Floats],
    detection: tuple[Floats, Floats, float],
    refinement: tuple[Floats, float],
    model: Floats,
    levels: tuple[float, float],
    grid: tuple[int, int],
    ring: tuple[float, int],
    reach: float,
    occluder_margin: float,
    likelihood: tuple[bool, float, float],
    mean_size: tuple[Floats, Floats],
    measured: tuple[Floats, Floats, float],
) -> tuple[Floats, Floats, Floats, Floats, Floats, Floats]:
    """Calls one twin after the other, for one or two rounds of sampling."""
    _require(particles, weights, noise, refinement, levels, likelihood)
    view = _View(depth, camera, model, levels, grid, ring, reach, occluder_margin)

    (drift, scale), (seen, root, share), (state, deviation, max_cost) = dynamics, detection, measured

    def log_likelihood(states: Floats) -> Floats:
        prior = rectangle_prior(states, *mean_size, state, deviation, max_cost)
        return np.asarray(view.log_likelihood(states, *likelihood) + prior)

    previous = particles[resample(weights, offset)]
    states = propose(previous, drift, scale, noise[0], seen, root, share, *bounds)
    weights, _ = reweight(log_likelihood(states), states, previous, drift, scale, seen, root, share)
    mean, covariance, _ = summarize(states, weights)
    if len(noise) > 1:
        states = _draw_around(mean, *refinement, bounds[0][2], noise[1])
        weights = _normalized(log_likelihood(states))
        mean, covariance, _ = summarize(states, weights)
    return states, weights, mean, covariance, view.measure(mean[None])[0], view.histogram(mean)


class _View(NamedTuple):
    """A depth image and how rectangles are measured in it; the fields are the arguments with these names."""

    depth: NDArray[np.float32]
    camera: Floats
    model: Floats
    levels: tuple[float, float]
    grid: tuple[int, int]
    ring: tuple[float, int]
    reach: float
    occluder_margin: float

    def measure(self, states: Floats) -> Floats:
        """(N, 4) as by depth_contrast, but with the distance to the model in the model's own levels."""
        span, occluder_margin = self.levels[1], self.occluder_margin
        is_one_range = self.levels == (0, self.reach)
        model = self.model if is_one_range else np.zeros(1)
        seen = depth_contrast(self.depth, self.camera, states, model, *self[4:])
        if not is_one_range:
            places = _grid(*self.grid)
            each = depth_distance(
                self.depth, self._in_pixels(states), self.model, places, span, occluder_margin
            )
            seen[:, 0] = each[:, 0]
        return seen

    def log_likelihood(self, states: Floats, linear: bool, sharpness: float, contrast: float) -> Floats:
        """(N,) log-likelihoods of the depths in and around the rectangles."""
        distance, inside, _, around = self.measure(states).T
        likeness = -sharpness * distance * distance
        if linear:
            likeness = np.log(np.maximum(1 - distance, MIN_LIKELIHOOD))
        logs: Floats = likeness + contrast * (inside - around)
        return logs

    def histogram(self, state: Floats) -> Floats:
        """(L,) histogram of the depths inside one rectangle."""
        rectangle, levels = self._in_pixels(state[None])[0], len(self.model)
        return rectangle_histogram(self.depth, rectangle, levels, _grid(*self.grid), self.levels[1])

    def _in_pixels(self, states: Floats) -> Floats:
        """(N, 5): center x, y, width, height, pixels, and the depth to which the model is relative."""
        (fx, fy, cx, cy), (x, y, z, width, height) = self.camera, states.T
        per_x, per_y, middle = fx / z, fy / z, self.levels[0]
        near = z if middle == 0 else np.full_like(z, middle)
        return np.column_stack(
            [x * per_x + (cx + 0.5), y * per_y + (cy + 0.5), width * per_x, height * per_y, near]
        )


def _draw_around(mean: Floats, scale: Floats, least: float, nearest: float, noise: Floats) -> Floats:
    states = mean + scale * noise
    states[:, 2] = np.maximum(states[:, 2], nearest)
    states[:, 3:] = np.maximum(states[:, 3:], least)
    return states


def _normalized(log_weights: Floats) -> Floats:
    """Normalized weights: reweight without a detection leaves the likelihoods unchanged."""
    states = np.zeros((len(log_weights), 1))
    one = np.ones(1)
    return reweight(log_weights, states, states, one, one, one, np.eye(1), 0.0)[0]


def _grid(rows: int, columns: int) -> Floats:
    middles = [(2 * np.arange(n) + 1) / n - 1 for n in (rows, columns)]
    v, u = np.meshgrid(*middles, indexing="ij")
    return np.column_stack([u.ravel(), v.ravel()])


def _require(
    particles: Floats,
    weights: Floats,
    noise: Floats,
    refinement: tuple[Floats, float],
    levels: tuple[float, float],
    likelihood: tuple[bool, float, float],
) -> None:
    require_shape("particles", particles, (len(weights), NUMBERS))
    require_finite("particles", particles)
    if not 1 <= len(noise) <= 2:
        refuse("noise", "1 to 2", len(noise))
    for each in noise:
        require_shape("noise", each, (len(particles), NUMBERS))
        require_finite("noise", each)
    scale, least = refinement
    require_shape("scale", scale, (NUMBERS,))
    require_finite("scale", scale)
    if np.any(scale < 0):
        refuse("scale", "no negative number", float(scale.min()))
    if not 0 < least < np.inf:
        refuse("least", "a finite number above 0", float(least))
    if not 0 <= levels[0] < np.inf:
        refuse("middle", "a finite number, not negative", float(levels[0]))
    for name, number in zip(("sharpness", "contrast"), likelihood[1:], strict=True):
        if not np.isfinite(number):
            refuse(name, "a finite number", float(number))
