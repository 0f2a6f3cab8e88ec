# SPDX-License-Identifier: MIT
"""Two cues' posteriors by Bayes' rule."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.special import expit, logit
from tricue import _core, reference
from tricue.kernels import Kernels

Plane = NDArray[np.float32]

pairs = arrays(
    np.float32,
    st.tuples(st.just(2), st.integers(0, 9), st.integers(0, 70)),
    elements=st.floats(0, 1, width=32),
)


@given(pairs)
def test_twin_combines_the_same(pair: Plane) -> None:
    """Native and reference agree to the last bit on planes of any shape."""
    assert_array_equal(_core.combine_posteriors(*pair), reference.combine_posteriors(*pair), strict=True)


def test_twin_combines_the_same_in_padded_planes() -> None:
    """They also agree on parts of planes, whose rows are apart."""
    part = np.random.default_rng(0).random((2, 20, 90), np.float32)[:, 3:18, 7:61]
    assert_array_equal(_core.combine_posteriors(*part), reference.combine_posteriors(*part), strict=True)


def test_log_odds_add(kernels: Kernels) -> None:
    """SciPy's log-odds of both add up to that of the result, within the roundings of float32."""
    first, second = np.random.default_rng(1).uniform(0.01, 0.99, (2, 40, 30)).astype(np.float32)
    expected = expit(logit(first.astype(float)) + logit(second.astype(float)))
    assert_allclose(kernels.combine_posteriors(first, second), expected, rtol=6 * np.finfo(np.float32).eps)


def test_one_half_is_neutral_and_order_does_not_count(kernels: Kernels) -> None:
    """1/2 returns the other to the last bit but for rounding, and both orders have the same bits."""
    some = np.random.default_rng(2).random((30, 50), np.float32)
    half, other = np.full_like(some, 0.5), some[::-1].copy()
    assert_allclose(kernels.combine_posteriors(some, half), some, rtol=3 * np.finfo(np.float32).eps)
    assert_array_equal(kernels.combine_posteriors(some, other), kernels.combine_posteriors(other, some))


def test_certainties(kernels: Kernels) -> None:
    """What one cue is certain of stays certain; a contradiction is 0, not NaN."""
    first, second = np.array([[1, 0, 1, 0]], np.float32), np.array([[0.3, 0.7, 0, 1]], np.float32)
    assert_array_equal(kernels.combine_posteriors(first, second), [[1, 0, 0, 0]])


def test_refuses_other_shapes(kernels: Kernels) -> None:
    """Planes of different shapes are named."""
    with pytest.raises(ValueError, match=r"second: expected shape \(2, 3\), got \(3, 2\)"):
        kernels.combine_posteriors(np.ones((2, 3), np.float32), np.ones((3, 2), np.float32))


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match=r"first: expected a float32 plane \(H, W\)"):
        _core.combine_posteriors(np.ones((2, 3)), np.ones((2, 3), np.float32))  # type: ignore[arg-type]
