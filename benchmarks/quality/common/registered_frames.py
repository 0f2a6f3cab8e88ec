# SPDX-License-Identifier: MIT
"""Recorded frames with color registered to depth."""

from dataclasses import replace

import numpy as np
from tricue.camera.frame import Frame
from tricue.camera.read_calibration import read_intrinsics
from tricue.camera.registration import Extrinsics, color_in_depth
from tricue.camera.rig import Intrinsics
from tricue.evaluation.dataset import OpenedSequence


def color_camera(opened: OpenedSequence) -> Intrinsics | None:
    """The color camera, if both it and the depth camera are calibrated."""
    source = opened.source
    if source.calibration is None or "color" not in source.channels or opened.intrinsics is None:
        return None
    return read_intrinsics(source.calibration, source.channels["color"].size, "color")


def registered(opened: OpenedSequence, camera: Intrinsics | None, shift: float = 0.0) -> list[Frame]:
    """The frames with color registered to depth; without a color camera, with depth alone."""
    depth_camera = opened.intrinsics
    if camera is None or depth_camera is None:
        return [Frame(depth=frame.depth, timestamp=frame.timestamp) for frame in opened.source]
    if opened.registered:
        return list(opened.source)
    extrinsics, frames = Extrinsics(translation=np.array([shift, 0, 0])), []
    for frame in opened.source:
        assert frame.color is not None
        assert frame.depth is not None
        color = color_in_depth(frame.color, frame.depth, depth_camera, camera, extrinsics)
        frames.append(replace(frame, color=color))
    return frames
