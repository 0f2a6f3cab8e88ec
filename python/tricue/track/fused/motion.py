# SPDX-License-Identifier: MIT
"""How the target moves: what jumps, where the target never did, is less likely to be it.

What hides a target, or is like it and stands beside it, is seldom where the target would have been. How far
is too far differs from video to video: a face before a resting camera goes on as it did, one before a
shaking camera doesn't. So a jump counts by how much larger it is than those before it.
"""

import math
from typing import NamedTuple

from tricue.track.fused.target import Target

LOCALIZATION_ERROR = 0.1  # of the target's side: so far from where it is led to is no jump
MEAN_RATE = 0.05  # per frame, of the running mean of jumps
MIN_TIME_SHARE = 0.1  # of the time to the next frame; a velocity over less comes from late timestamps


class Motion(NamedTuple):
    """Between frames in which the target was recognized.

    A jump is the distance from where the target would be at the velocity of the frame before, in sides of the
    target. velocity: right and down, in sides of the target per second; None after a frame without the
    target. typical: running mean of jumps. jumps: that were seen. seconds: over which velocity was measured.
    """

    velocity: tuple[float, float] | None = None
    typical: float = 0.0
    jumps: int = 0
    seconds: float = 0.0

    def penalty(self, last: Target, found: Target, seconds: float, weight: float) -> float:
        """Log-odds that a place has less for its jump; 0 where nothing is known of the target's jumps.

        last: the target so many seconds ago. weight: log-odds per typical jump above the first.
        """
        jump = self._jump(last, found, seconds) if self.jumps else None
        if jump is None:
            return 0.0
        return weight * max(jump / (self.typical + LOCALIZATION_ERROR) - 1, 0.0)

    def follow(self, last: Target, found: Target, seconds: float) -> "Motion":
        """With one more frame in which the target was recognized."""
        right, down = _displacement(last, found)
        velocity = right / seconds, down / seconds
        jump = self._jump(last, found, seconds)
        if jump is None:
            return self._replace(velocity=velocity, seconds=seconds)
        jumps = self.jumps + 1
        rate = max(1 / jumps, MEAN_RATE)  # the mean of all at first
        return Motion(velocity, self.typical + rate * (jump - self.typical), jumps, seconds)

    def interrupt(self) -> "Motion":
        """After a frame in which the target wasn't recognized."""
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
