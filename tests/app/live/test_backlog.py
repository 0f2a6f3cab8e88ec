# SPDX-License-Identifier: MIT
"""The frames since the one that someone draws in are kept, at a lower rate where they are too many."""

import numpy as np
import pytest
from tricue import Frame
from tricue.app.live import backlog
from tricue.app.live.backlog import Backlog


def frame() -> Frame:
    """A frame of 30 kB."""
    return Frame(np.zeros((100, 100, 3), np.uint8))


def test_old_frames_go() -> None:
    """It proves that frames of more than two seconds ago are gone, and a box in one is refused in a line."""
    kept = Backlog()
    for number in range(100):
        kept.add(number, number / 10, frame())
    assert [number for number, _ in kept.since(-1)] == list(range(79, 100))
    assert kept.since(97)[0][0] == 98
    with pytest.raises(ValueError, match="the frame is gone; draw the box in the picture that is shown now"):
        kept.get(50)


def test_a_held_frame_stays() -> None:
    """It proves that a frame that is held stays with those after it, until nobody holds it."""
    kept = Backlog()
    for number in range(100):
        kept.add(number, number / 10, frame())
        if number == 10:
            kept.hold("a page", 5)
            kept.hold("another", 9)
    assert [number for number, _ in kept.since(-1)] == list(range(5, 100))
    kept.hold("a page", None)
    kept.add(100, 10.0, frame())
    assert kept.since(-1)[0][0] == 9
    kept.hold("another", None)
    kept.add(101, 10.1, frame())
    assert kept.since(-1)[0][0] == 81


def test_memory_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a frame held for long costs no more than the limit: frames between go, evenly."""
    monkeypatch.setattr(backlog, "MAX_BYTES", 20 * 30000)
    kept = Backlog()
    kept.add(0, 0.0, frame())
    kept.hold("a page", 0)
    for number in range(1, 500):
        kept.add(number, number / 10, frame())
        numbers = [at for at, _ in kept.since(-1)]
        assert len(numbers) <= 20
        assert (numbers[0], numbers[-1]) == (0, number)
    assert max(np.diff(numbers)) < 70
    kept.hold("a page", None)
    kept.add(500, 50.0, frame())
    assert kept.since(-1)[0][0] >= 480


def test_without_a_hold_the_oldest_go(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that the newest frames are whole where nobody holds any."""
    monkeypatch.setattr(backlog, "MAX_BYTES", 10 * 30000)
    kept = Backlog()
    for number in range(50):
        kept.add(number, number / 1000, frame())
    assert [at for at, _ in kept.since(-1)] == list(range(40, 50))


def test_frames_too_large_to_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that held frames that alone are too much don't stop the camera."""
    monkeypatch.setattr(backlog, "MAX_BYTES", 2 * 30000)
    kept = Backlog()
    for number in range(9):
        kept.add(number, 0.0, frame())
        kept.hold(number, number)
    assert len(kept.since(-1)) == 2
