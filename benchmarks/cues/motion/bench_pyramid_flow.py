# SPDX-License-Identifier: MIT
"""Flow from coarse to fine: native, reference and cv2's dense flow, the fastest and Farneback's."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

from benchmarks.quality.common import opencv_flows
from benchmarks.quality.common.opencv_flows import DenseFlow

Image = NDArray[np.uint8]
Flow = tuple[NDArray[np.float32], NDArray[np.float32]]

SIGMA, LEVELS, ANGLE, CONTRAST = 1.0, 3, 0.05, 0.5


def ours(kernel: Callable[..., Any]) -> Callable[[Image, Image], Flow]:
    """u and v of a kernel."""
    return lambda previous, current: kernel(previous, current, SIGMA, LEVELS, ANGLE, CONTRAST)[:2]


def planes(dense: DenseFlow) -> Callable[[Image, Image], Flow]:
    """u and v of a dense flow (H, W, 2)."""

    def calc(previous: Image, current: Image) -> Flow:
        flow = dense(previous, current)
        return flow[..., 0], flow[..., 1]

    return calc


IMPLEMENTATIONS = {
    "native": ours(_core.pyramid_flow),
    "reference": ours(reference.pyramid_flow),
    "baseline": planes(opencv_flows.farneback()),
    "dis": planes(opencv_flows.dis(cv2.DISOPTICAL_FLOW_PRESET_ULTRAFAST)),
}


@pytest.mark.benchmark(group="pyramid_flow, 160x120")
@pytest.mark.work(flops32=250 * 160 * 120 * 21 // 16)
@pytest.mark.parametrize("flow", IMPLEMENTATIONS.values(), ids=list(IMPLEMENTATIONS))
def bench_pyramid_flow(benchmark: Any, frames: tuple[Image, Image], flow: Callable[..., Flow]) -> None:
    """All are within 0.2 px at half of the pixels, and the kernels agree."""
    u, v = benchmark(flow, *frames)
    assert np.isfinite(u).mean() > 0.9
    assert np.nanmedian(np.hypot(u - 0.6, v + 0.4)) < 0.2
    if flow is IMPLEMENTATIONS["native"]:
        assert np.nanmax(abs(u - IMPLEMENTATIONS["reference"](*frames)[0])) < 1e-3
