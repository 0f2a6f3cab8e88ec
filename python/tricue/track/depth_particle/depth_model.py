# SPDX-License-Identifier: MIT
"""The target's depth histogram, (37), (38), and the likelihood of a rectangle."""

import math
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.projection import project_rectangle
from tricue.track.depth_particle.params import DepthParticleParams

SURROUND_SAMPLES = 12  # at each side of a rectangle
NO_HISTOGRAM = np.zeros(1)  # if only the shares inside and around are wanted
MIN_LIKELIHOOD = 1e-12  # to take the logarithm of the linear likelihood


class DepthObservation(NamedTuple):
    """The observation of one rectangle.

    log_likelihood: as :meth:`DepthModel.log_likelihood`. inside: the share of the samples inside that are at
    the target's depth. contrast: that share minus the share around the rectangle. front: the share of the
    samples inside that are in front of the target.
    """

    log_likelihood: float
    inside: float
    contrast: float
    front: float


class DepthModel(NamedTuple):
    """The target's depth histogram, relative to its own depth or absolute, sampled on a grid."""

    p: DepthParticleParams
    histogram: Floats

    @classmethod
    def empty(cls, p: DepthParticleParams) -> "DepthModel":
        """A model that has learned nothing yet."""
        return cls(p, np.zeros(p.bins if p.histogram == "relative" else p.levels))

    def observe(self, k: Kernels, fg: Foreground, state: Floats) -> DepthObservation:
        """Compare the foreground in and around the rectangle of a state (5,) with the model."""
        p, states = self.p, state[None]
        model, places = (NO_HISTOGRAM, p.histogram_reach), (*p.grid, p.margin, SURROUND_SAMPLES)
        measured = k.depth_contrast(fg.depth, fg.camera, states, model, places, p.occluder_margin)[0]
        measured[0] = self.distance(k, fg, states)[0]
        return self.observation(measured)

    def observation(self, measured: Floats) -> DepthObservation:
        """The observation of one rectangle from the kernels' (4,) measurement. The log-likelihood is that of
        the kernel filter_rectangles, without priors.
        """
        p, (distance, inside, front, around) = self.p, measured.tolist()
        if p.likelihood == "linear":
            likeness = math.log(max(1 - distance, MIN_LIKELIHOOD))
        else:
            likeness = -p.sharpness * distance * distance
        contrast = inside - around
        return DepthObservation(likeness + p.contrast * contrast, inside, contrast, front)

    def distance(self, k: Kernels, fg: Foreground, states: Floats) -> Floats:
        """(N,) the distance (38) of the histograms in the rectangles of states (N, 5), in [0, 1]."""
        rectangles, reach = self._rectangles(fg, states)
        model, places = (self.histogram, reach), grid(*self.p.grid)
        measured = k.depth_distance(fg.depth, rectangles, model, places, self.p.occluder_margin)
        distance: Floats = measured[:, 0]
        return distance

    def histogram_in(self, k: Kernels, fg: Foreground, state: Floats) -> Floats:
        """The histogram of the depths in the rectangle of a state (5,)."""
        rectangle, reach = self._rectangles(fg, state[None])
        places = grid(*self.p.grid)
        histogram: Floats = k.rectangle_histogram(fg.depth, rectangle[0], len(self.histogram), places, reach)
        return histogram

    def learn(self, new: Floats, rate: float) -> "DepthModel":
        """Blend in the histogram of a rectangle; the first nonempty one is taken as it is."""
        if not np.count_nonzero(new):
            return self
        old = self.histogram
        known = bool(np.count_nonzero(old))
        return DepthModel(self.p, old + rate * (new - old) if known else new)

    def _rectangles(self, fg: Foreground, states: Floats) -> tuple[Floats, float]:
        """The rectangles (N, 5) in pixels, and half of the histogram's range around their depths, meters."""
        rectangles = np.array([project_rectangle(state, fg.camera) for state in states])
        middle, reach = histogram_range(self.p)
        if middle:
            rectangles[:, 4] = middle
        return rectangles, reach


def histogram_range(p: DepthParticleParams) -> tuple[float, float]:
    """Center and half width of the histogram's range, meters; the center is 0 if it is the rectangle's depth.

    An absolute histogram is relative to the middle of the camera's range.
    """
    if p.histogram == "relative":
        return 0.0, p.histogram_reach
    return (p.near + p.far) / 2, (p.far - p.near) / 2


class DepthLikelihood(NamedTuple):
    """How the depths in and around a rectangle give its likelihood, as in the kernel filter_rectangles.

    model: (L,) the target's histogram, of the depths from middle - span to middle + span, meters; where the
    middle is 0, relative to the rectangle's. places: rows and columns of samples inside; how far out those
    around are, and how many there are on a side. reach, occluder_margin: meters. linear: whether the
    likelihood is linear in the distance (38). sharpness, contrast: nats.
    """

    model: Floats
    middle: float
    span: float
    places: tuple[int, int, float, int]
    reach: float
    occluder_margin: float
    linear: bool
    sharpness: float
    contrast: float

    @classmethod
    def create(cls, p: DepthParticleParams) -> "DepthLikelihood":
        """The likelihood by the parameters, of no target yet."""
        return cls(
            NO_HISTOGRAM,
            *histogram_range(p),
            (*p.grid, p.margin, SURROUND_SAMPLES),
            p.histogram_reach,
            p.occluder_margin,
            p.likelihood == "linear",
            p.sharpness,
            p.contrast,
        )
