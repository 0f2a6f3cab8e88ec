# SPDX-License-Identifier: MIT
"""A target's pixels, and counts in 200 blocks: native, reference, and a script on NumPy and OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from tricue import _core, reference

RANGES = [(-4.0, 4.0), (-4.0, 4.0), (0.0, 16.0)]
COLUMNS, ROWS = 10, 20


def cleaned(mask: Any, neighbors: int, share: float, trim: float) -> Any:
    """The large regions of dense pixels, and the box around them."""
    around = cv2.filter2D(mask, -1, np.ones((3, 3)), borderType=cv2.BORDER_CONSTANT) - mask
    dense = mask * (around >= neighbors).astype(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(dense, connectivity=8)
    areas = stats[:, cv2.CC_STAT_AREA]
    large = areas >= share * areas[1:].max(initial=0)
    large[0] = False
    kept = large[labels].astype(np.uint8)
    ys, xs = map(np.sort, np.nonzero(kept))
    out = int(trim * len(xs))
    return kept, tuple(map(int, (xs[out], ys[out], xs[-1 - out] + 1, ys[-1 - out] + 1)))


def script(
    planes: Any,
    model: Any,
    prior: Any,
    threshold: float,
    clean: tuple[int, float, float],
    disparity: Any,
    grid: Any,
    states: Any,
    limits: tuple[float, float, float],
) -> Any:
    """The baseline: posteriors by tables, regions by OpenCV, and a slice for each block."""
    (densities, ranges, alternatives), (window, candidate) = model, prior
    corners, (size, x, y, left, top) = grid
    shape = planes[0].shape
    columns = np.interp(np.arange(shape[1]) + 0.5, [candidate[0], *window[::2], candidate[2]], [0, 1, 1, 0])
    rows = np.interp(np.arange(shape[0]) + 0.5, [candidate[1], *window[1::2], candidate[3]], [0, 1, 1, 0])
    odds = np.minimum(columns, rows[:, None]).astype(np.float32)
    for plane, density, alternative, (low, high) in zip(planes, densities, alternatives, ranges, strict=True):
        bins = len(density)
        places = np.nan_to_num((plane - np.float32(low)) * np.float32(bins / (high - low)), nan=-1)
        table = np.concatenate([[0], density / alternative, [0]]).astype(np.float32)
        odds *= table[np.clip(np.floor(places), -1, bins).astype(np.int32) + 1]
    mask = (odds / (odds + 1) >= threshold).astype(np.uint8)
    mask, box = cleaned(mask, *clean)
    blocks = np.ceil(corners * size + [x - left, y - top] * 2 - 0.5).astype(int)
    rows_of = []
    for x0, y0, x1, y1 in np.maximum(blocks, 0).tolist():
        part = disparity[y0:y1, x0:x1]
        known = part[np.isfinite(part)]
        close = int(np.count_nonzero(np.abs(known - limits[0]) <= limits[1]))
        mean = known.mean(dtype=float) if known.size else np.nan
        rows_of.append((part.size, int(mask[y0:y1, x0:x1].sum()), known.size, mean, close))
    cells, targets, measured, mean, similar = (np.array(each) for each in zip(*rows_of, strict=True))
    mine = (states != 0) & (cells > 0)
    hidden = mine & (measured >= 0.2 * cells) & (mean > limits[2])
    share = np.count_nonzero(hidden) / max(np.count_nonzero(mine), 1)
    return box, int(mask.sum()), mask, (cells, targets, measured, mean, similar), share


IMPLEMENTATIONS = {"native": _core.observe_target, "reference": reference.observe_target, "baseline": script}


def check(benchmark: Any, observe_target: Callable[..., Any], target: Any) -> None:
    """All find the same, except for a few pixels whose bin depends on rounding."""
    x0, y0, x1, y1 = target.window
    i, j = (each.ravel() for each in np.meshgrid(np.arange(COLUMNS), np.arange(ROWS)))
    left, top = (i / COLUMNS - 0.5) * (x1 - x0), (j / ROWS - 0.5) * (y1 - y0)
    corners = np.stack([left, top, left + (x1 - x0) / COLUMNS, top + (y1 - y0) / ROWS], axis=1)
    ramp = np.linspace(1, 2, len(target.densities[0]))
    arguments = (
        target.planes,
        (np.array(target.densities), RANGES, np.array([0.9 * ramp / ramp.sum()] * 3)),
        (target.window, target.candidate),
        0.5,
        (2, 0.2, 0.02),
        target.planes[2],
        (corners, (1.0, (x0 + x1) / 2, (y0 + y1) / 2, 0.0, 0.0)),
        np.random.default_rng(0).integers(0, 3, len(corners)),
        (8.0, 0.75, 10.0),
    )
    box, count, mask, seen, share = benchmark(observe_target, *arguments)
    expected_box, expected_count, expected_mask, expected, expected_share = reference.observe_target(
        *arguments
    )
    assert expected_count > 100
    assert abs(count - expected_count) <= 4
    assert np.abs(np.subtract(box, expected_box)).max() <= 1
    assert np.count_nonzero(mask != expected_mask) <= 4
    assert share == expected_share
    for one, other, atol in zip(seen, expected, (0, 4, 0, 1e-5, 1), strict=True):
        assert_allclose(one, other, rtol=0, atol=atol)


WHY = "short rows; blocks one after the other"


@pytest.mark.benchmark(group="observe_target, 160x120")
@pytest.mark.work(lookups=3 * 60 * 75, bytes=3 * 4 * 60 * 75 + 5 * 160 * 120, why=WHY)
@pytest.mark.parametrize("observe_target", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_observe_target(benchmark: Any, observe_target: Callable[..., Any], small: Any) -> None:
    """In a frame of 160x120, as in the paper."""
    check(benchmark, observe_target, small)
