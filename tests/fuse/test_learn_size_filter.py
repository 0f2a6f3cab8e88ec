# SPDX-License-Identifier: MIT
"""Learning of the filter of a target's size."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, with_argument


def arguments(seed: int = 0) -> list[Any]:
    """Of a patch of noise, and filters of two others."""
    rng = np.random.default_rng(seed)
    patch = rng.integers(0, 256, (64, 64, 3), np.uint8)
    places = rng.permutation(64 * 64).reshape(64, 64)
    taper = rng.random((32, 32), np.float32)
    label = np.ascontiguousarray(np.fft.rfft2(np.exp(-rng.random((32, 32)))), np.complex64)
    numerators = np.ascontiguousarray(np.fft.rfft2(rng.uniform(-1, 1, (2, 19, 32, 32))), np.complex64)
    denominators = 1000 * rng.random((2, 32, 17), np.float32)
    learned, first = zip(numerators, denominators, strict=True)
    return [patch, places, taper, label, learned, first, 0.1, 0.2, 0.01]


@pytest.mark.parametrize("seed", range(4))
def test_native_is_the_twin(seed: int) -> None:
    """Both learn the same, to the roundings of transforms in float32."""
    native, twin = _core.learn_size_filter(*arguments(seed)), reference.learn_size_filter(*arguments(seed))
    for own, other in zip((*native[0], native[1]), (*twin[0], twin[1]), strict=True):
        assert own.dtype == other.dtype
        assert own.shape == other.shape
        assert_allclose(own, other, atol=1e-5 * abs(other).max())


def test_is_its_parts(kernels: Kernels) -> None:
    """It gives what the kernels that it stands for give one after the other, to the last bit; what is applied
    is the quotient of both filters' mixture, with a ridge.
    """
    patch, places, taper, label, learned, (first_upper, first_lower), *_ = arguments()
    (upper, lower), applied = kernels.learn_size_filter(*arguments())
    cells = kernels.hog_color_cells(kernels.pick_pixels(patch, places), taper)
    expected = kernels.correlation_train(cells, label, *learned, 0.1)
    assert_array_equal(upper, expected[0])
    assert_array_equal(lower, expected[1])
    below = (0.8 * lower + 0.2 * first_lower).astype(float)
    quotient = (0.8 * upper + 0.2 * first_upper) / (below + 0.01 * below.mean())
    assert_allclose(applied[0], quotient, atol=1e-6 * abs(quotient).max())


def test_starts_a_filter(kernels: Kernels) -> None:
    """From nothing at a rate of 1, without a first frame's filter, it answers with the label to its patch."""
    patch, places, taper, label, learned, *_ = arguments()
    nothing = tuple(np.zeros_like(each) for each in learned)
    _, applied = kernels.learn_size_filter(patch, places, taper, label, nothing, nothing, 1.0, 0.0, 1e-9)
    cells = reference.hog_color_cells(reference.pick_pixels(patch, places), taper)
    answer = reference.correlation_response(cells, applied)[0]
    wanted = np.fft.fftshift(np.fft.irfft2(label))
    assert_allclose(answer, wanted, atol=1e-4 * abs(wanted).max())


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        ((5, 0), np.zeros((18, 32, 17), np.complex64), r"first_numerator: expected shape \(19, 32, 17\)"),
        ((5, 1), np.zeros((32, 16), np.float32), r"first_denominator: expected shape \(32, 17\)"),
        (6, -0.1, r"rate: expected a number in \[0, 1\], got -0.1"),
        (7, np.nan, r"first_weight: expected a number in \[0, 1\], got nan"),
        (8, 0.0, "ridge: expected a finite number above 0, got 0"),
    ],
)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong shapes and values are named."""
    with pytest.raises(ValueError, match=message):
        kernels.learn_size_filter(*with_argument(arguments(), place, value))
