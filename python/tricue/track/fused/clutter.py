# SPDX-License-Identifier: MIT
"""What was seen while the target was looked for: what looks more like it than all of that is the target.

How much a place that isn't the target's looks like it differs from scene to scene by more than how much the
target changes while it is away. So a missed target's threshold follows what the search of the whole frame has
found, like a detector's that keeps its rate of false alarms constant (Finn and Johnson 1968).
"""

from typing import NamedTuple

from tricue.track.fused.identity import log_odds_of
from tricue.track.fused.params import FusedParams

RECENT_FRAMES = 5  # not counted yet: a target that comes back step by step is in them, too
MIN_FRAMES = 5  # counted, before they tell what a scene is like


class Clutter(NamedTuple):
    """Log-odds of what looked most like the target in the frames of a search, and wasn't recognized.

    highest: of the counted frames. recent: of the last ones, which aren't counted yet.
    """

    frames: int = 0
    highest: float = float("-inf")
    recent: tuple[float, ...] = ()

    def add(self, log_odds: float) -> "Clutter":
        """With one more frame."""
        recent = *self.recent, log_odds
        if len(recent) <= RECENT_FRAMES:
            return self._replace(recent=recent)
        return Clutter(self.frames + 1, max(self.highest, recent[0]), recent[1:])

    def min_log_odds(self, p: FusedParams) -> float:
        """What a missed target needs to be recognized."""
        most = log_odds_of(p.min_score_to_redetect)
        if self.frames < MIN_FRAMES:
            return most
        least = min(log_odds_of(p.min_score_above_clutter), most)
        return min(max(self.highest + p.clutter_margin, least), most)


NO_CLUTTER = Clutter()
