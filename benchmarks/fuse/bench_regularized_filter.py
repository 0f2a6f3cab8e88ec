# SPDX-License-Identifier: MIT
"""Learning of a masked filter, 19 channels of 32x32 cells: native, reference, and OpenCV's transforms."""

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

random = np.random.default_rng(0)
CELLS = random.uniform(0, 0.4, (19, 32, 32)).astype(np.float32)
BELL = np.hanning(32)
BELLS = np.roll(np.outer(BELL, BELL) ** 8, (16, 16), (0, 1))
LABEL = np.ascontiguousarray(np.fft.rfft2(BELLS), np.complex64)
PROFILE = np.pad(np.hanning(24)[1:-1], 5)  # like the fused tracker's mask, two thirds of the window wide
MASK = np.outer(PROFILE, PROFILE).astype(np.float32)
NONE = np.zeros((19, 32, 17), np.complex64)
PREVIOUS = reference.regularized_filter(CELLS[:, ::-1].copy(), MASK, LABEL, NONE, 0.0, 1.0)


def whole(half: Complexes) -> Complexes:
    """(32, 32) from (32, 17): with the other frequencies, which mirror these."""
    return np.fft.fft2(np.fft.irfft2(half, (32, 32))).astype(np.complex64)


WHOLE_LABEL = whole(LABEL)
WHOLE_PREVIOUS = np.stack([whole(each) for each in PREVIOUS])
MIRRORED = np.roll(MASK[::-1, ::-1], 1, (0, 1))


def spectrum(plane: Floats) -> Complexes:
    """The spectrum (32, 32) with all frequencies."""
    return cv2.dft(plane, flags=cv2.DFT_COMPLEX_OUTPUT).view(np.complex64)[..., 0]


def plane(spectrum: Complexes) -> Floats:
    """The real plane of a spectrum."""
    pairs = spectrum.view(np.float32).reshape(32, 32, 2)
    return cv2.idft(pairs, flags=cv2.DFT_SCALE | cv2.DFT_REAL_OUTPUT)


def script(
    cells: Floats,
    mask: Floats,
    label: Complexes,
    previous: Complexes,
    temporal_weight: float,
    penalty: float,
) -> Complexes:
    """The baseline: transforms by OpenCV, one by one, and NumPy."""
    channels = np.stack([spectrum(each) for each in cells])
    conjugate = channels.conj()
    energy = (channels.real**2 + channels.imag**2).sum(axis=0)
    temporal, step = np.float32(1024 * temporal_weight), np.float32(1024 * penalty)
    base = conjugate * WHOLE_LABEL + temporal * WHOLE_PREVIOUS
    masked = dual = np.zeros_like(base)
    for _ in range(2):
        wanted = base + step * (masked - dual)
        free = wanted - conjugate * ((channels * wanted).sum(axis=0) / (energy + step + temporal))
        free /= step + temporal
        masked = np.stack([spectrum(plane(each) * MIRRORED) for each in free + dual])
        dual = dual + free - masked
        step *= np.float32(10)
    return masked[..., :17]


IMPLEMENTATIONS = {
    "native": _core.regularized_filter,
    "reference": reference.regularized_filter,
    "baseline": script,
}


@pytest.mark.benchmark(group="regularized_filter, 19 x 32x32")
@pytest.mark.work(flops32=5 * 19 * 25_600 + 2 * 19 * 30 * 32 * 17)
@pytest.mark.parametrize("learn", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_regularized_filter(benchmark: Any, learn: Callable[..., Complexes]) -> None:
    """All learn the same."""
    arguments = CELLS, MASK, LABEL, PREVIOUS, 16.0, 1.0
    expected = reference.regularized_filter(*arguments)
    assert_allclose(benchmark(learn, *arguments), expected, atol=1e-5 * abs(expected).max())
