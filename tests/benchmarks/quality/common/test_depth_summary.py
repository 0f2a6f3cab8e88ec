# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common.depth_summary import summarize_depth
from benchmarks.quality.common.frame_results import FrameResults

NAN = float("nan")


def frames(errors, sigmas, overlaps=None, tracked=None):
    """Frames with these depths, on the target and TRACKED unless said otherwise."""
    count = len(errors)
    return FrameResults(
        np.full(count, 0.9) if overlaps is None else np.array(overlaps),
        np.zeros(count, np.bool_),
        np.full(count, 0.5),
        np.ones(count, np.bool_) if tracked is None else np.array(tracked),
        np.full(count, NAN),
        np.array(errors),
        np.array(sigmas),
    )


def test_a_calibrated_covariance():
    """Of normal errors with their standard deviations 68.3 % are within one and 95.4 % within two; of ten
    thousand these shares have standard deviations below 0.5 %. The median error is 0.674 sigma.
    """
    sigmas = np.full(10_000, 0.02)
    found = summarize_depth(frames(np.random.default_rng(0).normal(0, 0.02, 10_000), sigmas))
    assert found.within_one == pytest.approx(0.683, abs=0.015)
    assert found.within_two == pytest.approx(0.954, abs=0.008)
    assert found.error == found.error_on_target == pytest.approx(0.674 * 0.02, rel=0.05)
    assert found.sigma == pytest.approx(0.02)


def test_only_frames_on_the_target_calibrate():
    """The median of all errors counts frames that are lost, missed or without a covariance, too."""
    errors = [0.01, -0.03, -0.03, 5.0, 0.5, 0.7, NAN]
    sigmas = [0.02, 0.02, 0.01, 0.1, 0.1, NAN, 0.1]
    found = summarize_depth(
        frames(errors, sigmas, [0.9, 0.9, 0.9, 0.2, 0.9, 0.9, 0.9], [True] * 4 + [False, True, True])
    )
    assert found == pytest.approx(
        (np.median([0.01, 0.03, 0.03, 5.0, 0.5, 0.7]), 0.03, -0.03, 0.02, 1 / 3, 2 / 3)
    )


def test_no_depths():
    """Nothing is known of a tracker without positions."""
    assert np.isnan(summarize_depth(frames([NAN, NAN], [NAN, NAN]))).all()
