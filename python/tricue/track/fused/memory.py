# SPDX-License-Identifier: MIT
"""Models from some frames ago verify what the current ones find.

Models gradually learn an occluder that moves in front of the target, and soon take it for the target. Those
from before it came don't recognize it, or see the target beside it.
"""

from typing import NamedTuple

from tricue.track.fused.identity import in_any_light, log_odds_of
from tricue.track.fused.localize import TargetModel, is_near_edge, localize
from tricue.track.fused.measure import Match, recognize
from tricue.track.fused.models import ModelsByKind
from tricue.track.fused.window import CELL_PIXELS, extract_window

FRAMES_APART = 5  # from one snapshot to the next, of those that were recognized
MAX_CELLS_OFF = 3  # from a match to where the older models see the target, if it is the same
LOG_ODDS_ELSEWHERE = -5.0  # of a match that is farther off


class Memory(NamedTuple):
    """Two snapshots of the models; the older one, from 5 to 10 recognized frames ago, verifies.

    frames: recognized since the newer one.
    """

    older: ModelsByKind
    newer: ModelsByKind
    frames: int = 0

    def keep(self, models: ModelsByKind) -> "Memory":
        """The memory after one more frame in which the target was recognized, by these models."""
        frames = self.frames + 1
        return self._replace(frames=frames) if frames < FRAMES_APART else Memory(self.newer, models)


def limit_log_odds(remembered: TargetModel, match: Match) -> Match:
    """A match in a color picture, its log-odds at most those by the older models in the same window.

    A match with the log-odds that a missed target needs isn't limited: the first frame's models are sure. If
    a match is near its window's edge even after it was localized again, as in a window without texture, the
    older models look at it in a window of its own.
    """
    p, window, right, down = remembered.params, match.window, match.right, match.down
    if match.log_odds >= log_odds_of(p.min_score_to_redetect):
        return match
    if is_near_edge(right, down):
        window, right, down = extract_window(match.observation, match.target, p.context), 0.0, 0.0
    seen = localize(remembered, window)
    if max(abs(seen.right - right), abs(seen.down - down)) > CELL_PIXELS * MAX_CELLS_OFF:
        log_odds = LOG_ODDS_ELSEWHERE
    else:
        recognition = recognize(remembered, seen)
        log_odds = in_any_light(recognition.log_odds, recognition.structure_log_odds)
    return match._replace(log_odds=min(match.log_odds, log_odds))
