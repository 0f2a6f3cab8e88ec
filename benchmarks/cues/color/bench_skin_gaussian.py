# SPDX-License-Identifier: MIT
"""A Gaussian of chrominance on 100 ellipses: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
MEAN, PRECISION = np.array([110.0, 150.0]), np.array([[0.01, 0.002], [0.002, 0.01]])


def script(samples: Image, mean: NDArray[np.float64], precision: NDArray[np.float64]) -> NDArray[np.float32]:
    """The baseline: cvtColor, which rounds the chrominance, then float32."""
    pixels = np.ascontiguousarray(samples.transpose(0, 2, 1))
    chroma = cv2.cvtColor(pixels, cv2.COLOR_BGR2YCrCb)[:, :, :0:-1].astype(np.float32) - mean.astype(
        np.float32
    )
    squared = np.einsum("nik,kl,nil->ni", chroma, precision.astype(np.float32), chroma)
    density: NDArray[np.float32] = cv2.exp(-0.5 * squared)
    return density


@pytest.mark.benchmark(group="skin_gaussian")
@pytest.mark.work(flops32=40 * 100 * 251)
@pytest.mark.parametrize(
    "skin_gaussian",
    [_core.skin_gaussian, reference.skin_gaussian, script],
    ids=["native", "reference", "baseline"],
)
def bench_skin_gaussian(benchmark: Any, skin_gaussian: Callable[..., Any], samples: Image) -> None:
    """All agree, except that OpenCV rounds Y, Cb, Cr: by up to 0.96 in Cb and Cr, whose deviation is 9."""
    density = benchmark(skin_gaussian, samples, MEAN, PRECISION)
    assert_allclose(
        density, reference.skin_gaussian(samples, MEAN, PRECISION), rtol=0, atol=0.61 * 0.96 * 2**0.5 / 9
    )
