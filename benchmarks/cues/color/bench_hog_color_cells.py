# SPDX-License-Identifier: MIT
"""Gradients, texture and colors of a patch of 64x64: native, reference, and a script on cv2 and NumPy."""

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

HAT = np.array([1, 3, 3, 1]) / 4  # bilinear weights of the pixels around a cell of two


def script(patch: Image, taper: Planes) -> Planes:
    """The baseline: gradients, bins and block norms by cv2 and NumPy."""
    levels = patch.astype(np.float32)
    right = cv2.Sobel(levels, -1, 1, 0, ksize=1, borderType=cv2.BORDER_REPLICATE)
    down = cv2.Sobel(levels, -1, 0, 1, ksize=1, borderType=cv2.BORDER_REPLICATE)
    strongest = np.argmax(right * right + down * down, axis=2)[..., None]
    gx, gy = (np.take_along_axis(each, strongest, 2)[..., 0] for each in (right, down))
    ax, ay, length = abs(gx), abs(gy), cv2.magnitude(gx, gy)
    diagonal = np.minimum(ax, ay) / np.maximum(np.maximum(ax, ay), 1) * length
    straight = length - diagonal
    flat, to_right, to_down = ax >= ay, gx >= 0, gy >= 0
    bins = np.empty((8, *gx.shape), np.float32)
    bins[0], bins[4] = straight * (flat & to_right), straight * (flat & ~to_right)
    bins[2], bins[6] = straight * (~flat & to_down), straight * (~flat & ~to_down)
    bins[1], bins[7] = diagonal * (to_right & to_down), diagonal * (to_right & ~to_down)
    bins[3], bins[5] = diagonal * (~to_right & to_down), diagonal * (~to_right & ~to_down)
    signed = np.array(
        [
            cv2.sepFilter2D(each, -1, HAT, HAT, anchor=(1, 1), borderType=cv2.BORDER_CONSTANT)[::2, ::2]
            for each in bins
        ]
    )
    unsigned = signed[:4] + signed[4:]
    energy = cv2.copyMakeBorder(np.square(unsigned).sum(axis=0), 1, 1, 1, 1, cv2.BORDER_REPLICATE)
    block = cv2.boxFilter(energy, -1, (2, 2), normalize=False)[1:, 1:]
    scale = 1 / np.sqrt(block + np.float32(102**2))
    around = np.stack([scale[:-1, :-1], scale[:-1, 1:], scale[1:, :-1], scale[1:, 1:]])[:, None]
    shares = np.minimum(np.concatenate([signed, unsigned]) * around, np.float32(0.2))
    normal, texture = shares.sum(axis=0) / 2, np.float32(0.2357) * shares[:, :8].sum(axis=1)
    size = taper.shape[::-1]
    colors = cv2.resize(levels, size, interpolation=cv2.INTER_AREA).transpose(2, 0, 1) / np.float32(255)
    return np.concatenate([normal, texture, colors - colors.mean(axis=(1, 2), keepdims=True)]) * taper


IMPLEMENTATIONS = {
    "native": _core.hog_color_cells,
    "reference": reference.hog_color_cells,
    "baseline": script,
}


@pytest.mark.benchmark(group="hog_color_cells, 64x64")
@pytest.mark.work(flops32=84 * 64 * 64, divs32=2 * 64 * 64, why="planes are read 2 by 2")
@pytest.mark.parametrize("cells_of", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_hog_color_cells(benchmark: Any, cells_of: Callable[..., Planes], frame: Image) -> None:
    """All agree within float32's rounding."""
    patch = np.ascontiguousarray(frame[80:144, 100:164])
    taper = np.outer(np.hanning(34)[1:-1], np.hanning(34)[1:-1]).astype(np.float32)
    found = benchmark(cells_of, patch, taper)
    assert_allclose(found, reference.hog_color_cells(patch, taper), atol=1e-6)
