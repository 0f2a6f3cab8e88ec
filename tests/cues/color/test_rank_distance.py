# SPDX-License-Identifier: MIT
"""The distance between orders of corresponding pixels."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.stats import rankdata
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Maps = NDArray[np.float32]


def case(seed: int, ellipses: int, models: int, n: int) -> tuple[Image, Maps]:
    """Samples of some levels and rank maps."""
    rng = np.random.default_rng(seed)
    samples = rng.integers(0, rng.integers(1, 257), (ellipses, 3, n)).astype(np.uint8)
    return samples, rng.random((models, 3, n), np.float32)


@given(st.integers(0, 2**32), st.integers(0, 5), st.integers(0, 3), st.integers(1, 300))
def test_twin_measures_the_same(seed: int, ellipses: int, models: int, n: int) -> None:
    """They agree to the last bit: sums of whole numbers and one division, by bytes and by integers alike."""
    samples, maps = case(seed, ellipses, models, n)
    native, twin = _core.rank_distance(samples, maps), reference.rank_distance(samples, maps)
    assert native.dtype == twin.dtype == np.float64
    assert_array_equal(native, twin)


def test_agrees_with_scipy(kernels: Kernels) -> None:
    """From scipy's ranks: twice the mean absolute difference, but for the models' rounding to 1/2n."""
    samples, maps = case(1, 6, 2, 144)
    ranks = (rankdata(samples, axis=2) - 0.5) / 144
    expected = 2 * np.abs(ranks[:, None] - maps[None]).mean(axis=(2, 3))
    assert_allclose(kernels.rank_distance(samples, maps), expected, rtol=0, atol=2 * 0.5 / (2 * 144))


def test_ends_of_the_scale(kernels: Kernels) -> None:
    """The same order is at 0, the opposite order at 1, unrelated orders at 2/3."""
    rng = np.random.default_rng(0)
    levels = np.arange(200, dtype=np.uint8)
    samples = np.stack([rng.permutation(levels) for _ in range(300)]).reshape(100, 3, 200)
    ranks = kernels.color_ranks(samples)
    same, opposite = kernels.rank_distance(samples[:1], np.stack([ranks[0], 1 - ranks[0]]))[0]
    assert same == 0
    assert opposite == pytest.approx(1, abs=1e-4)
    unrelated = kernels.rank_distance(samples[1:], ranks[:1])
    assert unrelated.mean() == pytest.approx(2 / 3, abs=0.01)


@given(st.integers(0, 2**32), st.floats(0.2, 5))
def test_light_does_not_matter(seed: int, gamma: float) -> None:
    """A strictly increasing change of each channel leaves the distance as it is, bit for bit."""
    rng = np.random.default_rng(seed)
    samples = rng.integers(0, 40, (3, 3, 100)).astype(np.uint8)
    curves = np.stack(
        [np.sort(rng.choice(256, 40, replace=False)) for _ in range(3)]
    )  # 40 levels of 0..255, ascending
    lit = np.stack([curve[samples[:, k]] for k, curve in enumerate(curves)], axis=1).astype(np.uint8)
    maps = rng.random((2, 3, 100), np.float32) ** np.float32(gamma)
    for kernels in (_core, reference):
        assert_array_equal(kernels.rank_distance(lit, maps), kernels.rank_distance(samples, maps))


def test_refuses_models_of_another_size(kernels: Kernels) -> None:
    """Rank maps with another number of places are named."""
    samples, maps = case(0, 2, 1, 20)
    with pytest.raises(ValueError, match="models: expected"):
        kernels.rank_distance(samples, np.ascontiguousarray(maps[:, :, :19]))
    with pytest.raises(ValueError, match="samples: expected at least one an ellipse, got none"):
        kernels.rank_distance(samples[:, :, :0].copy(), maps[:, :, :0].copy())


@pytest.mark.parametrize("rank", [np.nan, np.inf, -0.1, 1.1])
def test_refuses_what_is_no_rank(kernels: Kernels, rank: float) -> None:
    """A model's ranks lie in [0, 1]."""
    samples, maps = case(0, 2, 1, 20)
    maps[0, 1, 3] = rank
    with pytest.raises(ValueError, match=r"models: expected ranks in \[0, 1\], got"):
        kernels.rank_distance(samples, maps)


def test_native_refuses_other_types() -> None:
    """float64 models are named, not converted."""
    samples, maps = case(0, 2, 1, 20)
    with pytest.raises(TypeError, match=r"models: expected float32 \(M, 3, n\), got float64"):
        _core.rank_distance(samples, maps.astype(np.float64))
