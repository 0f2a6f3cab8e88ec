# SPDX-License-Identifier: MIT
"""Learning of the filter of a target's place."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tricue import _core, reference
from tricue.kernels import Kernels


def arguments(seed: int = 0, first_weight: float = 0.2) -> list[Any]:
    """Of a patch of noise."""
    rng = np.random.default_rng(seed)
    patch = rng.integers(0, 256, (64, 64, 3), np.uint8)
    taper, mask = rng.random((32, 32), np.float32), rng.random((32, 32), np.float32)
    label = np.ascontiguousarray(np.fft.rfft2(np.exp(-rng.random((32, 32)))), np.complex64)
    weights = rng.uniform(-1, 1, (2, 19, 32, 32)) / 1024
    before, first = np.ascontiguousarray(np.fft.rfft2(weights), np.complex64)
    return [patch, taper, mask, label, before, first, 2.0, 0.05, first_weight]


@pytest.mark.parametrize("first_weight", [0.0, 0.2, 1.0])
def test_native_is_the_twin(first_weight: float) -> None:
    """Both learn the same, to the roundings of transforms in float32."""
    native = _core.learn_place_filter(*arguments(1, first_weight))
    twin = reference.learn_place_filter(*arguments(1, first_weight))
    for own, other in zip(native, twin, strict=True):
        assert own.dtype == other.dtype == np.complex64
        assert own.shape == other.shape
        assert_allclose(own, other, atol=2e-5 * abs(other).max())


def test_is_its_parts(kernels: Kernels) -> None:
    """It gives what the kernels that it stands for give one after the other, to the last bit; applied are a
    filter between the learned and the first one, and the first one.
    """
    patch, taper, mask, label, before, first, *weights = arguments()
    learned, applied = kernels.learn_place_filter(patch, taper, mask, label, before, first, *weights)
    cells = kernels.hog_color_cells(patch, taper)
    assert_array_equal(learned, kernels.regularized_filter(cells, mask, label, before, *weights[:2]))
    assert_array_equal(applied[1], first)
    assert_allclose(applied[0], 0.8 * learned + 0.2 * first, atol=1e-6 * abs(first).max())


@pytest.mark.parametrize(
    ("index", "value", "message"),
    [
        (5, np.zeros((18, 32, 17), np.complex64), r"first: expected shape \(19, 32, 17\)"),
        (4, np.zeros((19, 32, 16), np.complex64), r"previous: expected shape \(19, 32, 17\)"),
        (8, 1.5, r"first_weight: expected a number in \[0, 1\], got 1.5"),
        (7, 0.0, "penalty: expected a finite number above 0, got 0"),
    ],
)
def test_refuses(kernels: Kernels, index: int, value: Any, message: str) -> None:
    """Wrong shapes and values are named."""
    each = arguments()
    each[index] = value
    with pytest.raises(ValueError, match=message):
        kernels.learn_place_filter(*each)
