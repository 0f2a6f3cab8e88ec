# SPDX-License-Identifier: MIT
"""Learning of a correlation filter with many channels."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.linalg import dft
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
    (3, 65, 10),
    (2, 12, 75),
]


def case(shape: tuple[int, int, int], seed: int = 0) -> dict[str, Any]:
    """All arguments, of noise, with a filter that is there already."""
    rng = np.random.default_rng(seed)
    half = (shape[1], shape[2] // 2 + 1)
    return {
        "cells": rng.uniform(-1, 1, shape).astype(np.float32),
        "label": np.ascontiguousarray(np.fft.rfft2(rng.random(shape[1:])), np.complex64),
        "numerator": (rng.random((shape[0], *half)) + 1j * rng.random((shape[0], *half))).astype(
            np.complex64
        ),
        "denominator": rng.random(half).astype(np.float32),
        "rate": 0.3,
    }


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_native_is_the_twin(shape: tuple[int, int, int], fourier_error: Callable[..., float]) -> None:
    """Both give the same for even, odd and prime sizes and any count of channels: to the error of the
    spectra, part of the cells' norm, times the label, or twice times the spectra, which are no
    longer than that norm.
    """
    arguments = case(shape)
    native, twin = _core.correlation_train(**arguments), reference.correlation_train(**arguments)
    assert [part.dtype for part in native] == [part.dtype for part in twin] == [np.complex64, np.float32]
    assert [part.shape for part in native] == [part.shape for part in twin]
    error = fourier_error(*shape[1:]) + 6 * 2.0**-24
    norm = np.linalg.norm(arguments["cells"]) * np.sqrt(shape[1] * shape[2])
    assert (abs(native[0] - twin[0]) <= error * (norm * abs(arguments["label"]) + 1)).all()
    assert (abs(native[1] - twin[1]) <= error * (2 * norm**2 + 1)).all()


@pytest.mark.parametrize("shape", [(2, 4, 6), (1, 5, 7), (3, 8, 3)], ids=str)
def test_is_scipys_fourier_matrix(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """Numerator and denominator are as the definition of the transform has them, by SciPy's matrices."""
    arguments = case(shape) | {"rate": 1.0}
    down, across = dft(shape[1]), dft(shape[2])[:, : shape[2] // 2 + 1]
    spectra = down @ arguments["cells"].astype(np.float64) @ across
    numerator, denominator = kernels.correlation_train(**arguments)
    assert_allclose(numerator, arguments["label"] * spectra.conj(), atol=2e-4)
    assert_allclose(denominator, (abs(spectra) ** 2).sum(axis=0), rtol=1e-5, atol=1e-5)


def test_blends_at_the_rate(kernels: Kernels) -> None:
    """A rate of 0 keeps the filter, 1 forgets it, and others are in between."""
    arguments = case((3, 6, 8))
    old = arguments["numerator"], arguments["denominator"]
    new = kernels.correlation_train(**arguments | {"rate": 1.0})
    for kept, before in zip(kernels.correlation_train(**arguments | {"rate": 0.0}), old, strict=True):
        assert_array_equal(kept, before)
    for part, before, after in zip(kernels.correlation_train(**arguments), old, new, strict=True):
        assert_allclose(part, 0.7 * before + 0.3 * after, rtol=1e-5, atol=1e-5)
    none = {"numerator": 0 * old[0], "denominator": 0 * old[1], "rate": 1.0}
    for part, after in zip(kernels.correlation_train(**arguments | none), new, strict=True):
        assert_allclose(part, after, rtol=1e-6, atol=1e-6)


def test_shifted_cells_have_the_same_energy(kernels: Kernels) -> None:
    """A shift turns phases only: of the numerator, which stays as large, not of the denominator."""
    arguments = case((2, 9, 10)) | {"rate": 1.0}
    shifted = {"cells": np.roll(arguments["cells"], (3, -4), (-2, -1))}
    here, there = (kernels.correlation_train(**arguments | changes) for changes in ({}, shifted))
    assert_allclose(there[1], here[1], rtol=2e-5)
    assert_allclose(abs(there[0]), abs(here[0]), rtol=2e-4, atol=2e-5)


BAD: list[tuple[dict[str, Any], str]] = [
    (
        {"cells": np.zeros((0, 4, 6), np.float32)},
        r"cells: expected at least one channel and cell, got \(0, 4, 6\)",
    ),
    ({"label": np.zeros((4, 6), np.complex64)}, r"label: expected shape \(4, 4\), got \(4, 6\)"),
    (
        {"numerator": np.zeros((1, 4, 4), np.complex64)},
        r"numerator: expected shape \(2, 4, 4\), got \(1, 4, 4\)",
    ),
    ({"denominator": np.zeros((5, 4), np.float32)}, r"denominator: expected shape \(4, 4\), got \(5, 4\)"),
    ({"rate": 1.5}, r"rate: expected a number in \[0, 1\], got 1.5"),
    ({"rate": float("nan")}, r"rate: expected a number in \[0, 1\], got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.correlation_train(**case((2, 4, 6)) | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    good = case((2, 4, 6))
    with pytest.raises(TypeError, match="cells: expected float32"):
        _core.correlation_train(**good | {"cells": np.zeros((2, 4, 6))})
    with pytest.raises(TypeError, match="label: expected complex64"):
        _core.correlation_train(**good | {"label": np.zeros((4, 4), np.complex128)})
    with pytest.raises(ValueError, match="cells: expected a C-contiguous"):
        _core.correlation_train(**good | {"cells": np.zeros((6, 4, 2), np.float32).T})
