# SPDX-License-Identifier: MIT
"""4096 bins moved to a given mean: native, reference, and a script on SciPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy import ndimage
from tricue import _core, reference

Floats = NDArray[np.float64]
SPACE = (32, 32, 4), 64


def script(histogram: Floats, space: tuple[tuple[int, int, int], int], mean: Floats) -> Floats:
    """The baseline: the center of mass, and a linearly interpolated shift, which loses mass at the ends."""
    bins, chroma = space
    cube = histogram.reshape(bins)
    widths = np.array([2 * chroma, 2 * chroma, 766]) / bins
    target = (mean + 0.5 - np.array([-chroma, -chroma, 0])) / widths - 0.5
    offset = target - np.array(ndimage.center_of_mass(cube))
    return np.asarray(ndimage.shift(cube, offset, order=1)).ravel()


@pytest.mark.benchmark(group="shift_histogram")
@pytest.mark.work(flops64=3 * 4 * 4096, why="most bins are empty, and passed over one by one")
@pytest.mark.parametrize(
    "shift_histogram",
    [_core.shift_histogram, reference.shift_histogram, script],
    ids=["native", "reference", "baseline"],
)
def bench_shift_histogram(benchmark: Any, shift_histogram: Callable[..., Floats]) -> None:
    """All shift a histogram that doesn't reach the ends to the same bins."""
    cube = np.zeros(SPACE[0])
    cube[10:20, 8:22, 1:3] = np.random.default_rng(0).random((10, 14, 2))
    mean = reference.histogram_mean(cube.ravel(), SPACE) + np.array([7.0, -5.5, 30.0])
    shifted = benchmark(shift_histogram, cube.ravel(), SPACE, mean)
    assert_allclose(shifted, reference.shift_histogram(cube.ravel(), SPACE, mean), rtol=0, atol=1e-10)
