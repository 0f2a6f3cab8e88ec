# SPDX-License-Identifier: MIT
"""What a frame brings: checked, and made into a picture and a way to measure depth."""

from functools import lru_cache
from typing import Any, NamedTuple

import cv2
import numpy as np

from tricue.camera.frame import Frame, FrameLike, as_frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.errors import UnregisteredDepthError
from tricue.kernels import Kernels
from tricue.track.base import validation
from tricue.track.fused.depth_sources import DepthImage, Pair
from tricue.track.fused.sight import Around, Expected, Image, Plane, Ranger, Sight, shades


class Seen(NamedTuple):
    """A checked frame. color: (H, W, 3) BGR. camera: of the color, or left, or depth image."""

    shape: tuple[int, int]
    color: Image | None
    depth: Plane | None
    ranger: Ranger | None
    camera: Intrinsics
    timestamp: float | None

    def sight(self, k: Kernels, expected: Expected | None, around: Around | None = None) -> Sight:
        """What the experts see of it. Without color a picture of the depth stands in, round the depth that is
        expected, and around a place.
        """
        if self.color is not None:
            return Sight(k, self.color, "color", self.camera, self.ranger, expected)
        assert self.depth is not None, "a frame has color or depth"
        picture = shades(self.depth, expected.z, around) if expected else np.zeros((*self.shape, 3), np.uint8)
        return Sight(k, picture, "depth", self.camera, self.ranger, expected, self.depth)


def read(
    k: Kernels,
    frame: FrameLike,
    shape: tuple[int, int] | None,
    cameras: tuple[StereoRig | None, Intrinsics | None],
    with_depth: bool,
) -> Seen:
    """The frame's channels. ValueError for another size than the first frame's or the camera's, and for a
    depth of another size than the color image's, to which it has to be registered.
    """
    given = as_frame(frame)
    image: Any = given.depth if given.color is None else given.color
    name = "depth" if given.color is None else "color"
    size = image.shape[:2]
    if shape is not None and size != shape:
        hint = "init starts again on another size"
        raise ValueError(f"frame.{name}: expected the first frame's size {shape}, got {size}; {hint}")
    if given.depth is not None and given.depth.shape != size:
        hint = "it has to be that of the color image's pixels"
        raise UnregisteredDepthError(f"frame.depth: expected shape {size}, got {given.depth.shape}; {hint}")
    for known in (cameras[0].intrinsics if cameras[0] else None, cameras[1]):
        if known is not None and (known.height, known.width) != size:
            expected = f"the camera's size, {known.width}x{known.height}"
            raise ValueError(f"frame.{name}: expected {expected}, got {size[1]}x{size[0]}")
    rig, camera = _described(*cameras, size)
    ranger = _ranger(k, given, rig) if with_depth or given.color is None else None
    color = None if given.color is None else _bgr(given.color)
    return Seen(size, color, given.depth, ranger, camera, given.timestamp)


@lru_cache(maxsize=8)
def _described(
    rig: StereoRig | None, camera: Intrinsics | None, size: tuple[int, int]
) -> tuple[StereoRig, Intrinsics]:
    """The rig and its camera; usual ones where nothing is known."""
    if rig is None:
        rig = StereoRig(validation.camera_for(camera, size), validation.USUAL_BASELINE)
    return rig, rig.intrinsics


def _ranger(k: Kernels, frame: Frame, rig: StereoRig) -> Ranger | None:
    if frame.depth is not None:
        return DepthImage(frame.depth)
    if frame.right is not None and frame.color is not None:
        return Pair(k, _bgr(frame.color), _bgr(frame.right), rig)
    return None


def _bgr(image: Image) -> Image:
    return image if image.ndim == 3 else cv2.cvtColor(image, cv2.COLOR_GRAY2BGR)  # type: ignore[return-value]
