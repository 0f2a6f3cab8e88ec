# SPDX-License-Identifier: MIT
"""Learning from 11 scales of 576 channels: native, reference, and OpenCV's transform of rows."""

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

LOOKS = np.random.default_rng(0).uniform(-1, 1, (11, 576)).astype(np.float32)
LABEL = np.fft.rfft(np.exp(-(np.fft.fftfreq(11, 1 / 11) ** 2) / 2)).astype(np.complex64)
NONE = np.zeros((6, 576), np.complex64), np.zeros(6, np.float32)


def script(looks: Floats, label: Complexes, numerator: Complexes, denominator: Floats, rate: float) -> Filter:
    """Do it as one would without the kernel."""
    rows = np.ascontiguousarray(looks.T)
    spectrum = cv2.dft(rows, flags=cv2.DFT_ROWS | cv2.DFT_COMPLEX_OUTPUT).view(np.complex64)[:, :6, 0].T
    energy = (spectrum.real**2 + spectrum.imag**2).sum(axis=1)
    new = label[:, None] * spectrum.conj()
    return numerator + rate * (new - numerator), denominator + rate * (energy - denominator)


IMPLEMENTATIONS = {"native": _core.scale_train, "reference": reference.scale_train, "baseline": script}


@pytest.mark.benchmark(group="scale_train, 11 x 576")
@pytest.mark.parametrize("train", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_scale_train(benchmark: Any, train: Callable[..., Filter]) -> None:
    """All learn the same."""
    arguments = LOOKS, LABEL, *NONE, 0.5
    found, expected = benchmark(train, *arguments), reference.scale_train(*arguments)
    for ours, theirs in zip(found, expected, strict=True):
        assert_allclose(ours, theirs, atol=1e-5 * abs(theirs).max())
