# SPDX-License-Identifier: MIT
"""Images of depth: 16 bits of one channel a pixel, 0 where nothing was measured, in a unit of the format."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.numbers import positive
from tricue.data.streams import decode

MILLIMETRES = 0.001


@dataclass(frozen=True)
class DepthReader:
    """Reads a 16-bit image as metres, (H, W) float32; what is 0 in the file stays 0.

    scale: metres per unit. rotated: whether the bits are turned three places to the left, as in the Princeton
    Tracking Benchmark: the true value is ``value >> 3 | value << 13``.
    ValueError names a file that can't be read or isn't 16 bits of one channel.
    """

    scale: float
    rotated: bool = False

    def __post_init__(self) -> None:
        positive(self.scale, "depth_scale", "metres per unit")

    def __call__(self, path: Path) -> NDArray[np.float32]:
        units = decode(path, cv2.IMREAD_UNCHANGED)
        if units.dtype != np.uint16 or units.ndim != 2:
            picture = "; 8 bits are a picture of the depth, not metres" if units.dtype == np.uint8 else ""
            raise ValueError(
                f"{path}: expected depth, 16 bits of one channel, got {units.dtype} {units.shape}{picture}"
            )
        if self.rotated:
            units = (units >> 3) | (units << 13)
        metres: NDArray[np.float32] = units * np.float32(self.scale)
        return metres


def is_depth(path: Path) -> bool:
    """Whether a picture has 16 bits of one channel; False where it can't be read."""
    try:
        image = decode(path, cv2.IMREAD_UNCHANGED)
    except (OSError, ValueError):
        return False
    return image.dtype == np.uint16 and image.ndim == 2


def known_scale(place: Path, scale: float | None) -> float:
    """The scale; ValueError, never a guess, where it isn't given."""
    if scale is None:
        raise ValueError(
            f"{place}: expected --depth-scale, the metres per unit of these 16-bit images; "
            "0.001 where they are millimetres, 0.0002 for TUM's"
        )
    return scale
