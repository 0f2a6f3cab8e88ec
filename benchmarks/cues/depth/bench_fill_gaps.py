# SPDX-License-Identifier: MIT
"""Gaps of a depth image of 176x144, 30 % of it missing: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
GAP, SLOPE, RAGGED = 0.06, 0.01, 0.035
FAR = np.float32(1e4)
RING = np.uint8([[1, 1, 1], [1, 0, 1], [1, 1, 1]])


def script(depth: Depth, gap: float, slope: float, max_gap_share: float, passes: int) -> Depth:
    """The baseline: the nearest depth by erosion, then NumPy on the eight shifted views of a padded copy."""
    height, width = depth.shape
    for number in range(passes):
        known = depth > 0
        wide = np.pad(known, ((0, 0), (0, 4)))
        gaps = known & ~wide[:, 1:-3] & (wide[:, 2:-2] | wide[:, 3:-1] | wide[:, 4:])
        if gaps.sum() <= (max_gap_share / 2 if number > 0 else max_gap_share) * known.sum():
            break
        far = np.where(known, depth, FAR)
        nearest = cv2.erode(far, RING, borderType=cv2.BORDER_CONSTANT, borderValue=float(FAR))
        reach = np.minimum(nearest + (gap + slope * nearest * nearest), FAR / 2)
        padded = cv2.copyMakeBorder(far, 1, 1, 1, 1, cv2.BORDER_CONSTANT, value=float(FAR))
        total, votes = np.zeros((2, height, width), np.float32)
        for y, x in np.argwhere(RING):
            neighbor = padded[y : y + height, x : x + width]
            on_it = neighbor <= reach
            cv2.add(total, neighbor, total, on_it.view(np.uint8))
            votes += on_it
        filled = total / np.maximum(votes, 1)
        depth = np.where(known, depth, np.where(votes >= 2, filled, np.float32(np.nan)))
    return depth


@pytest.mark.benchmark(group="fill_gaps")
@pytest.mark.work(flops32=40 * 176 * 144, why="passes, until few gaps are left")
@pytest.mark.parametrize(
    "fill_gaps", [_core.fill_gaps, reference.fill_gaps, script], ids=["native", "reference", "baseline"]
)
def bench_fill_gaps(benchmark: Any, fill_gaps: Callable[..., Any], room: Depth) -> None:
    """All fill the same gaps with the same depths."""
    missing = np.random.default_rng(1).random(room.shape) < 0.3
    depth = np.where(missing, np.float32(np.nan), room)
    filled = benchmark(fill_gaps, depth, GAP, SLOPE, RAGGED, 3)
    assert np.isnan(filled).sum() < np.isnan(depth).sum() / 10
    assert_allclose(filled, reference.fill_gaps(depth, GAP, SLOPE, RAGGED, 3), rtol=1e-6)
