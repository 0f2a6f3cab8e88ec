# SPDX-License-Identifier: MIT
"""A shift of a patch of 64x64 pixels: native, reference, and its parts one by one."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tricue import _core, reference

random = np.random.default_rng(0)
PATCH = random.integers(0, 256, (64, 64, 3), np.uint8)
PLACES = random.permutation(64 * 64).reshape(64, 64)
TAPER = random.random((32, 32), np.float32)
FILTER = np.ascontiguousarray(np.fft.rfft2(random.uniform(-1, 1, (1, 19, 32, 32))) / 1024, np.complex64)


def script(patch: Any, places: Any, taper: Any, model: Any, near: tuple[int, int, float]) -> Any:
    """The baseline: a call for each part, and NumPy for the peak."""
    right, down, penalty = near
    cells = _core.hog_color_cells(_core.pick_pixels(patch, places), taper)
    middle = _core.correlation_response(cells, model)[0][16 - down : 17 + down, 16 - right : 17 + right]
    evidence = middle - penalty * np.arange(-right, right + 1) ** 2
    row, column = np.unravel_index(evidence.argmax(), evidence.shape)
    if not 0 < column < 2 * right or middle[row, column] <= 0:
        return float(column) - right, middle[row, column]
    neighbors = middle[row, column - 1 : column + 2]
    before, top, after = np.log(np.maximum(neighbors, 0.05 * neighbors[1]))
    bend = before - 2 * top + after
    offset = np.clip(0.5 * (before - after) / bend, -0.5, 0.5) if bend < 0 else 0.0
    return float(column + offset - right), middle[row, column]


@pytest.mark.benchmark(group="log_polar_shift, 64x64")
@pytest.mark.work(flops32=20 * 25_600 + 19 * 8 * 32 * 17 + 4096 * 100)
@pytest.mark.parametrize(
    "log_polar_shift",
    [_core.log_polar_shift, reference.log_polar_shift, script],
    ids=["native", "reference", "baseline"],
)
def bench_log_polar_shift(benchmark: Any, log_polar_shift: Callable[..., Any]) -> None:
    """All find the same, within the rounding of the responses."""
    arguments = PATCH, PLACES, TAPER, FILTER, (2, 1, 0.05)
    found = benchmark(log_polar_shift, *arguments)
    assert found == pytest.approx(reference.log_polar_shift(*arguments), abs=1e-3)
