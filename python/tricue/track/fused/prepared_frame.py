# SPDX-License-Identifier: MIT
"""A frame's channels, checked and prepared once: a picture and a source of depth."""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from tricue.arrays import Image
from tricue.camera.frame import Frame, FrameLike, as_frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.shared_frame import messages_of, once
from tricue.kernels import Kernels
from tricue.track.base import validation
from tricue.track.fused.depth_sources import DepthImageSource, DepthSource, ExpectedDepth, StereoSource
from tricue.track.fused.picture_observation import PictureObservation


class PreparedFrame(NamedTuple):
    """A checked frame.

    shape: height and width. color: (H, W, 3) BGR; None if the frame has depth alone. depth_source: None
    without depth. camera: of the color, left or depth image. timestamp: seconds. messages: as from
    :func:`messages_of`.
    """

    shape: tuple[int, int]
    color: Image | None
    depth_source: DepthSource | None
    camera: Intrinsics
    timestamp: float | None
    messages: list[str] | None = None

    def for_target(self, k: Kernels, expected: ExpectedDepth | None) -> PictureObservation:
        """The frame as the experts read it, given the target's expected depth.

        Without color, they read a picture drawn from depth.
        """
        return PictureObservation(k, self.color, self.camera, self.depth_source, expected)


def prepare_frame(
    frame: FrameLike,
    shape: tuple[int, int] | None,
    cameras: tuple[StereoRig | None, Intrinsics | None],
    with_depth: bool,
) -> PreparedFrame:
    """Check and prepare a frame's channels.

    shape: the first frame's; None for the first. with_depth: whether to read depth in addition to color.
    ValueError if the size isn't the first frame's or the camera's. UnregisteredDepthError, a ValueError, if
    depth that is read differs from color in size.
    """
    given = as_frame(frame)
    name, image = _picture(given)
    if shape is not None and image.shape[:2] != shape:
        camera = cameras[0] or cameras[1]
        raise validation.changed_size(f"frame.{name}", "size", shape, image.shape[:2], camera)
    return once(given, _prepare, cameras, with_depth)


def _prepare(
    frame: Frame, cameras: tuple[StereoRig | None, Intrinsics | None], with_depth: bool
) -> PreparedFrame:
    """The same without the target, so that the trackers of several targets share it."""
    name, image = _picture(frame)
    size = image.shape[:2]
    if with_depth and frame.depth is not None:
        validation.check_depth_size(frame.depth, size)
    rig, camera = rig_and_camera(*cameras, size, name)
    color = None if frame.color is None else _bgr(frame.color)
    depth_source = _depth_source(frame, color, rig) if with_depth or color is None else None
    return PreparedFrame(size, color, depth_source, camera, frame.timestamp, messages_of(frame))


def _picture(frame: Frame) -> tuple[str, Any]:
    """The name of the channel in whose pixels boxes are given, and its image."""
    return ("depth", frame.depth) if frame.color is None else ("color", frame.color)


@lru_cache(maxsize=8)
def rig_and_camera(
    rig: StereoRig | None, camera: Intrinsics | None, size: tuple[int, int], channel: str = "color"
) -> tuple[StereoRig, Intrinsics]:
    """The stereo rig and its left camera; a default for each that isn't given.

    ValueError if the camera's size isn't that of the named channel.
    """
    known = validation.camera_or_default(rig.intrinsics if rig else camera, size, channel)
    return rig or StereoRig(known, validation.DEFAULT_BASELINE), known


def _depth_source(frame: Frame, color: Image | None, rig: StereoRig) -> DepthSource | None:
    if frame.depth is not None:
        return DepthImageSource(frame.depth)
    if frame.right is not None and color is not None:
        return StereoSource(color, _bgr(frame.right), rig)
    return None


def _bgr(image: Image) -> Image:
    return image if image.ndim == 3 else np.repeat(image[..., None], 3, axis=2)
