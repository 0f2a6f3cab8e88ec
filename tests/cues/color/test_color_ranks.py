# SPDX-License-Identifier: MIT
"""Color ranks, equation (17)."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.stats import rankdata
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
few = arrays(np.uint8, st.tuples(st.integers(0, 3), st.just(3), st.integers(1, 40)))


@given(few)
def test_twin_ranks_the_same(samples: Image) -> None:
    """Native and reference agree to one rounding: whole counts, one division (float32 against float64)."""
    assert_allclose(
        _core.color_ranks(samples), reference.color_ranks(samples), rtol=np.finfo(np.float32).eps, atol=0
    )


@pytest.mark.parametrize("n", [1, 2, 63, 254, 255, 256, 257, 1000])
def test_agrees_with_scipy(kernels: Kernels, n: int) -> None:
    """scipy's average ranks are ours but for their origin; below and above 255 samples, where the native
    way changes.
    """
    samples = np.random.default_rng(n).normal(120, 30, (4, 3, n)).clip(0, 255).astype(np.uint8)
    ranks = kernels.color_ranks(samples)
    assert ranks.dtype == np.float32
    assert_allclose(ranks, (rankdata(samples, axis=2) - 0.5) / n, rtol=1e-6)


@pytest.mark.parametrize("level", [0, 255])
@pytest.mark.parametrize("n", [255, 256])
def test_a_flat_window_has_one_rank(kernels: Kernels, level: int, n: int) -> None:
    """All samples alike rank in the middle, in the first level and in the last, as full as a count can
    get.
    """
    assert_array_equal(kernels.color_ranks(np.full((1, 3, n), level, np.uint8)), 0.5)


@given(few.filter(len), arrays(np.int32, 256, elements=st.integers(1, 1000)))
def test_increasing_changes_keep_every_rank(samples: Image, steps: NDArray[np.int32]) -> None:
    """Any strictly increasing change of a channel leaves the ranks as they are, bit for bit (levels that
    occur stay apart).
    """
    levels = np.unique(samples)
    curve = np.zeros(256, np.uint8)
    rising = np.cumsum(steps[: len(levels)]) - steps[0]
    curve[levels] = np.arange(len(levels)) + rising * (256 - len(levels)) // (rising[-1] + 1)
    assert np.all(np.diff(curve[levels].astype(int)) > 0)
    for kernels in (_core, reference):
        assert_array_equal(kernels.color_ranks(curve[samples]), kernels.color_ranks(samples))


def test_mean_is_a_half(kernels: Kernels, samples: Image) -> None:
    """Mid-ranks have a mean of 1/2 whatever the picture, within float32's rounding."""
    if samples.size:
        assert_allclose(kernels.color_ranks(samples).mean(axis=2, dtype=np.float64), 0.5, atol=1e-6)


def test_refuses_no_samples(kernels: Kernels) -> None:
    """Ellipses without samples have no ranks."""
    with pytest.raises(ValueError, match="samples: expected at least one an ellipse, got none"):
        kernels.color_ranks(np.zeros((2, 3, 0), np.uint8))


@pytest.mark.parametrize(
    ("samples", "error"),
    [
        (np.zeros((1, 3, 4)), TypeError),
        (np.zeros((1, 4, 4), np.uint8), ValueError),
        (np.zeros((1, 3, 8), np.uint8)[:, :, ::2], ValueError),
    ],
)
def test_native_refuses(samples: Any, error: type[Exception]) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match="samples: expected"):
        _core.color_ranks(samples)
