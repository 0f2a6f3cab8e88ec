# SPDX-License-Identifier: MIT
"""Rank sections of 100 ellipses: native, reference, and a script on NumPy that loops over sections."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(samples: Image, sections: int) -> NDArray[np.float32]:
    """The baseline: all histograms at once, then a loop over sections."""
    n = samples.shape[2]
    planes = samples.reshape(-1, n) + 256 * np.arange(samples.shape[0] * 3)[:, None]
    rank = np.bincount(planes.ravel(), minlength=planes.shape[0] * 256).reshape(-1, 256).cumsum(axis=1)
    q = [
        np.take_along_axis(rank, np.abs(rank * sections - s * n).argmin(axis=1)[:, None], axis=1)
        for s in range(sections + 1)
    ]
    a = [(rank * ((q[s] <= rank) & (rank <= q[s + 1]))).sum(axis=1) for s in range(sections)]
    sums = np.stack(a, axis=1)
    result: NDArray[np.float32] = (
        (sums / sums.sum(axis=1, keepdims=True)).astype(np.float32).reshape(-1, 3, sections)
    )
    return result


@pytest.mark.benchmark(group="rank_sections")
@pytest.mark.work(counts=100 * 3 * 251, why="sections are searched level by level")
@pytest.mark.parametrize(
    "rank_sections",
    [_core.rank_sections, reference.rank_sections, script],
    ids=["native", "reference", "baseline"],
)
def bench_rank_sections(benchmark: Any, rank_sections: Callable[..., Any], samples: Image) -> None:
    """All describe the same."""
    sections = benchmark(rank_sections, samples, 16)
    assert_allclose(sections, reference.rank_sections(samples, 16), rtol=1e-6)
