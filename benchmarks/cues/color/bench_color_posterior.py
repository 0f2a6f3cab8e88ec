# SPDX-License-Identifier: MIT
"""A table of 16^3 looked up for a patch of 64x64: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Plane = NDArray[np.float32]


def script(image: Image, table: Plane) -> Plane:
    """The baseline: take with one flat index, for tables of 16 levels."""
    cells = (image >> 4).astype(np.int32)
    result: Plane = table.ravel().take(cells[..., 0] << 8 | cells[..., 1] << 4 | cells[..., 2])
    return result


@pytest.mark.benchmark(group="color_posterior, 64x64")
@pytest.mark.work(lookups=64 * 64)
@pytest.mark.parametrize(
    "color_posterior",
    [_core.color_posterior, reference.color_posterior, script],
    ids=["native", "reference", "baseline"],
)
def bench_color_posterior(benchmark: Any, color_posterior: Callable[..., Plane], frame: Image) -> None:
    """All read the same."""
    patch = np.ascontiguousarray(frame[40:104, 60:124])
    table = np.random.default_rng(0).random((16, 16, 16), np.float32)
    assert_array_equal(benchmark(color_posterior, patch, table), reference.color_posterior(patch, table))
