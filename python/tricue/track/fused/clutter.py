# SPDX-License-Identifier: MIT
"""Clutter: the false matches of a search. A clearly better match is the target.

How similar other places are to the target varies from scene to scene, by more than the target changes while
it is away. So the threshold for a missed target adapts to the matches found in the search of the whole frame,
as in a constant false alarm rate (CFAR) detector (Finn and Johnson 1968).
"""

from typing import NamedTuple

from tricue.track.fused.identity import log_odds_of
from tricue.track.fused.params import FusedParams

RECENT_FRAMES = 5  # not counted yet, as a target that comes back gradually may already be visible in them
MIN_FRAMES = 5  # counted frames, below which they don't describe the scene


class Clutter(NamedTuple):
    """Log-odds of each frame's best match while the target is searched for and not recognized.

    frames: number of counted frames. highest: over the counted frames. recent: of the last frames, which
    aren't counted yet.
    """

    frames: int = 0
    highest: float = float("-inf")
    recent: tuple[float, ...] = ()

    def add(self, log_odds: float) -> "Clutter":
        """The clutter with the best match of one more frame."""
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
