# SPDX-License-Identifier: MIT
"""The target's depth histogram, (37), (38), and the likelihood of a rectangle."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.projection import project_rectangle
from tricue.track.depth_particle.params import DepthParticleParams

Floats = NDArray[np.float64]

SURROUND_SAMPLES = 12  # at each side of a rectangle
NO_HISTOGRAM = np.zeros(1)
MIN_LIKELIHOOD = 1e-12  # in the logarithm of the linear likelihood


class DepthObservation(NamedTuple):
    """Of one rectangle.

    log_likelihood: as :meth:`DepthModel.log_likelihood`. inside: the share of the samples inside that are at
    the target's depth. contrast: that share less the same around the rectangle. front: the share of the
    samples inside that are in front of the target.
    """

    log_likelihood: float
    inside: float
    contrast: float
    front: float


class DepthModel(NamedTuple):
    """The depth histogram of the target, relative to its own depth or absolute, sampled on a grid."""

    p: DepthParticleParams
    grid: Floats
    histogram: Floats

    @classmethod
    def empty(cls, p: DepthParticleParams) -> "DepthModel":
        """A model that has learned nothing yet."""
        return cls(p, grid(*p.grid), np.zeros(p.bins if p.histogram == "relative" else p.levels))

    def log_likelihood(self, k: Kernels, fg: Foreground, states: Floats) -> Floats:
        """(N,) nats of the foreground in and around the rectangles of states (N, 5): (37), or its exponential
        form, times the contrast term.
        """
        return self._log_likelihood(k, fg, states, self._measure(k, fg, states))

    def observe(self, k: Kernels, fg: Foreground, state: Floats) -> DepthObservation:
        """Compare the foreground in and around the rectangle of a state (5,) with the model."""
        states = state[None]
        measured = self._measure(k, fg, states)
        log_likelihood = self._log_likelihood(k, fg, states, measured).item()
        _, inside, front, around = measured[0].tolist()
        return DepthObservation(log_likelihood, inside, inside - around, front)

    def distance(self, k: Kernels, fg: Foreground, states: Floats) -> Floats:
        """(N,) the distance (38) of the histograms in the rectangles of states (N, 5), in [0, 1]."""
        if self.p.histogram == "absolute":
            return self._absolute_distance(k, fg, states)
        distance: Floats = self._measure(k, fg, states)[:, 0]
        return distance

    def _measure(self, k: Kernels, fg: Foreground, states: Floats) -> Floats:
        """(N, 4) as the kernel depth_contrast returns it; without distance for an absolute histogram."""
        p = self.p
        relative = self.histogram if p.histogram == "relative" else NO_HISTOGRAM
        ring = (p.margin, SURROUND_SAMPLES)
        reach, margin = p.histogram_reach, p.occluder_margin
        measured: Floats = k.depth_contrast(
            fg.depth, fg.camera, states, relative, p.grid, ring, reach, margin
        )
        return measured

    def _log_likelihood(self, k: Kernels, fg: Foreground, states: Floats, measured: Floats) -> Floats:
        p, (distance, inside, _, around) = self.p, measured.T
        if p.histogram == "absolute":
            distance = self._absolute_distance(k, fg, states)
        if p.likelihood == "linear":
            likeness = np.log(np.maximum(1 - distance, MIN_LIKELIHOOD))
        else:
            likeness = -p.sharpness * distance * distance
        log_likelihood: Floats = likeness + p.contrast * (inside - around)
        return log_likelihood

    def learn(self, k: Kernels, fg: Foreground, state: Floats, rate: float) -> "DepthModel":
        """Blend in the histogram of one rectangle, state (5,); the first one is taken as it is."""
        rectangle, reach = self._rectangles(fg, state[None])
        new = k.rectangle_histogram(fg.depth, rectangle[0], len(self.histogram), self.grid, reach)
        if not np.count_nonzero(new):
            return self
        old = self.histogram
        known = bool(np.count_nonzero(old))
        return DepthModel(self.p, self.grid, old + rate * (new - old) if known else new)

    def _absolute_distance(self, k: Kernels, fg: Foreground, states: Floats) -> Floats:
        rectangles, reach = self._rectangles(fg, states)
        margin = self.p.occluder_margin
        measured = k.depth_distance(fg.depth, rectangles, self.histogram, self.grid, reach, margin)
        distance: Floats = measured[:, 0]
        return distance

    def _rectangles(self, fg: Foreground, states: Floats) -> tuple[Floats, float]:
        """(N, 5) rectangles in pixels, and half the histogram's range around their depths, meters.

        An absolute histogram is one relative to the middle of the camera's range.
        """
        rectangles = np.array([project_rectangle(state, fg.camera) for state in states])
        if self.p.histogram == "relative":
            return rectangles, self.p.histogram_reach
        rectangles[:, 4] = (self.p.near + self.p.far) / 2
        return rectangles, (self.p.far - self.p.near) / 2
