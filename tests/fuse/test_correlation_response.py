# SPDX-License-Identifier: MIT
"""The answer of a correlation filter with many channels."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.signal import correlate
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float32]
Complexes = NDArray[np.complex64]

SHAPES = [
    (1, 1, 1),
    (1, 1, 8),
    (2, 7, 1),
    (3, 2, 2),
    (2, 5, 9),
    (11, 32, 32),
    (4, 12, 15),
    (3, 31, 22),
    (5, 36, 24),
]


def cells_of(shape: tuple[int, ...], seed: int = 0) -> Floats:
    """Noise in [-1, 1]."""
    return np.random.default_rng(seed).uniform(-1, 1, shape).astype(np.float32)


def filter_of(shape: tuple[int, ...], seed: int = 1) -> tuple[Complexes, Floats]:
    """Any filter of real weights: a numerator, and a denominator from 0.5 to 1.5."""
    weights = np.random.default_rng(seed).uniform(-1, 1, shape)
    numerator = np.fft.rfft2(weights).astype(np.complex64)
    return numerator, (0.5 + abs(np.sin(np.arange(numerator[0].size)))).astype(np.float32).reshape(
        numerator[0].shape
    )


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_native_is_the_twin(shape: tuple[int, int, int], fourier_error: Callable[..., float]) -> None:
    """Both give the same for even, odd and prime sizes and any count of channels: to the error of the
    spectra, part of the cells' norm, times what the filter makes of it (Cauchy and Schwarz), and that of the
    way back.
    """
    cells, (numerator, denominator) = cells_of(shape), filter_of(shape)
    native = _core.correlation_response(cells, numerator, denominator, 0.01)
    twin = reference.correlation_response(cells, numerator, denominator, 0.01)
    assert native.dtype == twin.dtype == np.float32
    assert native.shape == twin.shape == shape[1:]
    gain = 2 * np.linalg.norm(numerator / denominator) / np.sqrt(shape[1] * shape[2])
    bound = fourier_error(*shape[1:]) * (gain * np.linalg.norm(cells) + np.linalg.norm(twin))
    assert abs(native - twin).max() <= bound + 1e-7 * abs(twin).max()


@pytest.mark.parametrize("shape", [(1, 6, 8), (3, 9, 7), (2, 16, 5)], ids=str)
def test_is_scipys_correlation(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """Without a denominator it is the circular correlation with the weights, as SciPy computes it without
    Fourier's help.
    """
    cells, weights = cells_of(shape).astype(np.float64), cells_of(shape, 1).astype(np.float64)
    direct = sum(
        correlate(np.tile(cell, (2, 2))[:-1, :-1], weight, "valid", method="direct")
        for cell, weight in zip(cells, weights, strict=True)
    )
    numerator = np.fft.rfft2(weights).conj().astype(np.complex64)
    almost = np.full(numerator.shape[1:], 1 - 1e-3, np.float32)
    found = kernels.correlation_response(cells.astype(np.float32), numerator, almost, 1e-3 / (1 - 1e-3))
    assert_allclose(np.fft.ifftshift(found), direct, atol=2e-5)


def test_finds_a_shift(kernels: Kernels) -> None:
    """What was learnt answers 1 in the middle, and shifted cells where they went."""
    for rows, columns in ((32, 32), (15, 22)):
        cells = cells_of((11, rows, columns))
        offsets = (np.fft.fftfreq(n, 1 / n) for n in (rows, columns))
        y, x = np.meshgrid(*offsets, indexing="ij")
        label = np.fft.rfft2(np.exp(-(x**2 + y**2) / 4)).astype(np.complex64)
        none = np.zeros((11, *label.shape), np.complex64), np.zeros(label.shape, np.float32)
        focus = np.ones((rows, columns), np.float32)
        learnt = kernels.correlation_train(cells, focus, label, *none, 1.0, 0.0)
        for down, across in ((0, 0), (3, -5), (-7, 2)):
            answer = kernels.correlation_response(np.roll(cells, (down, across), (1, 2)), *learnt, 1e-4)
            peak = np.unravel_index(answer.argmax(), answer.shape)
            assert peak == (rows // 2 + down, columns // 2 + across)
            assert answer.max() == pytest.approx(1, abs=2e-3)


def test_adds_up_channels(kernels: Kernels) -> None:
    """The answer is linear in the cells, and channels that are 0 change nothing."""
    cells, (numerator, denominator) = cells_of((3, 10, 12)), filter_of((3, 10, 12))
    whole = kernels.correlation_response(cells, numerator, denominator, 0.1)
    parts = sum(
        kernels.correlation_response(cells[k : k + 1], numerator[k : k + 1], denominator, 0.1)
        for k in range(3)
    )
    assert_allclose(whole, parts, atol=1e-5)
    assert_allclose(
        kernels.correlation_response(-2 * cells, numerator, denominator, 0.1), -2 * whole, atol=1e-5
    )
    assert not kernels.correlation_response(0 * cells, numerator, denominator, 0.1).any()


def test_an_empty_filter_answers_nothing(kernels: Kernels) -> None:
    """Where nothing was learnt yet the ridge keeps from dividing by 0."""
    answer = kernels.correlation_response(
        cells_of((2, 4, 6)), np.zeros((2, 4, 4), np.complex64), np.zeros((4, 4), np.float32), 0.01
    )
    assert not answer.any()


BAD: list[tuple[dict[str, Any], str]] = [
    (
        {"cells": np.zeros((0, 4, 6), np.float32)},
        r"cells: expected at least one channel and cell, got \(0, 4, 6\)",
    ),
    (
        {"cells": np.zeros((2, 4, 0), np.float32)},
        r"cells: expected at least one channel and cell, got \(2, 4, 0\)",
    ),
    (
        {"numerator": np.zeros((2, 4, 6), np.complex64)},
        r"numerator: expected shape \(2, 4, 4\), got \(2, 4, 6\)",
    ),
    ({"denominator": np.zeros((4, 6), np.float32)}, r"denominator: expected shape \(4, 4\), got \(4, 6\)"),
    ({"ridge": 0.0}, "ridge: expected a finite number above 0, got 0"),
    ({"ridge": float("nan")}, "ridge: expected a finite number above 0, got nan"),
    ({"ridge": float("inf")}, "ridge: expected a finite number above 0, got inf"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    numerator, denominator = filter_of((2, 4, 6))
    good = {"cells": cells_of((2, 4, 6)), "numerator": numerator, "denominator": denominator, "ridge": 0.01}
    with pytest.raises(ValueError, match=message):
        kernels.correlation_response(**good | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    cells, (numerator, denominator) = cells_of((2, 4, 6)), filter_of((2, 4, 6))
    with pytest.raises(TypeError, match="cells: expected float32 cells"):
        _core.correlation_response(cells.astype(np.float64), numerator, denominator, 0.01)
    with pytest.raises(TypeError, match="numerator: expected complex64"):
        _core.correlation_response(cells, numerator.astype(np.complex128), denominator, 0.01)
    with pytest.raises(ValueError, match="denominator: expected a C-contiguous"):
        _core.correlation_response(cells, numerator, np.asfortranarray(denominator), 0.01)
