# SPDX-License-Identifier: MIT
"""That the outline learns where the target's pixels end, and goes with the blocks."""

import pytest
from tricue import FlowDepthTracker
from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.outline import OUTLINE_RATE, PixelOutline

WINDOW = (50.0, 20.0, 80.0, 110.0)
BLOCKS = Blocks.of(WINDOW, FlowDepthTracker.Params())


def test_the_first_outline_is_the_window():
    """Before any pixel is known the outline is the window it was given."""
    assert PixelOutline.of(WINDOW, BLOCKS).rectangle(BLOCKS) == pytest.approx(WINDOW)


def test_each_side_learns_by_itself():
    """A frame moves every side by a fifth of what it is off, another side by nothing."""
    learned = PixelOutline.of(WINDOW, BLOCKS).learned((55.0, 20.0, 70.0, 110.0), BLOCKS).rectangle(BLOCKS)
    assert learned == pytest.approx((50 + 5 * OUTLINE_RATE, 20, 80 - 10 * OUTLINE_RATE, 110))


def test_it_ends_at_the_pixels():
    """Where pixels end at one place for long the outline is there, to 1 %."""
    pixels = (60.0, 30.0, 75.0, 100.0)
    outline = PixelOutline.of(WINDOW, BLOCKS)
    for _ in range(40):
        outline = outline.learned(pixels, BLOCKS)
    assert outline.rectangle(BLOCKS) == pytest.approx(pixels, rel=0.01)


def test_it_moves_and_grows_with_the_blocks():
    """The outline goes with the blocks, and is larger as they are, round their anchor."""
    outline = PixelOutline.of(WINDOW, BLOCKS)
    assert outline.rectangle(BLOCKS.moved(7, -3)) == pytest.approx((57, 17, 87, 107))
    assert outline.rectangle(BLOCKS._replace(size=2.0)) == pytest.approx((35, -25, 95, 155))


def test_what_is_learned_large_is_kept_for_small():
    """Pixels seen while the target is twice as large teach the outline that it has at any size."""
    large = BLOCKS._replace(size=2.0)
    outline = PixelOutline.of(WINDOW, BLOCKS)
    for _ in range(60):
        outline = outline.learned((45.0, -5.0, 85.0, 135.0), large)
    assert outline.rectangle(BLOCKS) == pytest.approx((55, 30, 75, 100), abs=0.01)
