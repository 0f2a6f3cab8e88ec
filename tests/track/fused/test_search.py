# SPDX-License-Identifier: MIT
"""What the fused tracker takes for its lost target, of what is elsewhere in a frame."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, FusedTracker, Status
from tricue.track.fused import search
from tricue.track.fused.examine import Found
from tricue.track.fused.experts.depth import Measured
from tricue.track.fused.identity import Marks, probability
from tricue.track.fused.localize import Known, Place
from tricue.track.fused.params import FusedParams
from tricue.track.fused.search import Lost, anywhere
from tricue.track.fused.view import Target

P = FusedParams()
HERE, THERE = Target(100.0, 80.0, 40.0, 40.0), Target(160.0, 80.0, 40.0, 40.0)
ALIKE = Marks(sharpness=12.0, order=0.1, colors=1.0, contrast=0.7, first=0.9)
REPAINTED = ALIKE._replace(colors=0.0, contrast=-0.4)
REARRANGED = ALIKE._replace(sharpness=5.0, order=0.35, first=0.1)
DEPTH = Measured(2.0, 0.05, 1.0)


def found(
    target: Target, marks: Marks = ALIKE, odds: float | None = None, measured: Measured | None = None
) -> Found:
    """A place with these marks; odds: by color, or other ones."""
    odds = marks.log_odds("color") if odds is None else odds
    sight: Any = None
    return Found(target, sight, marks, odds, odds, 0.5, measured, 0.0, None, None)


NEAR = found(HERE, odds=-6.0)


@pytest.fixture
def search_among(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Found]:
    """What ``anywhere`` says if these are the whole frame's places, with evidence in their order."""

    def told(*others: Found, near: Found = NEAR, missed: int = 20) -> Found:
        def place(_: Known, view: int) -> Any:
            return Place(others[view].target, None, 0.0, 0.0, -float(view), (0.0, 0.0), 0.0, 0.0, None)

        monkeypatch.setattr(search, "_elsewhere", lambda *_: list(range(len(others)))[::-1])
        monkeypatch.setattr(search, "best_place", place)
        monkeypatch.setattr(search, "examine", lambda _, at: others[round(-at.evidence)])
        nothing: Any = None
        known = Known(nothing, None, None, HERE.side, P)
        return anywhere(known, nothing, Lost(HERE, None, missed, 0), near)

    return told


def test_the_target_elsewhere_is_taken(search_among):
    """What agrees in color and in structure is taken, in the box in which it was found."""
    assert search_among(found(THERE)).target == THERE


@pytest.mark.parametrize("marks", [REPAINTED, REARRANGED], ids=["structure alone", "color alone"])
def test_without_depth_color_and_structure_have_to_agree(marks, search_among):
    """What has the target's structure in other colors, or its colors in another structure, isn't taken,
    though the one that agrees would be enough alone.
    """
    other = found(THERE, marks)
    assert probability(max(other.log_odds, marks.by_structure)) > P.found_above
    assert search_among(other).target == HERE


def test_with_depth_structure_is_not_asked(search_among):
    """What is recognised with its depth is taken, whatever its structure alone says."""
    odds = ALIKE.log_odds("color")
    assert search_among(found(THERE, REARRANGED, odds, DEPTH)).target == THERE
    assert search_among(found(THERE, REARRANGED, odds)).target == HERE


def test_elsewhere_has_to_be_sure(search_among):
    """Elsewhere a score under found_above isn't taken, not even where near is nothing at all."""
    unsure, sure = found(HERE, odds=0.8), found(HERE, odds=0.9)  # ln(0.7 / 0.3) is 0.847
    nothing = found(HERE.moved(1.0, 0.0), odds=-40.0)
    assert search_among(unsure, near=nothing).target == nothing.target
    assert search_among(sure, near=nothing).target == sure.target


def test_farther_is_less_sure(search_among):
    """Odds fall by half of the squared distance, in the standard deviations that it can have gone by now."""
    reach = HERE.side * P.reach * 21
    for share in (0.0, 0.5, 1.0):
        other = found(HERE.moved(0.6 * share * reach, -0.8 * share * reach), odds=5.0)
        assert search_among(other).log_odds == pytest.approx(5 - share**2 / 2)


def test_later_it_may_be_farther(search_among):
    """What is too far away for a target that was there just now is taken when it was missed for long."""
    other = found(HERE.moved(150.0, 0.0), odds=4.0)
    assert search_among(other, missed=1).target == HERE
    assert search_among(other, missed=30).target == other.target


def test_near_is_judged_by_its_distance_too(search_among):
    """Of two that are as likely by their looks the one is taken that is nearer to where the target was."""
    far = found(HERE.moved(200.0, 0.0), odds=4.0)
    assert search_among(found(THERE, odds=4.0), near=far).target == THERE
    assert search_among(far, near=found(THERE, odds=4.0)).target == THERE


def test_those_with_most_evidence_are_examined(search_among):
    """Of all places only the first ``candidates`` by evidence are looked at, and the likeliest is taken."""
    poor, good = found(THERE, odds=1.0), found(THERE.moved(5.0, 0.0), odds=4.0)
    assert P.candidates == 2
    assert search_among(poor, good).target == good.target
    assert search_among(poor, poor, good).target == poor.target


@pytest.mark.parametrize("background", ["coffee", "cat", "motorcycle"])
def test_the_same_colors_are_not_enough(background, stage, follow):
    """The target's pixels, shuffled, 150 px away, aren't taken for it in 20 frames; in order they are."""
    tracker = FusedTracker()
    before = stage([(100 + 3.0 * i, 90.0) for i in range(12)], background)
    follow(tracker, before + 5 * [np.zeros_like(before[0])], Box(100, 90, 50, 63))
    frames = stage(20 * [(220.0, 20.0)], background)
    for frame in frames:
        assert tracker.update(shuffled(frame)).status is not Status.TRACKED
    assert [tracker.update(frame) for frame in frames][-1].status is Status.TRACKED


def shuffled(frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A copy whose face at (220, 20) has its pixels in another order, the same in each frame."""
    other = frame.copy()
    face = other[20:83, 220:270]
    face[:] = np.random.default_rng(0).permutation(face.reshape(-1, 3)).reshape(face.shape)
    return other
