# SPDX-License-Identifier: MIT
"""Clutter: what was seen while the target was searched for. A better match than all of it is the target.

How much other places look like the target varies from scene to scene, by more than the target changes while
it is away. So a missed target's threshold follows the matches found in the search of the whole frame, like
that of a detector with a constant rate of false alarms (Finn and Johnson 1968).
"""

from typing import NamedTuple

from tricue.track.fused.identity import log_odds_of
from tricue.track.fused.params import FusedParams

RECENT_FRAMES = 5  # not counted yet: a target that comes back gradually is in them, too
MIN_FRAMES = 5  # counted, before they describe the scene


class Clutter(NamedTuple):
    """Log-odds of the best matches in the frames of a search, which weren't recognized.

    highest: of the counted frames. recent: of the last frames, which aren't counted yet.
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
        """The log-odds that a missed target needs to be recognized."""
        most = log_odds_of(p.min_score_to_redetect)
        if self.frames < MIN_FRAMES:
            return most
        least = min(log_odds_of(p.min_score_above_clutter), most)
        return min(max(self.highest + p.clutter_margin, least), most)


NO_CLUTTER = Clutter()
