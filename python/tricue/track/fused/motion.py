# SPDX-License-Identifier: MIT
"""The target's motion: a match at the end of an unusually long jump is less likely to be the target.

An occluder, or a look-alike beside the target, is seldom at the place that the target's velocity predicts.
How far a target jumps differs from video to video: a face moves steadily in front of a fixed camera, but not
in front of a shaking one. So a jump is compared with those before it.
"""

import math
from typing import NamedTuple

from tricue.track.fused.target import Target

LOCALIZATION_ERROR = 0.1  # of the target's side: a shorter distance from the predicted place is no jump
MEAN_RATE = 0.05  # per frame, of the running mean of jumps
MIN_TIME_SHARE = 0.1  # of the time to the next frame; a velocity over less time tells nothing about its place


class Motion(NamedTuple):
    """The motion between frames in which the target was recognized.

    A jump is the distance from the place that the last velocity predicts, in sides of the target. velocity:
    to the right and down, in sides of the target per second; None after a frame in which the target wasn't
    recognized, or that came late. typical: running mean of jumps. jumps: their number. seconds: time over
    which velocity was measured.
    """

    velocity: tuple[float, float] | None = None
    typical: float = 0.0
    jumps: int = 0
    seconds: float = 0.0

    def penalty(self, last: Target, found: Target, seconds: float, weight: float) -> float:
        """The log-odds by which a jump lowers a match's; 0 until a jump of the target was measured.

        last: the target so many seconds ago. weight: log-odds per typical jump beyond the first.
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
        rate = max(1 / jumps, MEAN_RATE)  # at first the mean of all jumps
        return Motion(velocity, self.typical + rate * (jump - self.typical), jumps, seconds)

    def interrupt(self) -> "Motion":
        """The motion without a velocity: after a frame without the target, or one that came late."""
        return self._replace(velocity=None)

    def _jump(self, last: Target, found: Target, seconds: float) -> float | None:
        """The jump in sides of the last target; None without a velocity that predicts the target's place."""
        if self.velocity is None or self.seconds < MIN_TIME_SHARE * seconds:
            return None
        right, down = _displacement(last, found)
        return math.hypot(right - seconds * self.velocity[0], down - seconds * self.velocity[1])


def _displacement(last: Target, found: Target) -> tuple[float, float]:
    """The displacement to the right and down, in sides of the last target."""
    return (found.x - last.x) / last.side, (found.y - last.y) / last.side
