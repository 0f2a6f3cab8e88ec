# SPDX-License-Identifier: MIT
"""The answer to 11 scales of 576 channels: native, reference, and OpenCV's transform of rows."""

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
LOOKS = random.uniform(-1, 1, (11, 576)).astype(np.float32)
NUMERATOR = np.fft.rfft(random.uniform(-1, 1, LOOKS.shape), axis=0).astype(np.complex64)
DENOMINATOR = 1 + 0.5 * np.cos(2 * np.pi * np.arange(6) / 11).astype(np.float32)


def script(looks: Floats, numerator: Complexes, denominator: Floats, ridge: float) -> Floats:
    """Do it as one would without the kernel."""
    rows = np.ascontiguousarray(looks.T)
    spectrum = cv2.dft(rows, flags=cv2.DFT_ROWS | cv2.DFT_COMPLEX_OUTPUT).view(np.complex64)[:, :6, 0]
    half = (numerator * spectrum.T).sum(axis=1) / (denominator + ridge * denominator.mean())
    product = np.concatenate([half, half[:0:-1].conj()])
    answer = cv2.idft(product.view(np.float32).reshape(1, -1, 2), flags=cv2.DFT_SCALE | cv2.DFT_REAL_OUTPUT)
    return np.fft.fftshift(answer[0])


IMPLEMENTATIONS = {"native": _core.scale_response, "reference": reference.scale_response, "baseline": script}


@pytest.mark.benchmark(group="scale_response, 11 x 576")
@pytest.mark.parametrize("respond", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_scale_response(benchmark: Any, respond: Callable[..., Floats]) -> None:
    """All answer the same."""
    answer = benchmark(respond, LOOKS, NUMERATOR, DENOMINATOR, 0.01)
    expected = reference.scale_response(LOOKS, NUMERATOR, DENOMINATOR, 0.01)
    assert_allclose(answer, expected, atol=1e-5 * abs(expected).max())
