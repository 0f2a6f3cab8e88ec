# SPDX-License-Identifier: MIT
"""The log-odds that a place shows the target, and the colors that they are computed from."""

import math

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.identity import (
    APPEARANCE,
    SCORE_OFFSET,
    SCORE_SLOPE,
    SECOND_FRAME,
    STRUCTURE,
    IdentityFeatures,
    color_histogram,
    in_any_light,
    log_odds_of,
    score_of,
)
from tricue.track.fused.params import FusedParams
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target
from tricue.track.fused.window import Window, extract_window

AVERAGE = IdentityFeatures(peak_sharpness=5.0, color_similarity=0.6, contrast=0.2, first_response=0.3)
TYPICAL = IdentityFeatures(peak_sharpness=7.0, color_similarity=0.8, contrast=0.4, first_response=0.5)
PERFECT = IdentityFeatures(peak_sharpness=12.0, color_similarity=1.0, contrast=0.6, first_response=1.0)
EMPTY = IdentityFeatures(peak_sharpness=0.0, color_similarity=0.0, contrast=-0.1, first_response=0.0)
CAMERA = Intrinsics.from_fov(160, 120, 60)
RED, BLUE = (20, 30, 220), (210, 40, 20)


def window_of(left: tuple[int, int, int], right: tuple[int, int, int]) -> Window:
    """A window at the center of a picture of two colors."""
    picture = np.full((120, 160, 3), left, np.uint8)
    picture[:, 80:] = right
    observation = PictureObservation(kernel_sets.load("native"), picture, CAMERA, None, None)
    return extract_window(observation, Target(80.0, 60.0, 24.0, 24.0), 3.0)


@pytest.mark.parametrize("typical", [None, TYPICAL], ids=["nothing typical yet", "typical"])
@pytest.mark.parametrize("feature", IdentityFeatures._fields)
def test_odds_are_monotone(feature, typical):
    """A feature nearer to the target's raises the log-odds by appearance, never lowers those by structure."""
    better = AVERAGE._replace(**{feature: getattr(AVERAGE, feature) + 0.1})
    assert better.log_odds(typical, APPEARANCE) > AVERAGE.log_odds(typical, APPEARANCE)
    assert better.log_odds(typical, STRUCTURE) >= AVERAGE.log_odds(typical, STRUCTURE)


@pytest.mark.parametrize("weights", [APPEARANCE, STRUCTURE], ids=["appearance", "structure"])
@pytest.mark.parametrize("typical", [None, TYPICAL], ids=["nothing typical yet", "typical"])
def test_odds_separate_perfect_from_empty(typical, weights):
    """A perfect place has a probability that is enough anywhere, an empty one is never recognized; not by its
    structure alone, either.
    """
    empty = EMPTY.log_odds(typical, weights)
    recognized_by = in_any_light(-math.inf, empty) if weights is STRUCTURE else empty
    assert score_of(PERFECT.log_odds(typical, weights)) > FusedParams().min_score_to_redetect
    assert score_of(recognized_by) < FusedParams().min_score


def test_a_drop_lowers_the_odds():
    """The same features tell more against the target that had better ones than against one that never had; of
    one of which nothing is known as much as against most in their second frame.
    """
    for weights in (APPEARANCE, STRUCTURE):
        assert AVERAGE.log_odds(PERFECT, weights) < AVERAGE.log_odds(AVERAGE, weights) - 1
        assert AVERAGE.log_odds(SECOND_FRAME, weights) == AVERAGE.log_odds(None, weights)


def test_structure_does_not_depend_on_colors():
    """Colors and their contrast, which light changes, don't change the log-odds of structure."""
    other = AVERAGE._replace(color_similarity=0.0, contrast=-0.4)
    assert other.log_odds(TYPICAL, STRUCTURE) == AVERAGE.log_odds(TYPICAL, STRUCTURE)
    assert other.log_odds(TYPICAL, APPEARANCE) < AVERAGE.log_odds(TYPICAL, APPEARANCE)


def test_blend_moves_by_a_share():
    """Blended by a rate, each feature moves by that share of the difference."""
    middle = EMPTY.blend(PERFECT, 0.5)
    assert middle == pytest.approx([(a + b) / 2 for a, b in zip(EMPTY, PERFECT, strict=True)])
    assert EMPTY.blend(PERFECT, 0.0) == EMPTY


@pytest.mark.parametrize("log_odds", [-20.0, -3.0, 0.0, 0.7, 4.0, 20.0])
def test_score_is_the_probability_of_calibrated_odds(log_odds):
    """A score's own log-odds are a line over those of the features, and go back to these."""
    score = score_of(log_odds)
    assert math.log(score / (1 - score)) == pytest.approx(SCORE_SLOPE * log_odds + SCORE_OFFSET)
    assert log_odds_of(score) == pytest.approx(log_odds, abs=1e-3)


@pytest.mark.parametrize("score", [0.0, 1.0])
def test_certainty_has_finite_log_odds(score):
    """A threshold of 0 or 1 can be computed with."""
    assert score_of(log_odds_of(score)) == pytest.approx(score, abs=1e-12)


@pytest.mark.parametrize("log_odds", [1e300, -1e300, math.inf, -math.inf, 800.0, -800.0])
def test_score_has_no_overflow(log_odds):
    """Whatever the log-odds, it is a probability, and the higher the more they tell for the target."""
    assert 0 <= score_of(log_odds) <= 1
    assert (score_of(log_odds) > score_of(0.0)) == (log_odds > 0)


def test_colors_are_a_distribution():
    """The histogram sums to 1 and has the picture's two colors alone, at half each at the center."""
    colors = color_histogram(window_of(RED, BLUE))
    assert colors.shape == (4096,)
    assert colors.sum() == pytest.approx(1, abs=1e-5)
    assert np.sort(colors)[-2:] == pytest.approx([0.5, 0.5], abs=0.06)
