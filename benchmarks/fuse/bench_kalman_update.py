# SPDX-License-Identifier: MIT
"""An update of a state of seven numbers: native, reference, and OpenCV's filter."""

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
ARGUMENTS = random.normal(size=7), ROOT @ ROOT.T, random.normal(size=7), np.eye(7), 0.1 * np.eye(7)
BASELINE = cv2.KalmanFilter(7, 7, 0, cv2.CV_64F)


def baseline(
    mean: Floats, covariance: Floats, measurement: Floats, observation: Floats, noise: Floats
) -> tuple[Floats, ...]:
    """OpenCV's filter: its own state must be set first, and it doesn't return the innovation covariance."""
    BASELINE.statePre, BASELINE.errorCovPre = mean[:, None].copy(), covariance.copy()
    BASELINE.measurementMatrix, BASELINE.measurementNoiseCov = observation, noise
    return BASELINE.correct(measurement[:, None])[:, 0], BASELINE.errorCovPost


IMPLEMENTATIONS = {"native": _core.kalman_update, "reference": reference.kalman_update, "baseline": baseline}


@pytest.mark.benchmark(group="kalman_update")
@pytest.mark.work(flops64=5 * 2 * 7**3, why="the call, and matrices of 7x7")
@pytest.mark.parametrize("update", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_kalman_update(benchmark: Any, update: Callable[..., tuple[Floats, ...]]) -> None:
    """All correct the same."""
    expected = reference.kalman_update(*ARGUMENTS)[:2]
    for ours, theirs in zip(benchmark(update, *ARGUMENTS)[:2], expected, strict=True):
        assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9)
