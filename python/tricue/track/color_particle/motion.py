# SPDX-License-Identifier: MIT
"""The motion model of an ellipse: equation (30) with a velocity, and a size that returns to its mean."""

import math
from typing import NamedTuple

from tricue.track.color_particle.params import ColorParticleParams

Ellipse = tuple[float, float, float, float]  # x, y, minor, major

MIN_PIXEL_NOISE = 0.5  # pixels, standard deviation of the position of even the smallest target


class EllipsePrediction(NamedTuple):
    """p(x' | x) = N(x + drift, diag(scale²)) between lower and upper.

    Tuples are faster than arrays to make and to pass to a kernel.
    """

    drift: Ellipse
    scale: Ellipse
    lower: Ellipse
    upper: Ellipse


class EllipseMotion(NamedTuple):
    """The target's ellipse, pixels, and its motion.

    velocity: pixels per frame, smoothed. mean_size: running mean of the semi-axes. first_size: of the first
    frame.
    """

    ellipse: Ellipse
    velocity: tuple[float, float]
    mean_size: tuple[float, float]
    first_size: tuple[float, float]

    @classmethod
    def start(cls, ellipse: Ellipse) -> "EllipseMotion":
        """The motion of a target at rest."""
        return cls(ellipse, (0.0, 0.0), ellipse[2:], ellipse[2:])

    @property
    def side(self) -> float:
        """The side of a square with the area of the ellipse's box, pixels."""
        return 2.0 * math.sqrt(self.ellipse[2] * self.ellipse[3])

    def predict(self, p: ColorParticleParams, shape: tuple[int, ...]) -> EllipsePrediction:
        """The particles' transition density; its noise, K of (30), grows with the velocity.

        Centers stay in the image.
        """
        (x, y, minor, major), (vx, vy), (mean_minor, mean_major), (first_minor, first_major) = self
        side, k, pull = self.side, p.velocity_noise, p.size_pull
        noise = MIN_PIXEL_NOISE + p.position_noise * side
        size_noise = (p.size_noise**2 + p.aspect_noise**2) ** 0.5
        step = max(p.max_step, p.max_step_sizes * side)
        left, right = _reach(x, step, shape[1])
        top, bottom = _reach(y, step, shape[0])
        smallest, largest = p.size_range
        return EllipsePrediction(
            (p.drift * vx, p.drift * vy, pull * (mean_minor - minor), pull * (mean_major - major)),
            (noise + k * abs(vx), noise + k * abs(vy), size_noise * minor, size_noise * major),
            (left, top, smallest * first_minor, smallest * first_major),
            (right, bottom, largest * first_minor, largest * first_major),
        )

    def update(self, ellipse: Ellipse, p: ColorParticleParams) -> "EllipseMotion":
        """Move to a new estimate; its step updates the velocity, its size the mean size."""
        (x, y, *_), (vx, vy), rate = self.ellipse, self.velocity, p.velocity_rate
        velocity = (vx + rate * (ellipse[0] - x - vx), vy + rate * (ellipse[1] - y - vy))
        minor, major = self.mean_size
        size_rate = p.size_rate
        mean_size = (minor + size_rate * (ellipse[2] - minor), major + size_rate * (ellipse[3] - major))
        return EllipseMotion(ellipse, velocity, mean_size, self.first_size)

    def restart_at(self, ellipse: Ellipse) -> "EllipseMotion":
        """Move to another place, at rest; the mean size is kept."""
        return EllipseMotion(ellipse, (0.0, 0.0), self.mean_size, self.first_size)


def _reach(center: float, step: float, size: int) -> tuple[float, float]:
    """A step below and above a center, between 0 and the image's size."""
    if step <= center <= size - step:
        return center - step, center + step
    return min(max(center - step, 0.0), size), min(max(center + step, 0.0), size)


def size_correlation(p: ColorParticleParams) -> float:
    """The correlation of the noise of both semi-axes.

    They grow and shrink together, but for the noise of their ratio.
    """
    variance = p.size_noise**2 + p.aspect_noise**2
    return p.size_noise**2 / variance if variance > 0 else 0.0
