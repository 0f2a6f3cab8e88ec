# SPDX-License-Identifier: MIT
"""OAK cameras, live: color, and stereo depth that the camera itself registers to color."""

from datetime import timedelta
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.doctor.install import install_extra

PREFIX = "oak:"
SIZE = 640, 400  # pixels of both images
FPS = 30.0
_WAIT = timedelta(seconds=5)  # for an image
_METERS_PER_UNIT = np.float32(0.001)


class Oak:
    """An OAK camera by its id or address; "" for the first one found."""

    remote = False
    fps = FPS

    def __init__(self, device: str = "") -> None:
        self.device = device
        self.name = f"{PREFIX}{device}"
        self.camera: Intrinsics | None = None
        self._pipeline: Any = None

    def open(self) -> None:
        dai = _library()
        try:
            found = dai.Device(dai.DeviceInfo(self.device)) if self.device else dai.Device()
        except RuntimeError as error:
            raise OSError(f"{self.name}: can't be opened ({error}); is it plugged in?") from None
        try:
            self._start(dai, found)
        except RuntimeError as error:  # such as one without stereo cameras
            raise OSError(f"{self.name}: can't give color and depth ({error})") from None

    def _start(self, dai: Any, device: Any) -> None:
        self._pipeline = dai.Pipeline(device)
        self._gone = dai.MessageQueue.QueueException
        self._queue = _color_and_depth(dai, self._pipeline, device.getPlatform() == dai.Platform.RVC4)
        matrix = np.asarray(device.readCalibration().getCameraIntrinsics(dai.CameraBoardSocket.CAM_A, *SIZE))
        self.camera = Intrinsics(matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2], *SIZE)
        self._pipeline.start()

    def read(self) -> dict[str, NDArray[Any]] | None:
        try:
            group = self._queue.get(_WAIT)
        except (RuntimeError, self._gone):
            group = None
        if group is None:
            return None
        color, depth = (group[name] for name in ("color", "depth"))
        return {"color": color.getCvFrame(), "depth": np.asarray(depth.getFrame()) * _METERS_PER_UNIT}

    def close(self) -> None:
        if self._pipeline is not None:
            self._pipeline.stop()
        self._pipeline = None


def _color_and_depth(dai: Any, pipeline: Any, aligns_apart: bool) -> Any:
    """The queue of simultaneous color and depth images, which keeps only the newest.

    aligns_apart: whether the camera registers depth in a separate node, as OAK 4 does.
    """
    sockets = dai.CameraBoardSocket
    color, left, right = (
        pipeline.create(dai.node.Camera).build(socket)
        for socket in (sockets.CAM_A, sockets.CAM_B, sockets.CAM_C)
    )
    stereo = pipeline.create(dai.node.StereoDepth)
    sync = pipeline.create(dai.node.Sync)
    for camera, side in ((left, stereo.left), (right, stereo.right)):
        camera.requestOutput(SIZE, fps=FPS).link(side)
    image = color.requestOutput(SIZE, fps=FPS, enableUndistortion=True)
    image.link(sync.inputs["color"])
    if aligns_apart:
        align = pipeline.create(dai.node.ImageAlign)
        stereo.depth.link(align.input)
        image.link(align.inputAlignTo)
        align.outputAligned.link(sync.inputs["depth"])
    else:
        image.link(stereo.inputAlignTo)
        stereo.depth.link(sync.inputs["depth"])
    return sync.out.createOutputQueue(maxSize=1, blocking=False)


def _library() -> Any:
    try:
        import depthai
    except ImportError as error:
        raise ImportError(
            f"an OAK camera needs the package depthai: {install_extra('oak')} ({error})"
        ) from None
    return depthai
