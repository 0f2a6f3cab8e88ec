# SPDX-License-Identifier: MIT
import numpy as np
from tricue import Status
from tricue.draw.canvas import STATUS_COLORS
from tricue.draw.status_strip import AHEAD, MIN_HEIGHT, StatusStrip

STATUSES = [Status.TRACKED, Status.TRACKED, Status.OCCLUDED, Status.LOST]


def drawn(length: int | None, line: int = 0) -> np.ndarray:
    """Four statuses on a white canvas of 80 columns."""
    strip = StatusStrip(length)
    for status in STATUSES:
        strip.add(status)
    canvas = np.full((100, 80, 3), 255, np.uint8)
    strip.draw(canvas, line)
    return canvas


def test_each_frame_has_its_part() -> None:
    """It proves that colors stand where their frames are in the whole, and what is to come is dark."""
    bottom = drawn(8)[-1]
    expected = [STATUS_COLORS[status] for status in STATUSES] + [AHEAD] * 4
    assert [tuple(bottom[column].tolist()) for column in range(5, 80, 10)] == expected


def test_without_a_length_it_is_full() -> None:
    """It proves that a live video's strip shows all until now."""
    bottom = drawn(None)[-1]
    assert [tuple(bottom[column].tolist()) for column in range(10, 80, 20)] == [
        STATUS_COLORS[status] for status in STATUSES
    ]


def test_lines_lie_above_each_other() -> None:
    """It proves that a second target's strip leaves the first one's free, and the picture above."""
    first, second = (np.flatnonzero((drawn(4, line) != 255).any(axis=(1, 2))) for line in (0, 1))
    assert first.tolist() == list(range(100 - MIN_HEIGHT - 1, 100))
    assert second.tolist() == list(range(100 - 2 * MIN_HEIGHT - 2, 100 - MIN_HEIGHT - 1))
    for line in (0, 1):
        assert not drawn(4, line)[100 - (line + 1) * (MIN_HEIGHT + 1)].any()  # a black line above each
