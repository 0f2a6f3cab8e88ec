# SPDX-License-Identifier: MIT
"""Whether what was found is the target: the odds, and the colors and ranks that they are made from."""

import math

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.identity import TRUST, Identity, Marks, colors_of, probability
from tricue.track.fused.sight import Sight
from tricue.track.fused.view import Target, View, look

MIDDLING = Marks(sharpness=5.0, order=0.2, colors=0.6, contrast=0.2, first=0.3)
BETTER = {"sharpness": 1, "order": -1, "colors": 1, "contrast": 1, "first": 1}
CAMERA = Intrinsics.from_fov(160, 120, 60)
RED, BLUE = (20, 30, 220), (210, 40, 20)


def view_of(left: tuple[int, int, int], right: tuple[int, int, int]) -> View:
    """A picture of two colors, looked at in its middle."""
    picture = np.full((120, 160, 3), left, np.uint8)
    picture[:, 80:] = right
    sight = Sight(kernel_sets.load("native"), picture, "color", CAMERA, None, None)
    return look(sight, [Target(80.0, 60.0, 24.0, 24.0)], 3.0)[0]


@pytest.mark.parametrize("channels", TRUST)
@pytest.mark.parametrize("mark", Marks._fields)
def test_odds_are_monotone(mark, channels):
    """A mark that speaks for the target makes it likelier, and never less likely by structure."""
    value = getattr(MIDDLING, mark)
    better = MIDDLING._replace(**{mark: value + 0.1 * BETTER[mark]})
    assert better.log_odds(channels) > MIDDLING.log_odds(channels)
    assert better.by_structure >= MIDDLING.by_structure


@pytest.mark.parametrize("channels", TRUST)
def test_odds_tell_both_ways(channels):
    """A perfect place is believed, and an empty one isn't, with each set of channels."""
    perfect = Marks(sharpness=12.0, order=0.0, colors=1.0, contrast=0.6, first=1.0)
    empty = Marks(sharpness=2.0, order=0.35, colors=0.0, contrast=-0.1, first=0.0)
    assert probability(perfect.log_odds(channels)) > 0.9
    assert probability(empty.log_odds(channels)) < 0.1


def test_depth_lets_marks_tell_less():
    """The same marks are less sure with depth, whose contrasts are higher, than in color alone."""
    assert MIDDLING.log_odds("both") < MIDDLING.log_odds("color")
    perfect = Marks(sharpness=12.0, order=0.0, colors=1.0, contrast=0.6, first=1.0)
    assert perfect.log_odds("depth") < perfect.log_odds("both") < perfect.log_odds("color")


def test_structure_does_not_ask_colors():
    """Other light changes colors and their contrast, and nothing that is told by structure."""
    other = MIDDLING._replace(colors=0.0, contrast=-0.4)
    assert other.by_structure == MIDDLING.by_structure
    assert other.log_odds("color") < MIDDLING.log_odds("color")


def test_structure_tells_both_ways():
    """By structure alone a perfect place is believed, and an empty one isn't."""
    perfect = Marks(sharpness=12.0, order=0.0, colors=0.0, contrast=0.0, first=1.0)
    empty = Marks(sharpness=2.0, order=0.35, colors=1.0, contrast=0.6, first=0.0)
    assert probability(perfect.by_structure) > 0.9
    assert probability(empty.by_structure) < 0.1


def test_unknown_channels_are_refused():
    """Odds are told for color, both and depth, and for nothing else."""
    assert set(TRUST) == {"color", "both", "depth"}
    with pytest.raises(KeyError, match="pair"):
        MIDDLING.log_odds("pair")


@pytest.mark.parametrize("odds", [0.01, 0.5, 1.0, 3.0, 99.0])
def test_probability_is_that_of_the_odds(odds):
    """Log-odds of a to b are a / (a + b); those against give the complement."""
    assert probability(math.log(odds)) == pytest.approx(odds / (1 + odds))
    assert probability(-math.log(odds)) == pytest.approx(1 - probability(math.log(odds)))


@pytest.mark.parametrize("log_odds", [1e300, -1e300, math.inf, -math.inf, 800.0, -800.0])
def test_probability_has_no_overflow(log_odds):
    """However sure, it is a probability."""
    assert 0 <= probability(log_odds) <= 1
    assert (probability(log_odds) > 0.5) == (log_odds > 0)


def test_colors_are_a_distribution():
    """The histogram sums to 1 and has the picture's two colors alone, at half each in the middle."""
    colors = colors_of(view_of(RED, BLUE), 0.0, 0.0)
    assert colors.shape == (4096,)
    assert colors.sum() == pytest.approx(1, abs=1e-5)
    assert np.sort(colors)[-2:] == pytest.approx([0.5, 0.5], abs=0.06)


def test_likeness_is_bhattacharyyas():
    """It is 1 on the first frame's colors, 0 on others, and the root of the share on half of them."""
    identity = Identity.start(view_of(RED, RED), np.zeros((3, 4), np.float32))
    assert identity.likeness(view_of(RED, RED), 0.0, 0.0) == pytest.approx(1, abs=1e-5)
    assert identity.likeness(view_of(BLUE, BLUE), 0.0, 0.0) == pytest.approx(0, abs=1e-5)
    assert identity.likeness(view_of(RED, BLUE), 0.0, 0.0) == pytest.approx(math.sqrt(0.5), abs=0.05)
    assert identity.likeness(view_of(RED, BLUE), -15.0, 0.0) == pytest.approx(1, abs=1e-5)
    assert identity.likeness(view_of(RED, BLUE), 15.0, 0.0) == pytest.approx(0, abs=1e-5)


def test_ranks_are_learnt_and_colors_are_not():
    """Ranks move a tenth of the way to those found, their distance with them; colors stay the first ones."""
    identity = Identity.start(view_of(RED, BLUE), np.zeros((3, 4), np.float32))
    seen = np.full((3, 4), 0.5, np.float32)
    assert identity.order(seen) == pytest.approx(0.5)
    learnt = identity.learnt(seen, 0.1)
    np.testing.assert_allclose(learnt.ranks, 0.05, rtol=1e-6)
    assert learnt.order(seen) == pytest.approx(0.45)
    np.testing.assert_array_equal(learnt.roots, identity.roots)
    np.testing.assert_array_equal(identity.ranks, 0)
