# SPDX-License-Identifier: MIT
"""Depth images: one channel of 16 bits, 0 where nothing was measured; the unit depends on the format."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.numbers import positive
from tricue.data.streams import read_image

METERS_PER_MILLIMETER = 0.001
_FLOAT_HINT = "; write meters as millimeters into 16-bit PNG files"
HINTS = {
    "uint8": "; 8 bits are a picture of the depth, not meters",
    "float32": _FLOAT_HINT,
    "float64": _FLOAT_HINT,
}
"""What to do about depth of other types."""


@dataclass(frozen=True)
class DepthReader:
    """Reads a 16-bit image as meters, (H, W) float32; 0 stays 0.

    scale: meters per unit. rotated: whether the bits are rotated left by three, as in the Princeton Tracking
    Benchmark: the depth is then ``value >> 3 | value << 13``. ValueError names a file that can't be read or
    isn't one channel of 16 bits.
    """

    scale: float
    rotated: bool = False

    def __post_init__(self) -> None:
        positive(self.scale, "depth_scale", "meters per unit")

    def __call__(self, path: Path) -> NDArray[np.float32]:
        units = read_image(path, cv2.IMREAD_UNCHANGED)
        if units.dtype != np.uint16 or units.ndim != 2:
            hint = HINTS.get(units.dtype.name, "")
            raise ValueError(
                f"{path}: expected depth, 16 bits of one channel, got {units.dtype} {units.shape}{hint}"
            )
        if self.rotated:
            units = (units >> 3) | (units << 13)
        meters: NDArray[np.float32] = units * np.float32(self.scale)
        return meters


def is_depth(path: Path) -> bool:
    """Whether an image is one channel of 16 bits; False if it can't be read."""
    try:
        image = read_image(path, cv2.IMREAD_UNCHANGED)
    except (OSError, ValueError):
        return False
    return image.dtype == np.uint16 and image.ndim == 2


def require_scale(place: Path, scale: float | None) -> float:
    """The scale, meters per unit; ValueError if it isn't given, because it is never guessed."""
    if scale is None:
        raise ValueError(
            f"{place}: expected depth_scale, the meters per unit of these 16-bit images; "
            "0.001 where they are millimeters, 0.0002 for TUM's; gray images that aren't depth need 8 bits"
        )
    return scale
