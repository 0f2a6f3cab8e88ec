# SPDX-License-Identifier: MIT
"""Two filters' answers to 11 channels of 32x32 cells: native, reference, and OpenCV's transforms."""

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
CELLS = random.uniform(-1, 1, (11, 32, 32)).astype(np.float32)
NUMERATORS = np.fft.rfft2(random.uniform(-1, 1, (2, *CELLS.shape))).astype(np.complex64)
DENOMINATORS = random.uniform(1, 2, (2, 32, 17)).astype(np.float32)


def prepared(numerator: Complexes, denominator: Floats) -> tuple[list[Floats], Floats]:
    """A filter as the baseline's tracker would hold it: whole spectra (32, 32, 2), made before the clock."""
    weights = np.fft.irfft2(numerator, (32, 32)).astype(np.float32)
    half = denominator + 0.01 * denominator.mean()
    whole = np.concatenate([half, np.roll(half[::-1, 15:0:-1], 1, axis=0)], axis=1)
    return [cv2.dft(each, flags=cv2.DFT_COMPLEX_OUTPUT) for each in weights], whole[..., None]


PREPARED = [prepared(*each) for each in zip(NUMERATORS, DENOMINATORS, strict=True)]


def script(cells: Floats, numerators: Complexes, denominators: Floats, ridge: float) -> Floats:
    """Do it as one would without the kernel."""
    planes = [cv2.dft(plane, flags=cv2.DFT_COMPLEX_OUTPUT) for plane in cells]
    answers = []
    for spectra, shrunk in PREPARED:
        total = np.zeros((32, 32, 2), np.float32)
        for plane, spectrum in zip(planes, spectra, strict=True):
            total += cv2.mulSpectrums(plane, spectrum, 0)
        answer = cv2.idft(total / shrunk, flags=cv2.DFT_SCALE | cv2.DFT_REAL_OUTPUT)
        answers.append(np.fft.fftshift(answer))
    return np.array(answers)


IMPLEMENTATIONS = {
    "native": _core.correlation_response,
    "reference": reference.correlation_response,
    "baseline": script,
}


@pytest.mark.benchmark(group="correlation_response, 2 filters, 11 x 32x32")
@pytest.mark.parametrize("respond", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_correlation_response(benchmark: Any, respond: Callable[..., Floats]) -> None:
    """All answer the same."""
    answer = benchmark(respond, CELLS, NUMERATORS, DENOMINATORS, 0.01)
    expected = reference.correlation_response(CELLS, NUMERATORS, DENOMINATORS, 0.01)
    assert_allclose(answer, expected, atol=1e-5 * abs(expected).max())
