# SPDX-License-Identifier: MIT
"""What a target looks like in depth, (37), (38), and how likely a rectangle is to hold it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.metric import rectangle_of
from tricue.track.depth_particle.params import DepthParticleParams

Floats = NDArray[np.float64]

SHARP = np.array([0.05, 0.06, 0.06, 0.06, 0.08])  # metres: how closely a segmented object tells a state
TRUST = 1.2  # times as wide it counts as a measurement
FAR_OFF = 12.0  # nats at most, that an object far from a particle costs it: objects may be wrong
SIZE_TRUST = np.array([0.25, 0.2])  # standard deviation of log(size / usual size)
AROUND = 12  # places read at each side
NOTHING = np.zeros(1)
LEAST = 1e-12  # of a linear likelihood, in the logarithm


class Seen(NamedTuple):
    """(N,) each: log-likelihood (37), or its exponential form, times that of the contrast; share of the
    places inside at the target's depth, inside less around, and in front of it.
    """

    log_likelihood: Floats
    inside: Floats
    contrast: Floats
    front: Floats


class Measured(NamedTuple):
    """A state (5,) that the segmented object tells, its standard deviations (5,), and what a state far from
    it loses at most, nats.
    """

    state: Floats
    deviation: Floats
    most: float

    @classmethod
    def of(cls, state: Floats, weight: float) -> "Measured":
        """With a weight in the likelihood, which may be 0."""
        if weight == 0:
            return NOT_MEASURED
        return cls(state, TRUST * SHARP / np.sqrt(weight), weight * FAR_OFF)


NOT_MEASURED = Measured(np.zeros(5), np.full(5, np.inf), 0.0)


class DepthModel(NamedTuple):
    """The depth histogram of the target, relative to its own depth or absolute, read at places of a grid."""

    p: DepthParticleParams
    grid: Floats
    histogram: Floats

    @classmethod
    def empty(cls, p: DepthParticleParams) -> "DepthModel":
        """Of which nothing is known yet."""
        return cls(p, grid(*p.grid), np.zeros(p.bins if p.histogram == "relative" else p.levels))

    def look(self, k: Kernels, fg: Foreground, states: Floats) -> Seen:
        """Read the foreground in and around the rectangles of states (N, 5)."""
        p = self.p
        relative = self.histogram if p.histogram == "relative" else NOTHING
        ring = (p.margin, AROUND)
        measured = k.depth_contrast(fg.depth, fg.camera, states, relative, p.grid, ring, p.reach, p.nearer)
        distance, inside, front, around = measured.T
        if p.histogram == "absolute":
            distance = self._absolute(k, fg, states)
        contrast = inside - around
        return Seen(self._log_likelihood(distance) + p.contrast * contrast, inside, contrast, front)

    def _log_likelihood(self, distance: Floats) -> Floats:
        if self.p.likelihood == "linear":
            return np.log(np.maximum(1 - distance, LEAST))
        return np.asarray(-self.p.sharpness * distance * distance)

    def learned(self, k: Kernels, fg: Foreground, state: Floats, rate: float) -> "DepthModel":
        """With the histogram of one rectangle blended in; a rate of 1 starts it."""
        rectangle, reach = self._rectangles(fg, state[None])
        seen = k.rectangle_histogram(fg.depth, rectangle[0], len(self.histogram), self.grid, reach)
        if not seen.any():
            return self
        known = self.histogram.any()
        return self._replace(histogram=self.histogram + rate * (seen - self.histogram) if known else seen)

    def _absolute(self, k: Kernels, fg: Foreground, states: Floats) -> Floats:
        rectangles, reach = self._rectangles(fg, states)
        measured = k.depth_distance(fg.depth, rectangles, self.histogram, self.grid, reach, self.p.nearer)
        distance: Floats = measured[:, 0]
        return distance

    def _rectangles(self, fg: Foreground, states: Floats) -> tuple[Floats, float]:
        """(N, 5) rectangles in pixels, and the histogram's reach from their depths.

        An absolute histogram is one relative to the middle of the camera's range.
        """
        rectangles = np.array([rectangle_of(state, fg.camera) for state in states])
        if self.p.histogram == "relative":
            return rectangles, self.p.reach
        rectangles[:, 4] = (self.p.near + self.p.far) / 2
        return rectangles, (self.p.far - self.p.near) / 2
