# SPDX-License-Identifier: MIT
"""Which match elsewhere in a frame the fused tracker takes for its lost target."""

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, FusedTracker, Status
from tricue.track.fused.experts.depth import DepthMeasurement
from tricue.track.fused.identity import APPEARANCE, STRUCTURE, IdentityFeatures, log_odds_of, score_of
from tricue.track.fused.localize import Candidate, LocalizationModel
from tricue.track.fused.measure import Match, Recognition
from tricue.track.fused.params import FusedParams
from tricue.track.fused.proposals import LostTarget
from tricue.track.fused.redetect import redetect
from tricue.track.fused.target import Target

P = FusedParams()
HERE, THERE = Target(100.0, 80.0, 40.0, 40.0), Target(160.0, 80.0, 40.0, 40.0)
ALIKE = IdentityFeatures(peak_sharpness=12.0, color_similarity=1.0, contrast=0.7, first_response=0.9)
REPAINTED = ALIKE._replace(color_similarity=0.0, contrast=-0.4)
REARRANGED = ALIKE._replace(peak_sharpness=9.0, first_response=0.45)
DEPTH = DepthMeasurement(2.0, 0.05, 1.0)


def match(
    target: Target,
    features: IdentityFeatures = ALIKE,
    odds: float | None = None,
    measured: DepthMeasurement | None = None,
) -> Match:
    """A match with these features; odds: its log-odds, by default those by color."""
    odds = features.log_odds(ALIKE, APPEARANCE) if odds is None else odds
    structure = features.log_odds(ALIKE, STRUCTURE)
    unused: Any = None
    candidate = Candidate(target, unused, 0.0, 0.0, 0.0, 0.5, unused, features)
    return Match(candidate, target, odds, structure, measured, 0.0)


NEAR = match(HERE, odds=-6.0)


NEEDED = log_odds_of(P.min_score_to_redetect)
module = importlib.import_module(redetect.__module__)


@pytest.fixture
def search_among(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Match]:
    """``redetect`` where these are the whole frame's matches, with evidence in their order."""

    def among(
        *others: Match, near: Match = NEAR, missed_frames: int = 20, min_log_odds: float = NEEDED
    ) -> Match:
        def localized(_: LocalizationModel, window: int) -> Any:
            other = others[window]
            return Candidate(
                other.target, None, 0.0, 0.0, -float(window), 0.0, None, other.candidate.features
            )

        monkeypatch.setattr(module, "propose_windows", lambda *_: list(range(len(others)))[::-1])
        monkeypatch.setattr(module, "localize", localized)

        def recognized(_: LocalizationModel, at: Candidate) -> Recognition:
            other = others[round(-at.evidence)]
            return Recognition(at, other.log_odds, other.structure_log_odds)

        monkeypatch.setattr(module, "recognize", recognized)

        def measured(_: LocalizationModel, found: Recognition) -> Match:
            among.measured.append(others[round(-found.candidate.evidence)])
            return among.measured[-1]

        monkeypatch.setattr(module, "measure", measured)
        nothing: Any = None
        model = LocalizationModel(nothing, None, HERE.side, ALIKE, P)
        lost = LostTarget(HERE, None, missed_frames, 0)
        return redetect(model, nothing, lost, near, min_log_odds)

    among.measured = []
    return among


def test_the_target_elsewhere_is_taken(search_among):
    """A match in color and in structure is taken, in the box in which it was found."""
    assert search_among(match(THERE)).target == THERE


@pytest.mark.parametrize("measured", [None, DEPTH], ids=["color", "depth"])
@pytest.mark.parametrize("features", [REPAINTED, REARRANGED], ids=["structure alone", "color alone"])
def test_color_and_structure_have_to_agree(features, measured, search_among):
    """What has the target's structure in other colors, or its colors in another structure, isn't taken,
    though the one that agrees would be enough alone; whether its depth is known or not.
    """
    other = match(THERE, features, measured=measured)
    assert score_of(max(other.log_odds, other.structure_log_odds)) > P.min_score_to_redetect
    assert search_among(other).target == HERE


@pytest.mark.parametrize("measured", [None, DEPTH], ids=["color", "depth"])
def test_structure_of_known_size_is_as_likely_anywhere(measured, search_among):
    """With depth the distance counts against the log-odds alone, else against those of the structure, too."""
    sigma = HERE.side * P.lost_position_noise * 21
    far = match(HERE.shift(3.0 * sigma, 0.0), odds=20.0, measured=measured)
    structure = far.structure_log_odds - (4.5 if measured is None else 0.0)
    assert search_among(far).log_odds == pytest.approx(min(20 - 4.5, structure))


def test_elsewhere_needs_a_high_score(search_among):
    """Elsewhere fewer log-odds than are needed aren't enough, even if there is nothing like it nearby."""
    nothing = match(HERE.shift(1.0, 0.0), odds=-40.0)
    for needed in (NEEDED, 1.0):
        unlikely, likely = match(HERE, odds=needed - 0.01), match(HERE, odds=needed + 0.01)
        assert search_among(unlikely, near=nothing, min_log_odds=needed).target == nothing.target
        assert search_among(likely, near=nothing, min_log_odds=needed).target == likely.target


def test_the_best_that_was_seen_is_told(search_among):
    """By the lower of both log-odds of places elsewhere, taken or not; near, without the distance."""
    others = match(THERE, REPAINTED), match(THERE, REARRANGED)
    expected = max(min(each.log_odds, each.structure_log_odds) for each in others)
    nothing = match(HERE.shift(HERE.side, 0.0), odds=-40.0)
    assert search_among(*others, near=nothing).best_seen == expected
    near = match(HERE.shift(HERE.side, 0.0), odds=1.0)
    assert search_among(match(THERE, odds=-3.0), near=near).best_seen == 1.0


def test_farther_is_less_likely(search_among):
    """Log-odds fall by half of the squared distance, in standard deviations of where it can be by now."""
    sigma = HERE.side * P.lost_position_noise * 21
    for share in (0.0, 0.5, 1.0):
        other = match(HERE.shift(0.6 * share * sigma, -0.8 * share * sigma), odds=5.0)
        assert search_among(other).log_odds == pytest.approx(5 - share**2 / 2)


def test_later_it_may_be_farther(search_among):
    """What is too far away for a target that was missed in one frame is taken when it was missed in many."""
    other = match(HERE.shift(150.0, 0.0), odds=4.0)
    assert search_among(other, missed_frames=1).target == HERE
    assert search_among(other, missed_frames=30).target == other.target


def test_the_local_match_is_penalized_by_its_distance_too(search_among):
    """Of two with the same log-odds by appearance the one nearer to where the target was is taken."""
    far = match(HERE.shift(200.0, 0.0), odds=4.0)
    assert search_among(match(THERE, odds=4.0), near=far).target == THERE
    assert search_among(far, near=match(THERE, odds=4.0)).target == THERE


def test_those_with_most_evidence_are_recognized(search_among):
    """Of all places only the first ``candidates`` by evidence are looked at closely, and the likeliest is
    taken.
    """
    poor, good = match(THERE, odds=4.0), match(THERE.shift(5.0, 0.0), odds=7.0)
    assert P.candidates == 2
    assert search_among(poor, good).target == good.target
    third = search_among(poor, poor, good)
    assert third.target == poor.target
    assert third.best_seen == 4


@pytest.mark.parametrize("features", [REPAINTED, REARRANGED], ids=["structure alone", "color alone"])
def test_what_looks_otherwise_is_not_measured(features, search_among):
    """Size and depth are measured only of what looks enough like the target."""
    good = match(THERE)
    search_among(match(THERE.shift(5.0, 0.0), features), good)
    assert search_among.measured == [good]


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
    """A copy whose face at (220, 20) has its pixels in another rank_distance, the same in each frame."""
    other = frame.copy()
    face = other[20:83, 220:270]
    face[:] = np.random.default_rng(0).permutation(face.reshape(-1, 3)).reshape(face.shape)
    return other
