# SPDX-License-Identifier: MIT
"""Depth images as colors."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image

MIN_RANGE = 0.01  # meters
_DEPTH_COLORMAP = cv2.COLORMAP_CIVIDIS  # perceptually uniform, and readable with red-green color blindness


def depth_picture(depth: NDArray[np.float32], near: float | None = None, far: float | None = None) -> Image:
    """A depth image (H, W), meters, as a BGR image (H, W, 3): near is bright, far is dark, NaN is black.

    near, far: the depths of the brightest and of the darkest color, meters; by default the 2nd and the 98th
    percentile of the image. ValueError unless near is below far.
    """
    if near is not None and far is not None and not near < far:
        raise ValueError(f"near, far: expected near below far, meters, got {near} and {far}")
    low, high = depth_range(depth) or (0.0, 1.0)
    low, high = low if near is None else near, high if far is None else far
    with np.errstate(invalid="ignore"):
        closeness = (high - np.asarray(depth, np.float32)) / max(high - low, 1e-6)
    gray = np.nan_to_num(np.clip(closeness, 0, 1) * 255).astype(np.uint8)
    picture = cv2.applyColorMap(gray, _DEPTH_COLORMAP)
    picture[~np.isfinite(depth)] = 0
    return np.asarray(picture, np.uint8)


def depth_range(depth: NDArray[np.float32]) -> tuple[float, float] | None:
    """The 2nd and the 98th percentile of the measured depths, meters; None if nothing was measured.

    It is at least MIN_RANGE wide, so that a flat wall can be drawn.
    """
    rows, columns = (max(1, n // 120) for n in depth.shape)  # some tens of thousands of pixels suffice
    sample = depth[::rows, ::columns]
    measured = sample[np.isfinite(sample)]
    if measured.size == 0:
        measured = depth[np.isfinite(depth)]
    if measured.size == 0:
        return None
    low, high = np.percentile(measured, [2, 98])
    return float(low), max(float(high), float(low) + MIN_RANGE)
