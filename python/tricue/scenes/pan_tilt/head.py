# SPDX-License-Identifier: MIT
"""A simulated pan-tilt head: commands take effect late, and speed and acceleration are limited."""

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np

from tricue.scenes.arrays import Array

STEPS_PER_SECOND = 1000  # of the simulation


@dataclass(frozen=True, slots=True)
class HeadLimits:
    """The limits of a head. latency: seconds from a command to its effect."""

    max_speed: float = 1.2  # rad/s, on each axis
    max_acceleration: float = 8.0  # rad/s²
    latency: float = 0.08
    max_pan: float = math.radians(45)  # to each side
    max_tilt: float = math.radians(30)  # up and down


@dataclass(slots=True)
class SimulatedHead:
    """A head driven by speed commands. angles, speeds: (2,) pan to the right, tilt upward; rad, rad/s."""

    limits: HeadLimits
    angles: Array
    speeds: Array = field(default_factory=lambda: np.zeros(2))
    time: float = 0.0
    _commands: "deque[tuple[float, Array]]" = field(default_factory=deque)
    _wanted: Array = field(default_factory=lambda: np.zeros(2))

    def drive(self, pan_speed: float, tilt_speed: float) -> None:
        """Command speeds, rad/s; they take effect after the latency."""
        fastest = self.limits.max_speed
        wanted = np.clip([pan_speed, tilt_speed], -fastest, fastest)
        self._commands.append((self.time + self.limits.latency, wanted))

    def move(self, seconds: float) -> None:
        """Advance the simulation."""
        steps = max(round(seconds * STEPS_PER_SECOND), 1)
        step = seconds / steps
        ends = np.array([self.limits.max_pan, self.limits.max_tilt])
        for _ in range(steps):
            while self._commands and self._commands[0][0] <= self.time:
                self._wanted = self._commands.popleft()[1]
            change = self.limits.max_acceleration * step
            self.speeds = self.speeds + np.clip(self._wanted - self.speeds, -change, change)
            self.angles = np.clip(self.angles + self.speeds * step, -ends, ends)
            self.time += step
