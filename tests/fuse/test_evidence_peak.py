# SPDX-License-Identifier: MIT
"""The place with most evidence."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Plane = NDArray[np.float32]
NONE: Plane = np.empty((0, 0), np.float32)
weights = st.floats(-2, 2)


@given(
    st.integers(0, 2**32),
    st.integers(1, 3),
    st.integers(1, 40),
    st.integers(1, 40),
    st.booleans(),
    weights,
    weights,
)
def test_twin_finds_the_same(
    seed: int, filters: int, rows: int, columns: int, with_contrast: bool, filter_weight: float, weight: float
) -> None:
    """Native and reference agree to the last bit, for planes of any size, and for many equal numbers."""
    rng = np.random.default_rng(seed)
    responses = rng.normal(size=(filters, rows, columns)).astype(np.float32)
    contrast = rng.random((rows, columns), np.float32) if with_contrast else NONE
    for each in (responses, responses.round()):
        native = _core.evidence_peak(each, contrast, filter_weight, weight)
        twin = reference.evidence_peak(each, contrast, filter_weight, weight)
        assert_array_equal(native, twin, strict=True)


@pytest.mark.parametrize(("right", "down"), [(0.0, 0.0), (3.3, -2.2), (-7.75, 4.5), (0.25, 9.125)])
def test_finds_the_top_of_a_parabola(kernels: Kernels, right: float, down: float) -> None:
    """Evidence that is a paraboloid has its peak where that has it, to the roundings of float32."""
    y, x = np.indices((32, 40), dtype=float)
    plane = (1 - 0.01 * ((x - 20 - right) ** 2 + (y - 16 - down) ** 2)).astype(np.float32)
    found = kernels.evidence_peak(plane[None], NONE, 1.0, 0.0)
    # Differences of numbers near 1, by a bend of 0.02.
    assert_allclose(found[:2], [right, down], rtol=0, atol=4 * np.finfo(np.float32).eps / 0.02)


def test_contrast_decides_between_equal_responses(kernels: Kernels) -> None:
    """Of two peaks alike it is that with more contrast, whose numbers are given."""
    responses = np.zeros((2, 9, 9), np.float32)
    responses[0, 2, 2] = responses[0, 6, 5] = 1
    responses[1, 5, 4] = 0.5  # next to the second
    contrast = np.zeros((9, 9), np.float32)
    contrast[6, 5] = 0.25
    found = kernels.evidence_peak(responses, contrast, 2.0, 4.0)
    assert_array_equal(found, [1, 2, 3, 1, 0.25, 1, 0.5])


def test_at_the_border(kernels: Kernels) -> None:
    """A peak in a corner has no neighbors to be placed between."""
    responses = np.zeros((1, 4, 6), np.float32)
    responses[0, 0, 5] = 1
    assert_array_equal(kernels.evidence_peak(responses, NONE, 1.0, 1.0), [2, -2, 1, 1, 0, 1])


ONE = np.ones((1, 2, 3), np.float32)
BAD: list[tuple[tuple[Any, ...], str]] = [
    ((np.ones((0, 2, 3), np.float32), NONE, 1.0, 1.0), "responses: expected at least one filter and cell"),
    ((ONE, np.ones((3, 2), np.float32), 1.0, 1.0), r"contrast: expected shape \(2, 3\), got \(3, 2\)"),
    ((ONE, NONE, np.nan, 1.0), "filter_weight: expected a finite number, got nan"),
    ((ONE, NONE, 1.0, np.inf), "contrast_weight: expected a finite number, got inf"),
    ((np.array([[[1, np.nan]]], np.float32), NONE, 1.0, 1.0), "evidence: expected finite numbers"),
    ((np.array([[[1, np.inf]]], np.float32), NONE, 1.0, 1.0), "evidence: expected finite numbers"),
]


@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_refuses(kernels: Kernels, arguments: tuple[Any, ...], message: str) -> None:
    """Wrong shapes and values are named."""
    with pytest.raises(ValueError, match=message):
        kernels.evidence_peak(*arguments)


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="responses: expected float32"):
        _core.evidence_peak(np.ones((1, 2, 3)), NONE, 1.0, 1.0)  # type: ignore[arg-type]
