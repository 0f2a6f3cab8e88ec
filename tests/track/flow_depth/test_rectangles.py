# SPDX-License-Identifier: MIT
"""That rectangles move, grow, and are turned into whole cells of an image."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.track.flow_depth.rectangles import around, cells_of, grown, moved

SHAPE = (12, 20)
numbers = st.floats(-1e6, 1e6)


def test_moving_and_growing():
    """A rectangle moves without growing, and grows to both sides alike; less than nothing shrinks it."""
    assert moved((1, 2, 5, 9), 3, -1) == (4, 1, 8, 8)
    assert grown((1, 2, 5, 9), 3, 1) == (-2, 1, 8, 10)
    assert grown((1, 2, 5, 9), -1, -2) == (2, 4, 4, 7)


@pytest.mark.parametrize(
    ("rectangle", "region"),
    [
        ((2.0, 3.0, 5.0, 7.0), (2, 3, 5, 7)),
        ((2.1, 3.9, 4.1, 6.2), (2, 3, 5, 7)),
        ((-5.0, -5.0, 99.0, 99.0), (0, 0, 20, 12)),
        ((18.5, 10.5, 30.0, 30.0), (18, 10, 20, 12)),
        ((2.5, 3.5, 2.5, 3.5), (2, 3, 3, 4)),
    ],
)
def test_every_cell_that_it_touches(rectangle, region):
    """The region is that of all cells that the rectangle touches and that the picture has."""
    assert cells_of(rectangle, SHAPE) == region


def test_around_two_is_the_smallest_that_holds_both():
    """Each side is the outermost of the two."""
    assert around((1, 2, 5, 9), (3, -4, 4, 20)) == (1, -4, 5, 20)


@given(numbers, numbers, st.floats(0, 1e6), st.floats(0, 1e6))
def test_any_region_is_one_of_the_picture(x, y, width, height):
    """Whatever the rectangle, corners are in order and in the picture, and every cell whose center lies in
    it is in the region.
    """
    x0, y0, x1, y1 = cells_of((x, y, x + width, y + height), SHAPE)
    assert 0 <= x0 <= x1 <= SHAPE[1]
    assert 0 <= y0 <= y1 <= SHAPE[0]
    columns, rows = np.arange(SHAPE[1]) + 0.5, np.arange(SHAPE[0]) + 0.5
    for centers, low, high, first, last in ((columns, x, x + width, x0, x1), (rows, y, y + height, y0, y1)):
        within = np.flatnonzero((centers > low) & (centers < high))
        assert all(first <= index < last for index in within)


@pytest.mark.parametrize(
    "rectangle", [(20, 0, 25, 5), (-9, 0, -1, 5), (0, 12, 5, 13), (0, -9, 5, 0), (1e9, 0, 2e9, 5)]
)
def test_outside_there_are_no_cells(rectangle):
    """A rectangle outside the picture has an empty region."""
    x0, y0, x1, y1 = cells_of(rectangle, SHAPE)
    assert (x1 - x0) * (y1 - y0) == 0
