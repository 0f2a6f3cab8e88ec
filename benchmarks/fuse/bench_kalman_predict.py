# SPDX-License-Identifier: MIT
"""A prediction of a state of seven numbers: native, reference, and OpenCV's filter."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
random = np.random.default_rng(0)
ROOT = random.normal(size=(7, 7))
ARGUMENTS = random.normal(size=7), ROOT @ ROOT.T, np.eye(7) + np.eye(7, k=3) / 30, 0.01 * np.eye(7)
BASELINE = cv2.KalmanFilter(7, 7, 0, cv2.CV_64F)


def baseline(mean: Floats, covariance: Floats, transition: Floats, noise: Floats) -> tuple[Floats, Floats]:
    """OpenCV's filter: its own state must be set first, and it overwrites the arrays that it is set to."""
    BASELINE.statePost, BASELINE.errorCovPost = mean[:, None].copy(), covariance.copy()
    BASELINE.transitionMatrix, BASELINE.processNoiseCov = transition, noise
    return BASELINE.predict()[:, 0], BASELINE.errorCovPre


IMPLEMENTATIONS = {
    "native": _core.kalman_predict,
    "reference": reference.kalman_predict,
    "baseline": baseline,
}


@pytest.mark.benchmark(group="kalman_predict")
@pytest.mark.work(flops64=2 * 2 * 7**3, why="the call, and matrices of 7x7")
@pytest.mark.parametrize("predict", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_kalman_predict(benchmark: Any, predict: Callable[..., tuple[Floats, Floats]]) -> None:
    """All predict the same."""
    for ours, theirs in zip(
        benchmark(predict, *ARGUMENTS), reference.kalman_predict(*ARGUMENTS), strict=True
    ):
        assert_allclose(ours, theirs, rtol=1e-11, atol=1e-11)
