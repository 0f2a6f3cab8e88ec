# SPDX-License-Identifier: MIT
"""That models as they were verify what those of today find."""

import importlib
import math

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Frame, FusedTracker, Status
from tricue.track.fused.identity import log_odds_of
from tricue.track.fused.localize import LocalizationModel
from tricue.track.fused.measure import Match
from tricue.track.fused.memory import (
    FRAMES_APART,
    LOG_ODDS_ELSEWHERE,
    Memory,
    limit_log_odds,
)
from tricue.track.fused.search import search_last_place
from tricue.track.fused.state import FusedState
from tricue.track.fused.target import Target

Image = NDArray[np.uint8]

TARGET = Target(160.0, 120.0, 48.0, 48.0)
P = FusedTracker.Params()
module = importlib.import_module(limit_log_odds.__module__)


def noise(height: int, width: int, seed: int) -> Image:
    """Smooth blobs of color, some 12 px wide."""
    small = np.random.default_rng(seed).integers(0, 256, (height // 12, width // 12, 3)).astype(np.uint8)
    return np.asarray(cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC), np.uint8)


def picture(card: int, right: int = 0, down: int = 0) -> Frame:
    """One of several cards before the same ground, so many pixels from the target's place."""
    image = noise(240, 320, 5)
    image[96 + down : 144 + down, 136 + right : 184 + right] = noise(48, 48, card)
    return Frame(image)


def followed(card: int, frames: int = 40) -> FusedTracker:
    """A tracker that has learned a card in so many frames."""
    tracker = FusedTracker()
    tracker.init(picture(card), TARGET.box)
    for _ in range(frames):
        tracker.update(picture(card))
    return tracker


def state_of(tracker: FusedTracker) -> FusedState:
    """After the last frame."""
    assert tracker._state is not None
    return tracker._state


def model_of(tracker: FusedTracker) -> LocalizationModel:
    """By which it searches a color picture."""
    state = state_of(tracker)
    return LocalizationModel(state.models["color"], state.depth, state.first_side, state.typical, P)


def match_of(tracker: FusedTracker, frame: Frame) -> Match:
    """What it finds around the target's place."""
    observation = tracker._prepare(frame, None).for_target(tracker._k, None)
    return search_last_place(model_of(tracker), observation, TARGET)


def in_doubt(match: Match) -> Match:
    """The same match, which today's models aren't sure of."""
    return match._replace(log_odds=1.0)


def test_snapshots_are_of_recognized_frames_some_time_ago():
    """The older one is from 5 to 10 frames before; until there is such a one, of the first frame."""
    models = [{"frame": number} for number in range(40)]
    memory = Memory(models[0], models[0])
    for number in range(1, 40):
        memory = memory.keep(models[number])
        age = number - memory.older["frame"]
        assert age == number if number < 2 * FRAMES_APART else FRAMES_APART <= age < 2 * FRAMES_APART
        assert memory.newer["frame"] - memory.older["frame"] in (0, FRAMES_APART)


def test_a_missed_frame_changes_no_snapshot():
    """As long as the target isn't recognized, the models from before verify."""
    tracker = followed(1)
    before = state_of(tracker).memory
    for _ in range(20):
        tracker.update(Frame(np.zeros((240, 320, 3), np.uint8)))
    assert state_of(tracker).missed_frames == 20
    assert state_of(tracker).memory is before


def test_the_same_models_find_the_same():
    """A match keeps its log-odds, to a part of them, where nothing has changed since."""
    tracker = followed(1)
    match = in_doubt(match_of(tracker, picture(1)))
    assert limit_log_odds(model_of(tracker), match) == match


def test_what_was_learned_since_is_verified_by_what_was_known():
    """A card that today's models know isn't the one that those of before knew."""
    before, today = followed(1), followed(2)
    match = in_doubt(match_of(today, picture(2)))
    limited = limit_log_odds(model_of(before), match)
    assert limited.log_odds < -3.0
    assert limited._replace(log_odds=match.log_odds) == match


@pytest.mark.parametrize("offset", [(20, 0), (-24, 0), (0, 20), (0, -24)], ids=str)
def test_a_target_seen_elsewhere_is_not_here(offset):
    """Models that see their target beside the match say so."""
    tracker = followed(1)
    match = in_doubt(match_of(tracker, picture(1, *offset)))
    assert limit_log_odds(model_of(tracker), match) == match
    elsewhere = match._replace(candidate=match.candidate._replace(right=0.0, down=0.0))
    assert limit_log_odds(model_of(tracker), elsewhere).log_odds == LOG_ODDS_ELSEWHERE


def test_a_match_of_high_log_odds_is_not_verified():
    """What has the log-odds that a missed target needs stays as it is."""
    before, today = followed(1), followed(2)
    match = match_of(today, picture(2))
    sure = log_odds_of(P.min_score_to_redetect)
    assert match.log_odds > sure
    assert limit_log_odds(model_of(before), match) is match
    least = match._replace(log_odds=sure - 0.01)
    assert limit_log_odds(model_of(before), least).log_odds < least.log_odds


@pytest.mark.parametrize("level", [0, 90])
def test_nothing_is_no_target(level):
    """In a picture without texture no place is the target's, however little is known of it yet."""
    tracker = FusedTracker()
    tracker.init(picture(1), TARGET.box)
    flat = Frame(np.full((240, 320, 3), level, np.uint8))
    statuses = [tracker.update(flat).status for _ in range(4)]
    assert statuses == 2 * [Status.OCCLUDED] + 2 * [Status.LOST]


def test_update_asks_the_memory(monkeypatch):
    """A target that the models as they were don't know isn't TRACKED, and nothing of it is learned."""
    monkeypatch.setattr(module, "log_odds_of", lambda score: math.inf)
    tracker, other = followed(1), followed(2)
    assert tracker.update(picture(1)).status is Status.TRACKED
    state = state_of(tracker)
    tracker._state = state.replace(memory=state_of(other).memory)
    assert tracker.update(picture(1)).status is Status.OCCLUDED
    assert state_of(tracker).models is state.models
