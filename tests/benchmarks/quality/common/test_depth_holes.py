# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common import depth_holes

FX, BASELINE = 500.0, 0.06


def test_field_of_view_leaves_margins_out():
    """What never has depth at the borders is outside; holes inside are not."""
    measured = np.ones((3, 40, 60), bool)
    measured[:, :5] = measured[:, :, -7:] = False
    measured[1, 20:30, 20:30] = False
    assert depth_holes.field_of_view(measured) == (slice(5, 40), slice(0, 53))


def test_shares_by_brightness():
    """Each share is of the pixels of its brightness."""
    gray = np.array([[10, 10, 100, 100, 100, 100, 250, 250]], np.uint8)
    measured = np.array([[False, True, False, True, True, True, True, True]])
    assert depth_holes.hole_shares(measured, gray) == (0.25, 0.5, 0.25, 0.0)
    assert np.isnan(depth_holes.hole_shares(measured[:, :2], gray[:, :2]).bright)


@pytest.mark.parametrize("at_left", [True, False])
def test_a_shadow_tells_the_baseline(at_left):
    """A gap of f b (1/near - 1/far) pixels on one side of a board, none on the other."""
    depth = np.full((30, 200), 2.0)
    depth[:, 80:120] = 0.8
    width = round(FX * BASELINE * (1 / 0.8 - 1 / 2.0))
    depth[:, slice(80 - width, 80) if at_left else slice(120, 120 + width)] = np.nan
    steps = depth_holes.find_steps(depth)
    shadow = depth_holes.measure_shadow(steps, at_left, FX)
    assert (shadow.steps, shadow.share, shadow.width) == (30, 1.0, width)
    assert shadow.baseline == pytest.approx(BASELINE, rel=0.05)
    other = depth_holes.measure_shadow(steps, not at_left, FX)
    assert (other.steps, other.share, other.baseline) == (30, 0.0, 0.0)


def test_steps_stay_within_their_row():
    """The end of one row and the start of the next are no step, nor are small differences."""
    depth = np.tile(np.linspace(1.0, 3.0, 100), (4, 1))
    assert len(depth_holes.find_steps(depth).gap) == 0


def test_holes_are_filled_from_the_farther_side():
    """As a shadow lies on what is behind; at the image's border from the only side."""
    depth = np.array([[np.nan, 2.0, np.nan, np.nan, 1.0, np.nan, 3.0, np.nan]])
    assert depth_holes.fill_holes(depth).tolist() == [[2, 2, 2, 2, 1, 3, 3, 3]]
