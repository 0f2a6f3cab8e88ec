# SPDX-License-Identifier: MIT
"""Ranks of 251 samples of 100 ellipses: native, reference, and scipy's rankdata."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.stats import rankdata
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(samples: Image) -> NDArray[np.float64]:
    """The baseline: average ranks, shifted to the same origin."""
    return (rankdata(samples, axis=2) - 0.5) / samples.shape[2]  # type: ignore[no-any-return]


@pytest.mark.benchmark(group="color_ranks")
@pytest.mark.work(counts=100 * 3 * 251, lookups=100 * 3 * 251)
@pytest.mark.parametrize(
    "color_ranks", [_core.color_ranks, reference.color_ranks, script], ids=["native", "reference", "baseline"]
)
def bench_color_ranks(benchmark: Any, color_ranks: Callable[..., Any], samples: Image) -> None:
    """All rank the same."""
    assert_allclose(benchmark(color_ranks, samples), reference.color_ranks(samples), rtol=1e-6)
