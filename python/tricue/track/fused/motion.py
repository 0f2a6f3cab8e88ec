# SPDX-License-Identifier: MIT
"""The target's motion: a match that jumps, if the target never did, is less likely to be the target.

An occluder, or a look-alike beside the target, is seldom where the target would have been. How far is too far
differs from video to video: a face moves on steadily before a fixed camera, but not before a shaking one. So
a jump is weighed by how much longer it is than those before it.
"""

import math
from typing import NamedTuple

from tricue.track.fused.target import Target

LOCALIZATION_ERROR = 0.1  # of the target's side: a shorter distance from the predicted place is no jump
MEAN_RATE = 0.05  # per frame, of the running mean of jumps
MIN_TIME_SHARE = 0.1  # of the time to the next frame; a velocity over less comes from late timestamps


class Motion(NamedTuple):
    """The motion between frames in which the target was recognized.

    A jump is the distance from where the target would be at the velocity of the frame before, in sides of the
    target. velocity: right and down, in sides of the target per second; None after a frame without the
    target. typical: running mean of jumps. jumps: their number. seconds: over which velocity was measured.
    """

    velocity: tuple[float, float] | None = None
    typical: float = 0.0
    jumps: int = 0
    seconds: float = 0.0

    def penalty(self, last: Target, found: Target, seconds: float, weight: float) -> float:
        """The log-odds that a jump takes off a place's; 0 if nothing is known about the target's jumps.

        last: the target so many seconds ago. weight: log-odds per typical jump above the first.
        """
        jump = self._jump(last, found, seconds) if self.jumps else None
        if jump is None:
            return 0.0
        return weight * max(jump / (self.typical + LOCALIZATION_ERROR) - 1, 0.0)

    def follow(self, last: Target, found: Target, seconds: float) -> "Motion":
        """The motion after one more frame in which the target was recognized."""
        right, down = _displacement(last, found)
        velocity = right / seconds, down / seconds
        jump = self._jump(last, found, seconds)
        if jump is None:
            return self._replace(velocity=velocity, seconds=seconds)
        jumps = self.jumps + 1
        rate = max(1 / jumps, MEAN_RATE)  # the mean of all at first
        return Motion(velocity, self.typical + rate * (jump - self.typical), jumps, seconds)

    def interrupt(self) -> "Motion":
        """The motion after a frame in which the target wasn't recognized."""
        return self._replace(velocity=None)

    def _jump(self, last: Target, found: Target, seconds: float) -> float | None:
        """None where nothing tells where the target would be."""
        if self.velocity is None or self.seconds < MIN_TIME_SHARE * seconds:
            return None
        right, down = _displacement(last, found)
        return math.hypot(right - seconds * self.velocity[0], down - seconds * self.velocity[1])


def _displacement(last: Target, found: Target) -> tuple[float, float]:
    """To the right and down, in sides of the last target."""
    return (found.x - last.x) / last.side, (found.y - last.y) / last.side
