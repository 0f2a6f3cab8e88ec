# SPDX-License-Identifier: MIT
"""What a target looks like in depth, (37), (38), and how likely a rectangle is to hold it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.depth_params import DepthParticleParams
from tricue.track.foreground import Foreground
from tricue.track.pattern import grid

Floats = NDArray[np.float64]

SHARP = np.array([0.05, 0.06, 0.06, 0.06, 0.08])  # metres: how closely a segmented object tells a state
TRUST = 1.2  # times as wide it counts as a measurement
FAR_OFF = 12.0  # nats at most, that an object far from a particle costs it: objects may be wrong
SIZE_TRUST = np.array([0.25, 0.2])  # standard deviation of log(size / usual size)
AROUND = 12  # places read at each side
LEAST = 1e-12  # of a linear likelihood, in the logarithm


class Seen(NamedTuple):
    """(N,) each: distance to the model, share of the places at the target's depth inside and around, share
    in front of it.
    """

    distance: Floats
    inside: Floats
    around: Floats
    front: Floats

    @property
    def contrast(self) -> Floats:
        return self.inside - self.around


class DepthModel:
    """The depth histogram of the target, relative to its own depth or absolute, read at places of a grid."""

    def __init__(self, p: DepthParticleParams) -> None:
        self.p = p
        self.grid = grid(*p.grid)
        self.frame = frame(p.margin)
        bins = p.bins if p.histogram == "relative" else p.levels
        self.histogram = np.zeros(bins)

    def look(self, k: Kernels, fg: Foreground, states: Floats) -> Seen:
        """Read the foreground in and around the rectangles of states (N, 5)."""
        p, rectangles = self.p, rectangles_of(states, fg.camera)
        relative = self.histogram if p.histogram == "relative" else np.zeros(1)
        inside = k.depth_distance(fg.depth, rectangles, relative, self.grid, p.reach, p.nearer)
        around = k.depth_distance(fg.depth, rectangles, np.zeros(1), self.frame, p.reach, p.nearer)
        distance = inside[:, 0] if p.histogram == "relative" else self._absolute(k, fg, rectangles)
        return Seen(distance, inside[:, 1], around[:, 1], inside[:, 2])

    def log_likelihood(self, seen: Seen) -> Floats:
        """(N,) (37), or its exponential form, times the contrast of inside and around."""
        if self.p.likelihood == "linear":
            log_likelihood = np.log(np.maximum(1 - seen.distance, LEAST))
        else:
            log_likelihood = -self.p.sharpness * seen.distance * seen.distance
        return np.asarray(log_likelihood + self.p.contrast * seen.contrast)

    def learn(self, k: Kernels, fg: Foreground, state: Floats, rate: float) -> None:
        """Blend the histogram of one rectangle into the model; a rate of 1 starts it."""
        rectangle = rectangles_of(state[None], fg.camera)
        reach = self.p.reach
        if self.p.histogram == "absolute":
            rectangle, reach = self._centered(rectangle)
        seen = k.rectangle_histogram(fg.depth, rectangle[0], len(self.histogram), self.grid, reach)
        if not seen.any():
            return
        self.histogram = self.histogram + rate * (seen - self.histogram) if self.histogram.any() else seen

    def _absolute(self, k: Kernels, fg: Foreground, rectangles: Floats) -> Floats:
        centered, reach = self._centered(rectangles)
        measured = k.depth_distance(fg.depth, centered, self.histogram, self.grid, reach, self.p.nearer)
        distance: Floats = measured[:, 0]
        return distance

    def _centered(self, rectangles: Floats) -> tuple[Floats, float]:
        """An absolute histogram is one relative to the middle of the camera's range."""
        centered = rectangles.copy()
        centered[:, 4] = (self.p.near + self.p.far) / 2
        return centered, (self.p.far - self.p.near) / 2


def size_term(states: Floats, size: Floats) -> Floats:
    """(N,) log-likelihood of the sizes in states (N, 5), by the usual size (2,)."""
    off = np.log(states[:, 3:] / size) / SIZE_TRUST
    return np.asarray(-0.5 * (off * off).sum(axis=1))


def object_term(states: Floats, seen: Floats) -> Floats:
    """(N,) log-likelihood of states (N, 5) by a segmented object's (5,), taken as a measurement."""
    off = (states - seen) / (TRUST * SHARP)
    return np.asarray(-np.minimum(0.5 * (off * off).sum(axis=1), FAR_OFF))


def frame(margin: float) -> Floats:
    """(4 AROUND, 2) places on the four sides round a rectangle, in its half sizes."""
    along = (np.arange(AROUND) + 0.5) * 2 / AROUND - 1
    off = np.full(AROUND, margin)
    sides = [(-off, along), (off, along), (along, -off), (along, off)]
    return np.concatenate([np.stack(side, axis=1) for side in sides])


def rectangles_of(states: Floats, camera: Floats) -> Floats:
    """(N, 5) centre x, y, width, height in pixels and depth, of states X, Y, Z, W, H in metres.

    Box coordinates: (0, 0) is the first pixel's corner.
    """
    fx, fy, cx, cy = camera
    rectangles = np.empty((len(states), 5))
    z = states[:, 2]
    per_x, per_y = fx / z, fy / z
    rectangles[:, 0] = states[:, 0] * per_x + (cx + 0.5)
    rectangles[:, 1] = states[:, 1] * per_y + (cy + 0.5)
    rectangles[:, 2] = states[:, 3] * per_x
    rectangles[:, 3] = states[:, 4] * per_y
    rectangles[:, 4] = z
    return rectangles


def states_of(rectangles: Floats, camera: Floats) -> Floats:
    """The inverse of :func:`rectangles_of`."""
    fx, fy, cx, cy = camera
    x, y, w, h, z = rectangles.T
    return np.stack([(x - 0.5 - cx) * z / fx, (y - 0.5 - cy) * z / fy, z, w * z / fx, h * z / fy], axis=1)
