# SPDX-License-Identifier: MIT
"""Two filters' responses to 19 channels of 32x32 cells: native, reference, and OpenCV's transforms."""

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
CELLS = random.uniform(-1, 1, (19, 32, 32)).astype(np.float32)
FILTERS = np.ascontiguousarray(np.fft.rfft2(random.uniform(-1, 1, (2, *CELLS.shape))), np.complex64)


def prepared(spectra: Complexes) -> list[Floats]:
    """A filter as the baseline needs it: whole spectra (32, 32, 2), made before the clock starts."""
    weights = np.fft.irfft2(spectra, (32, 32)).astype(np.float32)
    return [cv2.dft(each, flags=cv2.DFT_COMPLEX_OUTPUT) for each in weights]


PREPARED = [prepared(each) for each in FILTERS]


def script(cells: Floats, filters: Complexes) -> Floats:
    """The baseline: transforms and products by OpenCV, plane by plane."""
    planes = [cv2.dft(plane, flags=cv2.DFT_COMPLEX_OUTPUT) for plane in cells]
    answers = []
    for spectra in PREPARED:
        total = np.zeros((32, 32, 2), np.float32)
        for plane, spectrum in zip(planes, spectra, strict=True):
            total += cv2.mulSpectrums(plane, spectrum, 0)
        answer = cv2.idft(total, flags=cv2.DFT_SCALE | cv2.DFT_REAL_OUTPUT)
        answers.append(np.fft.fftshift(answer))
    return np.array(answers)


IMPLEMENTATIONS = {
    "native": _core.correlation_response,
    "reference": reference.correlation_response,
    "baseline": script,
}


@pytest.mark.benchmark(group="correlation_response, 2 filters, 19 x 32x32")
@pytest.mark.work(flops32=21 * 25_600 + 2 * 19 * 8 * 32 * 17)
@pytest.mark.parametrize("respond", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_correlation_response(benchmark: Any, respond: Callable[..., Floats]) -> None:
    """All give the same responses."""
    answer = benchmark(respond, CELLS, FILTERS)
    expected = reference.correlation_response(CELLS, FILTERS)
    assert_allclose(answer, expected, atol=1e-5 * abs(expected).max())
