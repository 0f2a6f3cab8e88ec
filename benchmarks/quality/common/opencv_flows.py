# SPDX-License-Identifier: MIT
"""OpenCV's optical flows, as functions of two gray frames (H, W) that return (H, W, 2) in pixels."""

from collections.abc import Callable

import cv2
import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]
Floats = NDArray[np.float32]
DenseFlow = Callable[[Image, Image], Floats]


def farneback() -> DenseFlow:
    """cv2's Farneback flow, by polynomial expansion, with the parameters of OpenCV's samples."""

    def calc(previous: Image, current: Image) -> Floats:
        flow = cv2.calcOpticalFlowFarneback(previous, current, None, 0.5, 3, 15, 3, 5, 1.2, 0)  # type: ignore[call-overload]
        return np.asarray(flow, np.float32)

    return calc


def dis(preset: int) -> DenseFlow:
    """cv2's dense inverse search; its buffers are kept between calls."""
    search = cv2.DISOpticalFlow.create(preset)

    def calc(previous: Image, current: Image) -> Floats:
        return np.asarray(search.calc(previous, current, None), np.float32)  # type: ignore[call-overload]

    return calc


def lucas_kanade(previous: Image, current: Image, pixels: NDArray[np.bool_]) -> Floats:
    """cv2's pyramidal Lucas-Kanade at the given pixels, (H, W, 2); 0 elsewhere, and for lost pixels."""
    points = np.argwhere(pixels)[:, None, ::-1].astype(np.float32)
    moved, status, _ = cv2.calcOpticalFlowPyrLK(previous, current, points, None)  # type: ignore[call-overload]
    flow = np.zeros((*pixels.shape, 2), np.float32)
    flow[pixels] = np.where(status > 0, (moved - points)[:, 0], 0)
    return flow
