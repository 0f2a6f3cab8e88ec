# SPDX-License-Identifier: MIT
"""A table of 32^3 looked up for 100 ellipses: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(samples: Image, table: NDArray[np.float32]) -> NDArray[np.float32]:
    """The baseline: take with one flat index, for tables of 32 levels."""
    b, g, r = (samples >> 3).astype(np.int32).transpose(1, 0, 2)
    result: NDArray[np.float32] = table.ravel().take(b << 10 | g << 5 | r)
    return result


@pytest.mark.benchmark(group="color_lookup")
@pytest.mark.work(lookups=100 * 251)
@pytest.mark.parametrize(
    "color_lookup",
    [_core.color_lookup, reference.color_lookup, script],
    ids=["native", "reference", "baseline"],
)
def bench_color_lookup(benchmark: Any, color_lookup: Callable[..., Any], samples: Image) -> None:
    """All read the same."""
    table = np.random.default_rng(0).random((32, 32, 32), np.float32)
    values = benchmark(color_lookup, samples, table)
    assert_array_equal(values, reference.color_lookup(samples, table))
