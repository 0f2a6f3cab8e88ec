# SPDX-License-Identifier: MIT
"""What a missed target needs, by what was seen since it was missed."""

import pytest
from tricue import FusedTracker
from tricue.track.fused.clutter import MIN_FRAMES, NO_CLUTTER, RECENT_FRAMES, Clutter
from tricue.track.fused.identity import log_odds_of

P = FusedTracker.Params()
MOST, LEAST = log_odds_of(P.min_score_to_redetect), log_odds_of(P.min_score_above_clutter)


def clutter(*log_odds: float) -> Clutter:
    """After these frames."""
    seen = NO_CLUTTER
    for each in log_odds:
        seen = seen.add(each)
    return seen


def test_little_seen_tells_nothing():
    """Until enough frames count, as much is needed as anywhere."""
    frames = MIN_FRAMES + RECENT_FRAMES
    assert clutter(*[-9.0] * (frames - 1)).min_log_odds(P) == MOST
    assert clutter(*[-9.0] * frames).min_log_odds(P) == LEAST < MOST


def test_the_margin_is_above_the_highest():
    """Of all frames, however long ago."""
    highest = MOST - P.clutter_margin - 0.5
    seen = clutter(-9.0, highest, *[-9.0] * 500)
    assert seen.min_log_odds(P) == pytest.approx(MOST - 0.5)


def test_the_last_frames_do_not_count_yet():
    """A target that comes back step by step isn't its own clutter."""
    before = clutter(*[-9.0] * 30)
    after = clutter(*[-9.0] * 30, *[MOST - 0.1] * RECENT_FRAMES)
    assert after.min_log_odds(P) == before.min_log_odds(P)
    assert after.add(-9.0).min_log_odds(P) == MOST


def test_look_alikes_ask_for_no_more_than_a_search_does_at_first():
    """The threshold of a search is the most, whatever was seen."""
    assert clutter(*[40.0] * 30).min_log_odds(P) == MOST


def test_a_low_threshold_stays():
    """Where a search asks for less than what stands out from clutter, that is enough."""
    low = FusedTracker.Params(min_score_to_redetect=0.5)
    assert clutter(*[-9.0] * 30).min_log_odds(low) == log_odds_of(0.5)
