# SPDX-License-Identifier: MIT
"""Older models verify what the current ones find.

When an occluder moves in front of the target, the models gradually learn it, and soon take it for the target.
Models from before don't recognize the occluder, or find the target beside it.
"""

from typing import NamedTuple

from tricue.track.fused.identity import in_any_light, log_odds_of
from tricue.track.fused.localize import LocalizationModel, is_near_edge, localize
from tricue.track.fused.measure import Match, recognize
from tricue.track.fused.models import ModelsByKind
from tricue.track.fused.window import CELL_PIXELS, extract_window

FRAMES_APART = 5  # between two snapshots; only frames in which the target was recognized count
MAX_CELLS_OFF = 3  # between the places where the current and the older models find the target
LOG_ODDS_ELSEWHERE = -5.0  # of a match if these places are farther apart


class Memory(NamedTuple):
    """Two snapshots of the models; the older one, from 5 to 10 recognized frames ago, verifies matches.

    frames: number of frames since the newer snapshot in which the target was recognized.
    """

    older: ModelsByKind
    newer: ModelsByKind
    frames: int = 0

    def keep(self, models: ModelsByKind) -> "Memory":
        """The memory after one more frame in which the target was recognized by these models."""
        frames = self.frames + 1
        return self._replace(frames=frames) if frames < FRAMES_APART else Memory(self.newer, models)


def limit_log_odds(remembered: LocalizationModel, match: Match) -> Match:
    """A match in a color picture, with its log-odds limited to those by the older models in the same window.

    A match with the log-odds that a missed target needs isn't limited: it is similar enough to the first
    frame. If a match is near its window's edge even after it was localized again, as in a window without
    texture, the older models search a window around it.
    """
    p, candidate = remembered.params, match.candidate
    window, right, down = candidate.window, candidate.right, candidate.down
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
