# SPDX-License-Identifier: MIT
"""The answer to 11 channels of 32x32 cells: native, reference, and OpenCV's transforms one by one."""

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
NUMERATOR = np.fft.rfft2(random.uniform(-1, 1, CELLS.shape)).astype(np.complex64)
DENOMINATOR = random.uniform(1, 2, NUMERATOR.shape[1:]).astype(np.float32)


def prepared() -> tuple[list[Floats], Floats]:
    """The filter as the peer's tracker would hold it: whole spectra (32, 32, 2), made before the clock."""
    weights = np.fft.irfft2(NUMERATOR, (32, 32)).astype(np.float32)
    half = DENOMINATOR + 0.01 * DENOMINATOR.mean()
    whole = np.concatenate([half, np.roll(half[::-1, 15:0:-1], 1, axis=0)], axis=1)
    return [cv2.dft(each, flags=cv2.DFT_COMPLEX_OUTPUT) for each in weights], whole[..., None]


SPECTRA, SHRUNK = prepared()


def script(cells: Floats, numerator: Complexes, denominator: Floats, ridge: float) -> Floats:
    """Do it as one would without the kernel."""
    total = np.zeros((32, 32, 2), np.float32)
    for plane, spectrum in zip(cells, SPECTRA, strict=True):
        total += cv2.mulSpectrums(cv2.dft(plane, flags=cv2.DFT_COMPLEX_OUTPUT), spectrum, 0)
    answer = cv2.idft(total / SHRUNK, flags=cv2.DFT_SCALE | cv2.DFT_REAL_OUTPUT)
    return np.fft.fftshift(answer)


CONTENDERS = {
    "native": _core.correlation_response,
    "reference": reference.correlation_response,
    "peer": script,
}


@pytest.mark.benchmark(group="correlation_response, 11 x 32x32")
@pytest.mark.parametrize("respond", CONTENDERS.values(), ids=CONTENDERS)
def bench_correlation_response(benchmark: Any, respond: Callable[..., Floats]) -> None:
    """All answer the same."""
    answer = benchmark(respond, CELLS, NUMERATOR, DENOMINATOR, 0.01)
    expected = reference.correlation_response(CELLS, NUMERATOR, DENOMINATOR, 0.01)
    assert_allclose(answer, expected, atol=1e-5 * abs(expected).max())
