# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.papers.sabeti_depth.figures import FRAMES_SHOWN, choose_frames

pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install tricue[demo]")


def test_frames_of_somebody_who_is_always_seen_are_even():
    """From the first to the last, evenly spaced."""
    frames = choose_frames(np.ones(51))
    assert frames == [0, 10, 20, 30, 40, 50]
    assert len(frames) == FRAMES_SHOWN


def test_frames_of_an_occlusion_show_before_while_and_after():
    """The frame before somebody is hidden, the middle of that, and five frames after it are shown."""
    visible = np.ones(60)
    visible[20:30] = 0.1
    assert choose_frames(visible) == [0, 10, 19, 25, 35, 59]


def test_frames_are_in_the_scene():
    """Also where somebody is hidden from the start, to the end, or the scene is short."""
    for visible in (np.zeros(8), np.append(np.ones(5), np.zeros(3)), np.ones(1), np.array([1, 1, 0, 1.0])):
        frames = choose_frames(visible)
        assert len(frames) == FRAMES_SHOWN
        assert frames == sorted(frames)
        assert 0 <= frames[0] <= frames[-1] < len(visible)
