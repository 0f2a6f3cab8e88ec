# SPDX-License-Identifier: MIT
"""A picture of a room's depth, 176x144: native, reference, and a script on NumPy and OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]


def script(depth: Depth, z: float, reach: float) -> Any:
    """The baseline: NaN is replaced by the reach, NumPy clips, and OpenCV scales."""
    known = np.nan_to_num(depth - np.float32(z), nan=reach)
    return cv2.convertScaleAbs(np.clip(known, -reach, reach), alpha=127 / reach, beta=128)


@pytest.mark.benchmark(group="depth_picture, 176x144")
@pytest.mark.work(bytes=5 * 176 * 144, flops32=5 * 176 * 144, why="conversion to bytes")
@pytest.mark.parametrize(
    "draw",
    [_core.depth_picture, reference.depth_picture, script],
    ids=["native", "reference", "baseline"],
)
def bench_depth_picture(benchmark: Any, draw: Callable[..., NDArray[np.uint8]], room: Depth) -> None:
    """All draw the same, within one gray level."""
    found, expected = benchmark(draw, room, 2.5, 0.5), reference.depth_picture(room, 2.5, 0.5)
    assert np.abs(found.astype(int) - expected).max() <= 1
    assert 0.02 < ((expected > 1) & (expected < 255)).mean() < 0.9
