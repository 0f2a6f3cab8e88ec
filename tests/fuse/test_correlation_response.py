# SPDX-License-Identifier: MIT
"""The answers of correlation filters with many channels."""

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
    (3, 65, 10),
    (2, 12, 75),
]


def cells_of(shape: tuple[int, ...], seed: int = 0) -> Floats:
    """Noise in [-1, 1]."""
    return np.random.default_rng(seed).uniform(-1, 1, shape).astype(np.float32)


def filters_of(shape: tuple[int, ...], count: int = 1, seed: int = 1) -> Complexes:
    """Any filters of real weights."""
    weights = np.random.default_rng(seed).uniform(-1, 1, (count, *shape))
    return np.ascontiguousarray(np.fft.rfft2(weights), np.complex64)


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_native_is_the_twin(
    shape: tuple[int, int, int], count: int, fourier_error: Callable[..., float]
) -> None:
    """Both give the same for even, odd and prime sizes and any count of channels and filters: to the error of
    the spectra, part of the norm of the two planes that are transformed as one, times what the filter makes
    of it (Cauchy and Schwarz), and that of the way back, part of the norm of two answers.
    """
    cells, filters = cells_of(shape), filters_of(shape, count)
    native = _core.correlation_response(cells, filters)
    twin = reference.correlation_response(cells, filters)
    assert native.dtype == twin.dtype == np.float32
    assert native.shape == twin.shape == (count, *shape[1:])
    gain = 2 * max(map(np.linalg.norm, filters)) / np.sqrt(shape[1] * shape[2])
    bound = fourier_error(*shape[1:]) * (gain * np.linalg.norm(cells) + np.linalg.norm(twin))
    assert abs(native - twin).max() <= bound + 1e-7 * abs(twin).max()


@pytest.mark.parametrize(
    "shape", [(1, 1), (2, 2), (4, 6), (5, 8), (6, 9), (1, 4), (7, 1), (32, 32), (66, 3), (2, 70)], ids=str
)
def test_takes_any_spectrum(kernels: Kernels, shape: tuple[int, int]) -> None:
    """Spectra that no real plane has give what NumPy's irfft2 makes of them, with another filter's beside
    them or without: what should be real and isn't changes nothing.
    """
    rows, columns = shape
    rng = np.random.default_rng(3)
    parts = rng.normal(size=(3, 1, rows, columns // 2 + 1, 2)).astype(np.float32)
    filters = parts.view(np.complex64)[..., 0]
    delta = np.zeros((1, rows, columns), np.float32)
    delta[0, 0, 0] = 1
    found = kernels.correlation_response(delta, filters)
    expected = np.fft.irfft2(filters[:, 0].astype(np.complex128), shape)
    assert_allclose(np.fft.ifftshift(found, axes=(1, 2)), expected, atol=2e-6)


@pytest.mark.parametrize("shape", [(1, 6, 8), (3, 9, 7), (2, 16, 5)], ids=str)
def test_is_scipys_correlation(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """It is the circular correlation with the weights, as SciPy computes it without Fourier's help."""
    cells, weights = cells_of(shape).astype(np.float64), cells_of(shape, 1).astype(np.float64)
    direct = sum(
        correlate(np.tile(cell, (2, 2))[:-1, :-1], weight, "valid", method="direct")
        for cell, weight in zip(cells, weights, strict=True)
    )
    filters = np.ascontiguousarray(np.fft.rfft2(weights).conj()[None], np.complex64)
    (found,) = kernels.correlation_response(cells.astype(np.float32), filters)
    assert_allclose(np.fft.ifftshift(found), direct, atol=2e-5)


def test_finds_a_shift(kernels: Kernels) -> None:
    """What was learned answers 1 in the middle, and shifted cells where they went."""
    for rows, columns in ((32, 32), (15, 22)):
        cells = cells_of((11, rows, columns))
        offsets = (np.fft.fftfreq(n, 1 / n) for n in (rows, columns))
        y, x = np.meshgrid(*offsets, indexing="ij")
        label = np.ascontiguousarray(np.fft.rfft2(np.exp(-(x**2 + y**2) / 4)), np.complex64)
        none = np.zeros((11, *label.shape), np.complex64), np.zeros(label.shape, np.float32)
        upper, lower = kernels.correlation_train(cells, label, *none, 1.0)
        filters = (upper / (lower + 1e-4 * lower.mean()))[None]
        for down, across in ((0, 0), (3, -5), (-7, 2)):
            (answer,) = kernels.correlation_response(np.roll(cells, (down, across), (1, 2)), filters)
            peak = np.unravel_index(answer.argmax(), answer.shape)
            assert peak == (rows // 2 + down, columns // 2 + across)
            assert answer.max() == pytest.approx(1, abs=2e-3)


def test_adds_up_channels(kernels: Kernels) -> None:
    """The answer is linear in the cells, and channels that are 0 change nothing."""
    cells, filters = cells_of((3, 10, 12)), filters_of((3, 10, 12))
    whole = kernels.correlation_response(cells, filters)
    parts = sum(
        kernels.correlation_response(cells[k : k + 1], np.ascontiguousarray(filters[:, k : k + 1]))
        for k in range(3)
    )
    assert_allclose(whole, parts, atol=1e-5)
    assert_allclose(kernels.correlation_response(-2 * cells, filters), -2 * whole, atol=1e-5)
    assert not kernels.correlation_response(0 * cells, filters).any()


@pytest.mark.parametrize("shape", [(3, 10, 12), (2, 7, 9)], ids=str)
def test_filters_answer_by_themselves(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """Each filter answers as it does alone, whatever others are asked with it."""
    cells, filters = cells_of(shape), filters_of(shape, 5)
    together = kernels.correlation_response(cells, filters)
    for f, answer in enumerate(together):
        (alone,) = kernels.correlation_response(cells, filters[f : f + 1])
        assert_allclose(answer, alone, atol=1e-5 * abs(alone).max())


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
        {"filters": np.zeros((0, 2, 4, 4), np.complex64)},
        r"filters: expected at least one filter, got \(0, 2, 4, 4\)",
    ),
    (
        {"filters": np.zeros((2, 2, 4, 6), np.complex64)},
        r"filters: expected shape \(2, 2, 4, 4\), got \(2, 2, 4, 6\)",
    ),
    (
        {"filters": np.zeros((2, 1, 4, 4), np.complex64)},
        r"filters: expected shape \(2, 2, 4, 4\), got \(2, 1, 4, 4\)",
    ),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes are named, with what was expected."""
    good = {"cells": cells_of((2, 4, 6)), "filters": filters_of((2, 4, 6), 2)}
    with pytest.raises(ValueError, match=message):
        kernels.correlation_response(**good | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    cells, filters = cells_of((2, 4, 6)), filters_of((2, 4, 6), 2)
    with pytest.raises(TypeError, match="cells: expected float32 cells"):
        _core.correlation_response(cells.astype(np.float64), filters)
    with pytest.raises(TypeError, match="filters: expected complex64"):
        _core.correlation_response(cells, filters.astype(np.complex128))
    with pytest.raises(ValueError, match="filters: expected complex64"):
        _core.correlation_response(cells, filters[0])
    with pytest.raises(ValueError, match="filters: expected a C-contiguous"):
        _core.correlation_response(cells, filters[:, ::-1])


@pytest.mark.parametrize("shape", [(3, 65, 10), (2, 12, 75)], ids=str)
def test_one_filter_answers_as_the_second_of_two(shape: tuple[int, int, int]) -> None:
    """The last of an odd count of filters, transformed alone, has the same bits as in a pair."""
    cells, filters = cells_of(shape), filters_of(shape)
    alone = _core.correlation_response(cells, filters)
    twice = _core.correlation_response(cells, np.repeat(filters, 2, axis=0))
    assert alone.tobytes() == twice[1:].tobytes()
