# SPDX-License-Identifier: MIT
"""How an ellipse moves: equation (30) with the velocity in its mean, and a size that returns to what it
usually is.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.prediction import Prediction
from tricue.track.color_particle.params import ColorParticleParams

Floats = NDArray[np.float64]
Pair = tuple[float, float]
Ellipse = tuple[float, float, float, float]

STILL = np.zeros(4)
JITTER = 0.5  # pixels of position noise that even the smallest target has


class Motion(NamedTuple):
    """The target's ellipse, its smoothed velocity (pixels a frame), its usual size and its first size."""

    ellipse: Ellipse
    velocity: Pair
    usual: Pair
    first: Pair

    @classmethod
    def start(cls, ellipse: Ellipse) -> "Motion":
        """At rest."""
        return cls(ellipse, (0.0, 0.0), ellipse[2:], ellipse[2:])

    @property
    def side(self) -> float:
        """Pixels: the side of the square as large as the ellipse's box."""
        return 2.0 * math.sqrt(self.ellipse[2] * self.ellipse[3])

    def predict(self, p: ColorParticleParams, shape: tuple[int, ...]) -> Prediction:
        """Where particles go next; K of (30) grows with the velocity. Centers stay in the image."""
        (x, y, minor, major), (vx, vy) = self.ellipse, self.velocity
        noise, k, pull = JITTER + p.position_noise * self.side, p.velocity_noise, p.size_pull
        sizes = (p.size_noise**2 + p.aspect_noise**2) ** 0.5
        reach = max(p.reach, p.reach_sizes * self.side)
        height, width = shape[:2]
        left, right = min(max(x - reach, 0.0), width), min(max(x + reach, 0.0), width)
        top, bottom = min(max(y - reach, 0.0), height), min(max(y + reach, 0.0), height)
        (smallest, largest), (first_minor, first_major) = p.size_range, self.first
        return Prediction(
            np.array((vx, vy, pull * (self.usual[0] - minor), pull * (self.usual[1] - major))),
            np.array((noise + k * abs(vx), noise + k * abs(vy), sizes * minor, sizes * major)),
            np.array((left, top, smallest * first_minor, smallest * first_major)),
            np.array((right, bottom, largest * first_minor, largest * first_major)),
        )

    def moved(self, ellipse: Ellipse, p: ColorParticleParams) -> "Motion":
        """What one more estimate makes of it."""
        (x, y, *_), (vx, vy), rate = self.ellipse, self.velocity, p.velocity_rate
        velocity = (vx + rate * (ellipse[0] - x - vx), vy + rate * (ellipse[1] - y - vy))
        minor, major = self.usual
        memory = p.size_memory
        usual = (minor + memory * (ellipse[2] - minor), major + memory * (ellipse[3] - major))
        return Motion(ellipse, velocity, usual, self.first)

    def stopped_at(self, ellipse: Ellipse) -> "Motion":
        """At rest in another place."""
        return Motion(ellipse, (0.0, 0.0), self.usual, self.first)


def size_mixing(p: ColorParticleParams) -> Floats:
    """(4, 4) for white noise from the right: makes the two semi-axes grow together, but for the noise of
    their ratio.
    """
    variance = p.size_noise**2 + p.aspect_noise**2
    common = p.size_noise**2 / variance if variance > 0 else 0.0
    mixing = np.eye(4)
    mixing[2, 3], mixing[3, 3] = common, (1 - common**2) ** 0.5
    return mixing
