# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.evaluation import confidence

from benchmarks.quality.common.frame_results import FrameResults


def test_shares_of_lost_and_good_frames():
    """Shares of lost, of lost that were TRACKED, of good that weren't; unknown frames don't count."""
    frames = FrameResults(
        overlaps=np.array([1.0, 0.9, 0.3, 0.05, 0.0, np.nan, 0.8]),
        absent=np.array([False] * 6 + [True]),
        scores=np.array([1.0, 0.2, 0.5, 0.4, 0.1, 0.9, 0.3]),
        tracked=np.array([True, False, True, True, False, True, True]),
        seconds=np.full(6, 0.002),
    )
    assert frames.lost == 3 / 6
    assert frames.tracked_of_lost == 2 / 3
    assert frames.untracked_of_good == 1 / 2
    assert frames.milliseconds == pytest.approx(2)
    assert frames.auroc == confidence.auroc(frames.overlaps, frames.scores, frames.absent)
    twice = FrameResults.pooled([frames, frames])
    assert twice.lost == frames.lost
    assert len(twice.seconds) == 12
