# SPDX-License-Identifier: MIT
"""RealSense cameras, live: color, and depth registered to it by the camera's own library."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.doctor.install import install_extra

PREFIX = "realsense:"
_WAIT = 5000  # milliseconds, for an image


class RealSense:
    """A RealSense camera by its serial number; "" for the first one found.

    context: a pyrealsense2 context, for cameras that pyrealsense2 doesn't find by itself.
    """

    remote = False

    def __init__(self, serial: str = "", context: Any = None) -> None:
        self.serial, self.context = serial, context
        self.name = f"{PREFIX}{serial}"
        self.fps: float | None = None
        self.camera: Intrinsics | None = None
        self._pipeline: Any = None

    def open(self) -> None:
        rs = _library()
        pipeline = rs.pipeline(self.context) if self.context else rs.pipeline()
        config = rs.config()
        if self.serial:
            config.enable_device(self.serial)
        config.enable_stream(rs.stream.depth)
        config.enable_stream(rs.stream.color)
        try:
            profile = pipeline.start(config)
        except RuntimeError as error:
            raise OSError(f"{self.name}: can't be opened ({error}); is it plugged in, by USB 3?") from None
        self._pipeline, self._align = pipeline, rs.align(rs.stream.color)
        color = profile.get_stream(rs.stream.color).as_video_stream_profile()
        self._rgb = color.format() == rs.format.rgb8
        if not self._rgb and color.format() != rs.format.bgr8:
            raise OSError(f"{self.name}: expected color in rgb8 or bgr8, got {color.format()}")
        lens = color.get_intrinsics()
        self.fps = float(color.fps())
        self.camera = Intrinsics(lens.fx, lens.fy, lens.ppx, lens.ppy, lens.width, lens.height)

    def read(self) -> dict[str, NDArray[Any]] | None:
        try:
            frames = self._align.process(self._pipeline.wait_for_frames(_WAIT))
        except RuntimeError:  # no image came in time
            return None
        color, depth = frames.get_color_frame(), frames.get_depth_frame()
        if not color or not depth:
            return None
        meters = np.asanyarray(depth.get_data()) * np.float32(depth.get_units())
        image = np.asanyarray(color.get_data())
        return {"color": image[..., ::-1] if self._rgb else image.copy(), "depth": meters}

    def close(self) -> None:
        if self._pipeline is not None:
            self._pipeline.stop()
        self._pipeline = None


def _library() -> Any:
    try:
        import pyrealsense2
    except ImportError as error:
        raise ImportError(
            f"a RealSense camera needs the package pyrealsense2: {install_extra('realsense')} ({error})"
        ) from None
    return pyrealsense2
