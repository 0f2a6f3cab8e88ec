# SPDX-License-Identifier: MIT
"""Joint histograms of 100 ellipses, 16 bins per channel: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(samples: Image, bins: int) -> NDArray[np.float32]:
    """The baseline: calcHist of the three planes of each ellipse."""
    n = samples.shape[2]
    counts = [
        cv2.calcHist(list(planes[:, None]), [0, 1, 2], None, 3 * [bins], 3 * [0, 256]) for planes in samples
    ]
    return np.stack(counts).reshape(len(samples), bins**3) / n


@pytest.mark.benchmark(group="joint_histogram")
@pytest.mark.work(counts=100 * 251, bytes=100 * 4 * 4096)
@pytest.mark.parametrize(
    "joint_histogram",
    [_core.joint_histogram, reference.joint_histogram, script],
    ids=["native", "reference", "baseline"],
)
def bench_joint_histogram(benchmark: Any, joint_histogram: Callable[..., Any], samples: Image) -> None:
    """All count the same."""
    histograms = benchmark(joint_histogram, samples, 16)
    assert_allclose(histograms, reference.joint_histogram(samples, 16), rtol=1e-6)
