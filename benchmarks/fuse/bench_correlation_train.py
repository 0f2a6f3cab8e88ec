# SPDX-License-Identifier: MIT
"""Learning from 19 channels of 32x32 cells: native, reference, and OpenCV's transforms one by one."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float32]
Complexes = NDArray[np.complex64]
Filter = tuple[Complexes, Floats]

HALF = np.s_[:, :17]
random = np.random.default_rng(0)
CELLS = random.uniform(-1, 1, (19, 32, 32)).astype(np.float32)
PEAK = np.outer(np.hanning(32), np.hanning(32)).astype(np.float32) ** 8
LABEL = np.ascontiguousarray(np.fft.rfft2(np.roll(PEAK, (16, 16), (0, 1))), np.complex64)
NONE = np.zeros((19, 32, 17), np.complex64), np.zeros((32, 17), np.float32)


def spectrum(plane: Floats) -> Floats:
    """The spectrum (32, 32, 2): real and imaginary parts."""
    return cv2.dft(plane, flags=cv2.DFT_COMPLEX_OUTPUT)


WHOLE_LABEL = spectrum(np.fft.irfft2(LABEL, (32, 32)).astype(np.float32))


def script(
    cells: Floats,
    label: Complexes,
    numerator: Complexes,
    denominator: Floats,
    rate: float,
) -> Filter:
    """The baseline: transforms by OpenCV, products and blends by NumPy."""
    spectra = np.stack([spectrum(plane) for plane in cells])
    new = np.stack([cv2.mulSpectrums(WHOLE_LABEL, x, 0, conjB=True) for x in spectra])
    energy = (spectra * spectra).sum(axis=(0, 3))[HALF]
    upper = np.ascontiguousarray(new[:, :, :17]).view(np.complex64)[..., 0]
    return numerator + rate * (upper - numerator), denominator + rate * (energy - denominator)


IMPLEMENTATIONS = {
    "native": _core.correlation_train,
    "reference": reference.correlation_train,
    "baseline": script,
}


@pytest.mark.benchmark(group="correlation_train, 19 x 32x32")
@pytest.mark.work(flops32=19 * 25_600 + 19 * 17 * 32 * 17)
@pytest.mark.parametrize("train", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_correlation_train(benchmark: Any, train: Callable[..., Filter]) -> None:
    """All learn the same."""
    arguments = CELLS, LABEL, *NONE, 0.5
    found, expected = benchmark(train, *arguments), reference.correlation_train(*arguments)
    for ours, theirs in zip(found, expected, strict=True):
        assert_allclose(ours, theirs, atol=1e-5 * abs(theirs).max())
