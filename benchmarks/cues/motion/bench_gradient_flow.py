# SPDX-License-Identifier: MIT
"""Flow of one level: native, reference, a script on cv2.sepFilter2D, and cv2's fastest dense flow."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.reference.base.gaussian import gaussian_taps

from benchmarks.quality.common import opencv_flows
from benchmarks.quality.common.opencv_flows import DenseFlow

Image = NDArray[np.uint8]
Flow = tuple[NDArray[np.float32], NDArray[np.float32]]

SIGMA, ANGLE, CONTRAST = 2.0, 0.3, 0.5


def ours(kernel: Callable[..., Any]) -> Callable[[Image, Image], Flow]:
    """u and v of a kernel."""
    return lambda previous, current: kernel(previous, current, SIGMA, ANGLE, CONTRAST)[:2]


def script(previous: Image, current: Image) -> Flow:
    """The baseline: the same filters by cv2.sepFilter2D, and NumPy."""
    bell, slope, curve = (gaussian_taps(SIGMA, order) for order in (0, 1, 2))
    before, now = previous.astype(np.float32), current.astype(np.float32)
    mean, change = (before + now) / 2, now - before

    def filtered(image: NDArray[np.float32], across: Any, down: Any) -> Any:
        return cv2.sepFilter2D(image, cv2.CV_32F, across, down, borderType=cv2.BORDER_REPLICATE)

    xx, xy, yy = filtered(mean, curve, bell), filtered(mean, slope, slope), filtered(mean, bell, curve)
    xt, yt = filtered(change, slope, bell), filtered(change, bell, slope)
    cross, first, second = xx * yy - xy * xy, xx * xx + xy * xy, xy * xy + yy * yy
    u, v = (xy * yt - yy * xt) / cross, (xy * xt - xx * yt) / cross
    kept = (abs(cross) >= ANGLE * np.sqrt(first * second)) & (first + second >= CONTRAST)
    kept &= np.hypot(u, v) <= np.pi / np.sqrt(2) * SIGMA
    return np.where(kept, u, np.float32(np.nan)), np.where(kept, v, np.float32(np.nan))


def planes(dense: DenseFlow) -> Callable[[Image, Image], Flow]:
    """u and v of a dense flow (H, W, 2)."""

    def calc(previous: Image, current: Image) -> Flow:
        flow = dense(previous, current)
        return flow[..., 0], flow[..., 1]

    return calc


IMPLEMENTATIONS = {
    "native": ours(_core.gradient_flow),
    "reference": ours(reference.gradient_flow),
    "baseline": script,
    "dis": planes(opencv_flows.dis(cv2.DISOPTICAL_FLOW_PRESET_ULTRAFAST)),
}


@pytest.mark.benchmark(group="gradient_flow, 160x120")
@pytest.mark.work(flops32=290 * 160 * 120)
@pytest.mark.parametrize("flow", IMPLEMENTATIONS.values(), ids=list(IMPLEMENTATIONS))
def bench_gradient_flow(benchmark: Any, frames: tuple[Image, Image], flow: Callable[..., Flow]) -> None:
    """All are within 0.2 px at half of the pixels that the kernel keeps, and the first three agree."""
    u, v = benchmark(flow, *frames)
    theirs = IMPLEMENTATIONS["reference"](*frames)
    kept = np.isfinite(theirs[0])
    assert kept.mean() > 0.5
    assert np.nanmedian(np.hypot(u - 0.6, v + 0.4)[kept]) < 0.2
    if flow is not IMPLEMENTATIONS["dis"]:
        assert np.isfinite(u[kept]).mean() > 0.999
        assert np.nanmax(abs(u - theirs[0])) < 0.02
