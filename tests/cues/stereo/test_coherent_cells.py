# SPDX-License-Identifier: MIT
"""The cells at an expected disparity."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from scipy import ndimage
from tricue import _core, reference
from tricue.kernels import Kernels

Plane = NDArray[np.float32]
NAN = np.float32(np.nan)
planes = arrays(
    np.float32,
    st.tuples(st.integers(0, 20), st.integers(0, 20)),
    elements=st.sampled_from([0.0, 4.0, 5.0, 6.5, 7.0, np.nan]),
)


@given(planes, st.sampled_from([5.0, 6.0]), st.sampled_from([0.0, 0.5, 1.0]), st.sampled_from([1, 3, 7, 41]))
def test_twin_gives_the_same(plane: Plane, expected: float, tolerance: float, window: int) -> None:
    """Native and reference agree on any disparities: votes are whole numbers."""
    arguments = (plane, expected, tolerance, window)
    assert_array_equal(_core.coherent_cells(*arguments), reference.coherent_cells(*arguments))


def test_agrees_with_scipy(kernels: Kernels) -> None:
    """Where there is no disparity, the sum of the votes is SciPy's uniform filter."""
    rng = np.random.default_rng(0)
    plane = rng.choice(np.array([5, 5.5, 9, NAN], np.float32), (40, 50), p=[0.2, 0.2, 0.3, 0.3])
    votes = np.where(np.isnan(plane), 0, np.where(plane < 6, 1, -1))
    sums = np.rint(ndimage.uniform_filter(votes * 1e3, 7, mode="constant") * 49 / 1e3)
    expected = np.where(votes == 0, sums > 0, votes > 0)
    assert (votes == 0).any()
    assert_array_equal(kernels.coherent_cells(plane, 5.0, 0.75, 7), expected)


def test_gaps_are_filled_by_the_majority(kernels: Kernels) -> None:
    """A gap inside of the head is the head's, one inside of the background the background's, a tie none's."""
    plane = np.full((9, 18), 5, np.float32)
    plane[:, 9:] = 2
    plane[4, [2, 15]] = NAN
    found = kernels.coherent_cells(plane, 5.0, 0.5, 3)
    assert_array_equal(found, np.repeat([[1] * 9 + [0] * 9], 9, axis=0))
    assert not kernels.coherent_cells(np.array([[5, NAN, 2]], np.float32), 5.0, 0.5, 3)[0, 1]


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"expected": np.nan}, "expected: expected a finite number"),
        ({"tolerance": -1.0}, "tolerance: expected 0 or more"),
        ({"tolerance": np.nan}, "tolerance: expected 0 or more"),
        ({"window": 4}, "window: expected an odd number from 1 to 127, got 4"),
        ({"window": -1}, "window: expected an odd number from 1 to 127"),
        ({"window": 129}, "window: expected an odd number from 1 to 127"),
    ],
)
def test_bad_values_are_refused(kernels: Kernels, changes: dict[str, Any], text: str) -> None:
    """Errors name the argument, what was expected and what came."""
    arguments = {"expected": 5.0, "tolerance": 1.0, "window": 7} | changes
    with pytest.raises(ValueError, match=text):
        kernels.coherent_cells(np.zeros((4, 5), np.float32), **arguments)
