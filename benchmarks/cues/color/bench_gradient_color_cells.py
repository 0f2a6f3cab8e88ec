# SPDX-License-Identifier: MIT
"""Orientations and colors of a patch of 64x64: native, reference, and a script on cv2 and NumPy."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Planes = NDArray[np.float32]


def script(patch: Image, taper: Planes) -> Planes:
    """Do it as one would without the kernel."""
    levels = patch.astype(np.float32)
    right = cv2.Sobel(levels, -1, 1, 0, ksize=1, borderType=cv2.BORDER_REPLICATE)
    down = cv2.Sobel(levels, -1, 0, 1, ksize=1, borderType=cv2.BORDER_REPLICATE)
    strongest = np.argmax(right * right + down * down, axis=2)[..., None]
    gx, gy = (np.take_along_axis(each, strongest, 2)[..., 0] for each in (right, down))
    ax, ay, length = abs(gx), abs(gy), cv2.magnitude(gx, gy)
    diagonal = np.minimum(ax, ay) * length / np.maximum(np.maximum(ax, ay), 1)
    straight = length - diagonal
    flat, to_right, to_down = ax >= ay, gx >= 0, gy >= 0
    bins = np.empty((8, *gx.shape), np.float32)
    bins[0], bins[4] = straight * (flat & to_right), straight * (flat & ~to_right)
    bins[2], bins[6] = straight * (~flat & to_down), straight * (~flat & ~to_down)
    bins[1], bins[7] = diagonal * (to_right & to_down), diagonal * (to_right & ~to_down)
    bins[3], bins[5] = diagonal * (~to_right & to_down), diagonal * (~to_right & ~to_down)
    size = taper.shape[::-1]
    cells = [4 * cv2.resize(plane, size, interpolation=cv2.INTER_AREA) for plane in bins]
    energy = np.square(cells).sum(axis=0)
    block = cv2.boxFilter(energy, -1, (3, 3), normalize=False, borderType=cv2.BORDER_REPLICATE)
    normal = np.minimum(np.array(cells) / np.sqrt(block + np.float32(1024)), np.float32(0.4))
    colors = cv2.resize(levels, size, interpolation=cv2.INTER_AREA).transpose(2, 0, 1) / np.float32(255)
    return np.concatenate([normal, colors - colors.mean(axis=(1, 2), keepdims=True)]) * taper


IMPLEMENTATIONS = {
    "native": _core.gradient_color_cells,
    "reference": reference.gradient_color_cells,
    "baseline": script,
}


@pytest.mark.benchmark(group="gradient_color_cells, 64x64")
@pytest.mark.parametrize("cells_of", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_gradient_color_cells(benchmark: Any, cells_of: Callable[..., Planes], frame: Image) -> None:
    """All agree to float32's rounding."""
    patch = np.ascontiguousarray(frame[80:144, 100:164])
    taper = np.outer(np.hanning(34)[1:-1], np.hanning(34)[1:-1]).astype(np.float32)
    found = benchmark(cells_of, patch, taper)
    assert_allclose(found, reference.gradient_color_cells(patch, taper), atol=1e-6)
