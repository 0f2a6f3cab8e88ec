# SPDX-License-Identifier: MIT
"""Learning of a histogram of 4096 bins, and its mean: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
SPACE = (32, 32, 4), 64


def script(
    histogram: Floats,
    measured: Floats,
    rate: float,
    first: Floats,
    weight: float,
    space: tuple[tuple[int, int, int], int],
) -> tuple[Floats, Floats, Floats]:
    """The baseline: mixtures, and the marginals, one tensor product per axis."""
    bins, chroma = space
    learned = histogram + rate * (measured - histogram)
    cube = learned.reshape(bins)
    chromas = [-chroma + (np.arange(n) + 0.5) * 2 * chroma / n - 0.5 for n in bins[:2]]
    light = (np.arange(bins[2]) + 0.5) * 766 / bins[2] - 0.5
    marginals = (cube.sum(axis=(1, 2)), cube.sum(axis=(0, 2)), cube.sum(axis=(0, 1)))
    means = [m @ c for m, c in zip(marginals, (*chromas, light), strict=True)]
    return learned, (1 - weight) * learned + weight * first, np.array(means) / learned.sum()


@pytest.mark.benchmark(group="learn_histogram")
@pytest.mark.work(bytes=5 * 8 * 4096, flops64=9 * 4096, why="sums in one order")
@pytest.mark.parametrize(
    "learn_histogram",
    [_core.learn_histogram, reference.learn_histogram, script],
    ids=["native", "reference", "baseline"],
)
def bench_learn_histogram(
    benchmark: Any, learn_histogram: Callable[..., Any], region_bins: NDArray[np.uint16]
) -> None:
    """All learn the same, and find the same mean."""
    counts = np.bincount(region_bins.ravel(), minlength=4096).astype(np.float64)
    arguments = counts, counts[::-1].copy(), 0.3, counts[::3].repeat(3)[:4096], 0.15, SPACE
    for one, other in zip(
        benchmark(learn_histogram, *arguments), reference.learn_histogram(*arguments), strict=True
    ):
        assert_allclose(one, other, rtol=0, atol=1e-9)
