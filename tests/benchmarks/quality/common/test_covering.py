# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.box import Box

from benchmarks.quality.common.covering import cover

COLUMNS = np.broadcast_to(np.arange(100, dtype=np.uint8), (60, 100))
"""An image whose values are the column."""


def test_the_part_beside_covers_the_box():
    """With 15 % of its sides around it, from the right; the rest and the image itself stay as they were."""
    image = COLUMNS.copy()
    covered = cover(image, Box(20, 20, 20, 10))
    changed = np.zeros(image.shape, bool)
    changed[18:32, 17:43] = True
    np.testing.assert_array_equal(covered, np.where(changed, COLUMNS + 26, COLUMNS))
    np.testing.assert_array_equal(image, COLUMNS)


@pytest.mark.parametrize(
    ("image", "box", "shift"),
    [
        (COLUMNS, Box(70, 20, 20, 10), -26),  # no room to the right
        (COLUMNS.T, Box(20, 5, 20, 20), 26),  # nor to the left, in 60 columns: from below
        (COLUMNS.T, Box(20, 70, 20, 20), -26),
    ],
)
def test_the_cover_is_from_inside_the_image(image, box, shift):
    """From another side where the image ends; what is beside the box is a shift away."""
    x, y = (round(each) for each in box.center)
    box = box if shift == -26 and image is COLUMNS else box._replace(x=10, width=40)
    assert int(cover(image, box)[y, x]) == int(image[y, x]) + shift


def test_the_mean_color_covers_what_is_too_large():
    """Where the box fills the image, and its colors are the channels' means."""
    image = np.dstack([COLUMNS, COLUMNS // 2, np.full_like(COLUMNS, 7)])
    covered = cover(image, Box(-10, -10, 120, 80))
    np.testing.assert_array_equal(covered, np.broadcast_to([49, 24, 7], covered.shape))


@pytest.mark.parametrize("box", [Box(-50, 5, 20, 20), Box(200, 5, 20, 20), Box(5, 90, 20, 20)])
def test_a_box_outside_covers_nothing(box):
    """On either side of the image."""
    np.testing.assert_array_equal(cover(COLUMNS, box), COLUMNS)
