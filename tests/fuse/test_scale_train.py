# SPDX-License-Identifier: MIT
"""Learning of a correlation filter over scales."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.linalg import dft
from tricue import _core, reference
from tricue.kernels import Kernels


def case(shape: tuple[int, int], seed: int = 0) -> dict[str, Any]:
    """All arguments, of noise, with a filter that is there already."""
    rng = np.random.default_rng(seed)
    half = (shape[0] // 2 + 1, shape[1])
    return {
        "looks": rng.uniform(-1, 1, shape).astype(np.float32),
        "label": np.fft.rfft(rng.random(shape[0])).astype(np.complex64),
        "numerator": (rng.random(half) + 1j * rng.random(half)).astype(np.complex64),
        "denominator": rng.random(half[0]).astype(np.float32),
        "rate": 0.3,
    }


@pytest.mark.parametrize("shape", [(1, 1), (2, 15), (7, 1), (8, 33), (11, 576), (33, 100), (12, 17)], ids=str)
def test_native_is_the_twin(shape: tuple[int, int]) -> None:
    """Both give the same of any count of scales and channels: to the error of the spectra, sums of S products
    with rounded weights, part of the looks' norm, times the label, or twice times the spectra, which are no
    longer than that norm, and of sums of D / 16 + 16 squares.
    """
    arguments = case(shape)
    native, twin = _core.scale_train(**arguments), reference.scale_train(**arguments)
    assert [part.dtype for part in native] == [part.dtype for part in twin] == [np.complex64, np.float32]
    assert [part.shape for part in native] == [part.shape for part in twin]
    error = 2.0**-24 * (shape[0] + 4 + shape[1] / 16 + 20)
    norms = np.linalg.norm(arguments["looks"], axis=0) * np.sqrt(shape[0])
    assert (abs(native[0] - twin[0]) <= error * (norms * abs(arguments["label"])[:, None] + 1)).all()
    assert (abs(native[1] - twin[1]) <= error * (2 * (norms**2).sum() + 1)).all()


@pytest.mark.parametrize("shape", [(1, 3), (11, 20), (8, 5)], ids=str)
def test_is_scipys_fourier_matrix(kernels: Kernels, shape: tuple[int, int]) -> None:
    """Numerator and denominator are as the definition of the transform has them, by SciPy's matrix."""
    arguments = case(shape) | {"rate": 1.0}
    spectrum = dft(shape[0])[: shape[0] // 2 + 1] @ arguments["looks"].astype(np.float64)
    numerator, denominator = kernels.scale_train(**arguments)
    assert_allclose(numerator, arguments["label"][:, None] * spectrum.conj(), atol=5e-5)
    assert_allclose(denominator, (abs(spectrum) ** 2).sum(axis=1), rtol=1e-5)


def test_blends_at_the_rate(kernels: Kernels) -> None:
    """A rate of 0 keeps the filter, 1 forgets it, and others are in between."""
    arguments = case((9, 30))
    old = arguments["numerator"], arguments["denominator"]
    new = kernels.scale_train(**arguments | {"rate": 1.0})
    for kept, before in zip(kernels.scale_train(**arguments | {"rate": 0.0}), old, strict=True):
        assert_array_equal(kept, before)
    for part, before, after in zip(kernels.scale_train(**arguments), old, new, strict=True):
        assert_allclose(part, 0.7 * before + 0.3 * after, rtol=1e-5, atol=1e-5)


def test_shifted_looks_have_the_same_energy(kernels: Kernels) -> None:
    """A shift turns phases only: of the numerator, which stays as large, not of the denominator."""
    arguments = case((11, 30)) | {"rate": 1.0}
    here = kernels.scale_train(**arguments)
    there = kernels.scale_train(**arguments | {"looks": np.roll(arguments["looks"], 4, axis=0)})
    assert_allclose(there[1], here[1], rtol=1e-5)
    assert_allclose(abs(there[0]), abs(here[0]), rtol=1e-4, atol=2e-5)


BAD: list[tuple[dict[str, Any], str]] = [
    (
        {"looks": np.zeros((4, 0), np.float32)},
        r"looks: expected at least one scale and channel, got \(4, 0\)",
    ),
    ({"label": np.zeros(6, np.complex64)}, r"label: expected shape \(3,\), got \(6,\)"),
    ({"numerator": np.zeros((6, 4), np.complex64)}, r"numerator: expected shape \(3, 6\), got \(6, 4\)"),
    ({"denominator": np.zeros(6, np.float32)}, r"denominator: expected shape \(3,\), got \(6,\)"),
    ({"rate": -0.1}, r"rate: expected a number in \[0, 1\], got -0.1"),
    ({"rate": float("nan")}, r"rate: expected a number in \[0, 1\], got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.scale_train(**case((4, 6)) | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    with pytest.raises(TypeError, match="label: expected complex64"):
        _core.scale_train(**case((4, 6)) | {"label": np.zeros(4, np.complex128)})
    with pytest.raises(ValueError, match="looks: expected a C-contiguous"):
        _core.scale_train(**case((4, 6)) | {"looks": np.zeros((6, 4), np.float32).T})
