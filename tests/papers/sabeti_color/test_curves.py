# SPDX-License-Identifier: MIT
"""Tables of scenes in which the target is hidden or fast."""

import numpy as np
import pytest
from tricue.papers.sabeti_color import curves
from tricue.papers.sabeti_color.curves import ColorCurve

FRAMES = 40


def curve(overlaps, visible=None, steps=None, errors=None):
    """A curve of 40 frames."""
    ones, zeros = np.ones(FRAMES), np.zeros(FRAMES)
    return ColorCurve(
        "m",
        "s",
        0,
        overlaps=np.asarray(overlaps, float),
        errors=zeros if errors is None else errors,
        boxes=np.zeros((FRAMES, 4)),
        visible=ones if visible is None else visible,
        steps=zeros if steps is None else steps,
    )


@pytest.mark.parametrize(("first_held", "answer"), [(10, True), (25, True), (26, False), (40, False)])
def test_recovered_within_15_frames_after_hidden(first_held, answer):
    """The target comes back in frame 10: an overlap above 0.5 counts up to frame 25."""
    visible = np.where((np.arange(FRAMES) >= 5) & (np.arange(FRAMES) < 10), 0.1, 1.0)
    assert curve(np.arange(FRAMES) >= first_held, visible).recovered == [answer]


def test_half_hidden_is_not_hidden():
    """Shares down to 15 % ask for no recovery, nor does a target that stays hidden."""
    assert curve(np.zeros(FRAMES), np.full(FRAMES, 0.15)).recovered == []
    assert curve(np.zeros(FRAMES), np.full(FRAMES, 0.1)).recovered == []


def test_table_counts_visible_and_fast_frames():
    """Medians and shares are over frames with half of the target visible; fast ones have their own share."""
    index = np.arange(FRAMES)
    visible, steps = np.where(index < 20, 1.0, 0.2), np.where(index < 4, 11.0, 10.0)
    overlaps = np.where((index < 3) | (index >= 38), 0.9, 0.1)
    *_, line = curves.summarize_scenes([curve(overlaps, visible, steps, index.astype(float))]).splitlines()
    assert line == "| s | m | 9.5 | 15.0% | 75.0% | - | 0% | 1 |"
    *_, line = curves.summarize_scenes([curve(np.ones(FRAMES))]).splitlines()
    assert line == "| s | m | 0.0 | 100.0% | - | - | 100% | 1 |"
