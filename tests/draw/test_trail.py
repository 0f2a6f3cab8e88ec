# SPDX-License-Identifier: MIT
"""The trail is where the box's center was, fainter with age, and broken where the target was lost."""

import numpy as np
import pytest
from tricue import Box, Status, Track
from tricue.draw.trail import Trail

COLOR = (0, 200, 255)


def walked(trail: Trail, count: int = 20, lost: range = range(0)) -> np.ndarray:
    """The picture after a target has gone right by 10 px each tenth of a second."""
    for at in range(count):
        status = Status.LOST if at in lost else Status.TRACKED
        trail.add(at / 10, Track(Box(10 * at, 90, 20, 20), 1.0, status))
    canvas = np.full((200, 240, 3), 100, np.uint8)
    trail.draw(canvas, 1, COLOR)
    return canvas


def test_it_fades_and_ends() -> None:
    """It proves that the newest part has the color, older parts less of it, and what is too old is gone."""
    canvas = walked(Trail(1.0))
    red = canvas[100, :, 2].astype(int)
    assert red[198] > 240
    assert red[198] > red[160] > red[130] > 105
    assert (canvas[:, :95] == 100).all()  # a second before the last frame the center was at 100
    assert (canvas[:90] == 100).all()
    assert (canvas[110:] == 100).all()


def test_it_is_broken_where_the_target_was_lost() -> None:
    """It proves that no line leads over the frames in which nobody knows where the target was."""
    canvas = walked(Trail(2.0), lost=range(8, 12))
    assert (canvas[:, 84:126] == 100).all()
    assert canvas[100, 70, 2] > 120
    assert canvas[100, 150, 2] > 120


def test_it_is_enlarged_with_the_picture() -> None:
    """It proves that it is drawn in the pixels of the enlarged picture, also where that ends before it."""
    trail = Trail()
    for at in range(5):
        trail.add(at / 10, Track(Box(20 * at, 20, 20, 20), 1.0, Status.TRACKED))
    canvas = np.zeros((120, 160, 3), np.uint8)
    trail.draw(canvas, 2, COLOR)
    assert canvas[60, 100, 2] > 100
    assert not canvas[:45].any()
    outside = np.zeros((20, 10, 3), np.uint8)
    trail.draw(outside, 2, COLOR)
    assert not outside.any()


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf")])
def test_it_needs_a_time(seconds: float) -> None:
    """It proves that no time is refused."""
    with pytest.raises(ValueError, match="trail"):
        Trail(seconds)
