# SPDX-License-Identifier: MIT
"""The answer of a correlation filter over scales."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.linalg import circulant
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float32]
Complexes = NDArray[np.complex64]


def looks_of(shape: tuple[int, int], seed: int = 0) -> Floats:
    """Noise in [-1, 1]."""
    return np.random.default_rng(seed).uniform(-1, 1, shape).astype(np.float32)


def filter_of(shape: tuple[int, int]) -> tuple[Complexes, Floats]:
    """Any filter of real weights, its denominator from 0.5 to 1.5."""
    numerator = np.fft.rfft(looks_of(shape, 1), axis=0).astype(np.complex64)
    return numerator, (1 + 0.5 * np.cos(np.arange(len(numerator)))).astype(np.float32)


@pytest.mark.parametrize("shape", [(1, 1), (2, 15), (7, 1), (8, 33), (11, 576), (33, 100), (12, 17)], ids=str)
def test_native_is_the_twin(shape: tuple[int, int]) -> None:
    """Both give the same of any count of scales and channels: to the error of the spectra, sums of S products
    with rounded weights, part of the looks' norm, times what the filter makes of it (Cauchy and Schwarz),
    that of sums of D / 16 + 16 products, and that of the way back.
    """
    looks, (numerator, denominator) = looks_of(shape), filter_of(shape)
    native = _core.scale_response(looks, numerator, denominator, 0.01)
    twin = reference.scale_response(looks, numerator, denominator, 0.01)
    assert native.dtype == twin.dtype == np.float32
    assert native.shape == twin.shape == shape[:1]
    error = 2.0**-24 * (shape[0] + 4 + shape[1] / 16 + 20)
    gain = 2 * np.linalg.norm(numerator / denominator[:, None]) / np.sqrt(shape[0])
    assert abs(native - twin).max() <= error * (gain * np.linalg.norm(looks) + np.linalg.norm(twin))


@pytest.mark.parametrize("shape", [(1, 3), (11, 20), (8, 5)], ids=str)
def test_is_a_circular_correlation(kernels: Kernels, shape: tuple[int, int]) -> None:
    """Without a denominator it is a product with SciPy's circulant matrices of the weights."""
    looks, weights = looks_of(shape), looks_of(shape, 1)
    numerator = np.fft.rfft(weights, axis=0).conj().astype(np.complex64)
    almost = np.full(len(numerator), 1 - 1e-3, np.float32)
    found = kernels.scale_response(looks, numerator, almost, 1e-3 / (1 - 1e-3))
    direct = sum(circulant(w).T @ z for w, z in zip(weights.T, looks.T, strict=True))
    assert_allclose(np.fft.ifftshift(found), direct, atol=2e-5)


def test_finds_a_step(kernels: Kernels) -> None:
    """What was learned answers 1 in the middle, and shifted looks where they went."""
    looks = looks_of((11, 64))
    label = np.fft.rfft(np.exp(-(np.fft.fftfreq(11, 1 / 11) ** 2) / 2)).astype(np.complex64)
    none = np.zeros((6, 64), np.complex64), np.zeros(6, np.float32)
    learned = kernels.scale_train(looks, label, *none, 1.0)
    for step in (0, 3, -4):
        answer = kernels.scale_response(np.roll(looks, step, axis=0), *learned, 1e-4)
        assert answer.argmax() == 5 + step
        assert answer.max() == pytest.approx(1, abs=1e-3)


def test_adds_up_channels(kernels: Kernels) -> None:
    """The answer is linear in the looks, and nothing learned answers nothing."""
    looks, (numerator, denominator) = looks_of((9, 40)), filter_of((9, 40))
    whole = kernels.scale_response(looks, numerator, denominator, 0.1)
    parts = [
        np.ascontiguousarray(each[:, part])
        for part in (np.s_[:13], np.s_[13:])
        for each in (looks, numerator)
    ]
    first = kernels.scale_response(parts[0], parts[1], denominator, 0.1)
    second = kernels.scale_response(parts[2], parts[3], denominator, 0.1)
    assert_allclose(whole, first + second, atol=1e-5)
    assert_allclose(kernels.scale_response(-2 * looks, numerator, denominator, 0.1), -2 * whole, atol=1e-5)
    assert not kernels.scale_response(looks, 0 * numerator, 0 * denominator, 0.1).any()


BAD: list[tuple[dict[str, Any], str]] = [
    (
        {"looks": np.zeros((0, 6), np.float32)},
        r"looks: expected at least one scale and channel, got \(0, 6\)",
    ),
    ({"numerator": np.zeros((6, 4), np.complex64)}, r"numerator: expected shape \(3, 6\), got \(6, 4\)"),
    ({"denominator": np.zeros(6, np.float32)}, r"denominator: expected shape \(3,\), got \(6,\)"),
    ({"ridge": 0.0}, "ridge: expected a finite number above 0, got 0"),
    ({"ridge": float("nan")}, "ridge: expected a finite number above 0, got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    numerator, denominator = filter_of((4, 6))
    good = {"looks": looks_of((4, 6)), "numerator": numerator, "denominator": denominator, "ridge": 0.01}
    with pytest.raises(ValueError, match=message):
        kernels.scale_response(**good | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    looks, (numerator, denominator) = looks_of((4, 6)), filter_of((4, 6))
    with pytest.raises(TypeError, match="looks: expected float32 looks"):
        _core.scale_response(looks.astype(np.float64), numerator, denominator, 0.01)
    with pytest.raises(ValueError, match="numerator: expected a C-contiguous"):
        _core.scale_response(looks, np.asfortranarray(numerator), denominator, 0.01)
