# SPDX-License-Identifier: MIT
"""How an ellipse moves: equation (30) with the velocity in its mean, and a size that returns to what it
usually is.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tricue.track.color_params import ColorParticleParams

Floats = NDArray[np.float64]


def side(ellipse: Floats) -> float:
    """Pixels: the side of the square as large as the ellipse's box."""
    return 2.0 * float(ellipse[2] * ellipse[3]) ** 0.5


@dataclass(frozen=True, slots=True)
class Motion:
    """The target's ellipse, its smoothed velocity (pixels a frame) and the size that it usually has."""

    ellipse: Floats
    velocity: Floats
    usual_size: Floats
    first_size: Floats

    @classmethod
    def start(cls, ellipse: Floats) -> "Motion":
        """At rest."""
        return cls(ellipse, np.zeros(2), ellipse[2:], ellipse[2:])

    def drift(self, p: ColorParticleParams) -> Floats:
        """(4,): the mean of the next displacement, per dimension of the state."""
        drift = np.empty(4)
        drift[:2] = self.velocity
        drift[2:] = p.size_pull * (self.usual_size - self.ellipse[2:])
        return drift

    def scale(self, p: ColorParticleParams) -> Floats:
        """(4,): the standard deviations K of (30), which grow with the velocity."""
        scale = np.empty(4)
        scale[:2] = 0.5 + p.position_noise * side(self.ellipse) + p.velocity_noise * np.abs(self.velocity)
        scale[2:] = (p.size_noise**2 + p.aspect_noise**2) ** 0.5 * self.ellipse[2:]
        return scale

    def bounds(self, p: ColorParticleParams) -> tuple[Floats, Floats]:
        """(4,), (4,): how far a particle may go in this frame."""
        reach = max(p.reach, p.reach_sizes * side(self.ellipse))
        smallest, largest = p.size_range
        lower, upper = np.empty(4), np.empty(4)
        lower[:2], upper[:2] = self.ellipse[:2] - reach, self.ellipse[:2] + reach
        lower[2:], upper[2:] = smallest * self.first_size, largest * self.first_size
        return lower, upper

    def moved(self, ellipse: Floats, p: ColorParticleParams) -> "Motion":
        """What one more estimate makes of it."""
        rate, memory = p.velocity_rate, p.size_memory
        velocity = (1 - rate) * self.velocity + rate * (ellipse[:2] - self.ellipse[:2])
        usual = (1 - memory) * self.usual_size + memory * ellipse[2:]
        return replace(self, ellipse=ellipse, velocity=velocity, usual_size=usual)


def size_mixing(p: ColorParticleParams) -> Floats:
    """(4, 4) for white noise from the right: makes the two semi-axes grow together, but for the noise of
    their ratio.
    """
    variance = p.size_noise**2 + p.aspect_noise**2
    common = p.size_noise**2 / variance if variance > 0 else 0.0
    mixing = np.eye(4)
    mixing[2, 3], mixing[3, 3] = common, (1 - common**2) ** 0.5
    return mixing
