# SPDX-License-Identifier: MIT
"""Whether a match counts as the fused tracker's target, and the score that it has."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from tricue.track.fused.clutter import NO_CLUTTER
from tricue.track.fused.identity import IdentityFeatures, log_odds_of
from tricue.track.fused.localize import Candidate
from tricue.track.fused.measure import Match
from tricue.track.fused.memory import Memory
from tricue.track.fused.outline import Sides
from tricue.track.fused.params import FusedParams
from tricue.track.fused.state import MIN_LOST_FRAMES, FusedState
from tricue.track.fused.target import Target
from tricue.track.fused.verify import verify

P = FusedParams()
HERE, THERE = Target(100.0, 80.0, 40.0, 40.0), Target(110.0, 80.0, 42.0, 42.0)
FEATURES = IdentityFeatures(peak_sharpness=12.0, color_similarity=0.9, contrast=0.5, first_response=0.8)
LEAST, LEAST_LOST = log_odds_of(P.min_score), log_odds_of(P.min_score_to_redetect)


def match(odds: float, covered: float = 0.0, depth: object = None) -> Match:
    """Of the target a little to the right, with these log-odds, so much of it covered; depth: where from."""
    window: Any = SimpleNamespace(observation=SimpleNamespace(depth_source=depth))
    unused: Any = None
    candidate = Candidate(THERE, window, 0.0, 0.0, 0.0, 0.5, unused, FEATURES)
    return Match(candidate, THERE, odds, 0.0, None, covered)


def state(lost: bool) -> FusedState:
    """Of a target that was followed for ten frames, or is LOST."""
    sides = Sides.cut_by_border(HERE, (240, 320))
    fresh = FusedState(
        (240, 320), {}, Memory({}, {}), HERE, 40.0, 40.0, 0.5, sides, seconds=1 / 30, frames=10
    )
    return replace(fresh, missed_frames=MIN_LOST_FRAMES, missed_seconds=10.0) if lost else fresh


@pytest.mark.parametrize("lost", [False, True], ids=["followed", "lost"])
def test_recognized_from_a_threshold_on(lost):
    """The score of what is recognized is ``min_score`` at least, whether the target was LOST or not."""
    least = LEAST_LOST if lost else LEAST
    below, above = (verify(state(lost), match(least + off), P) for off in (-0.01, 0.01))
    assert below.missed_frames == state(lost).missed_frames + 1
    assert below.score < P.min_score
    assert above.missed_frames == 0
    assert above.score > P.min_score


@pytest.mark.parametrize("odds", [-6.0, 0.0, LEAST_LOST, 8.0])
def test_a_lost_target_is_less_likely_there(odds):
    """The same match has a lower score for a LOST target than for one that was just followed there."""
    assert verify(state(True), match(odds), P).score < verify(state(False), match(odds), P).score


@pytest.mark.parametrize("odds", [LEAST - 3.0, LEAST, 20.0])
def test_what_is_covered_is_not_recognized(odds):
    """Behind an occluder the box stays, and the score is ``min_score`` at most."""
    found = verify(state(False), match(odds, covered=0.9), P)
    assert (found.occluded, found.missed_frames, found.target) == (True, 1, HERE)
    assert found.score <= P.min_score


def test_what_hardly_may_be_it_does_not_move_it():
    """Below ``min_score_to_move`` the target stays where it was, above it goes to the match."""
    least = log_odds_of(P.min_score_to_move)
    assert verify(state(False), match(least - 0.01), P).target == HERE
    assert verify(state(False), match(least + 0.01), P).target == THERE
    assert verify(state(True), match(least + 0.01), P).target == THERE


def test_a_missed_target_needs_more():
    """What was learned since may be what hid it: enough for a followed target isn't enough after one miss."""
    missed = replace(state(False), missed_frames=1, missed_seconds=0.03)
    assert verify(state(False), match(LEAST + 0.01), P).missed_frames == 0
    below, above = (verify(missed, match(LEAST_LOST + off), P) for off in (-0.01, 0.01))
    assert (below.missed_frames, below.score) == (2, P.min_score)
    assert above.missed_frames == 0


def test_with_depth_it_needs_more_only_when_lost():
    """Depth shows what hides the target."""
    missed = replace(state(False), missed_frames=1, missed_seconds=0.03)
    assert verify(missed, match(LEAST + 0.01, depth="an image"), P).missed_frames == 0
    assert verify(missed, match(LEAST - 0.01, depth="an image"), P).missed_frames == 2
    assert verify(state(True), match(LEAST_LOST - 0.01, depth="an image"), P).missed_frames > 0


def test_what_stands_out_from_the_clutter_needs_less():
    """Frames in which nothing looked like the target lower what it needs; recognized, it starts anew."""
    searched = state(True)
    for _ in range(30):
        searched = verify(searched, match(LEAST - 9.0)._replace(best_seen=-9.0), P)
    least = log_odds_of(P.min_score_above_clutter)
    assert least < LEAST_LOST
    assert verify(searched, match(least - 0.01), P).missed_frames > 0
    found = verify(searched, match(least + 0.01), P)
    assert (found.missed_frames, found.clutter) == (0, NO_CLUTTER)
    assert found.score > P.min_score


def test_without_a_search_nothing_is_known_of_clutter():
    """As long as the target is followed, what it needs stays."""
    missed = verify(state(False), match(LEAST - 1.0), P)
    assert missed.clutter == NO_CLUTTER


def test_what_is_typical_follows_in_time():
    """Two frames of 1/30 s move the running means as much as one of 1/15 s."""
    sure = match(LEAST + 5.0)
    sure = sure._replace(candidate=sure.candidate._replace(response=0.9))
    known = replace(state(False), frames=1000, typical=FEATURES._replace(contrast=0.1))
    twice = verify(verify(known, sure, P), sure, P)
    once = verify(replace(known, seconds=2 / 30), sure, P)
    assert once.mean_response == pytest.approx(twice.mean_response)
    assert once.typical == pytest.approx(twice.typical)
    assert known.mean_response < once.mean_response < sure.candidate.response
