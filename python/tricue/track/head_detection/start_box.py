# SPDX-License-Identifier: MIT
"""The box to start on if none is given: a head in a stereo pair or in depth, or a face in a single image."""

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.errors import TargetNotFoundError
from tricue.kernels import Kernels
from tricue.track.base.validation import camera_or_default, rig_or_default
from tricue.track.head_detection.face_detection import find_face
from tricue.track.head_detection.find_head import find_head_in_depth, find_head_in_pair


def find_head_or_face(
    k: Kernels, frame: Frame, rig: StereoRig | None = None, camera: Intrinsics | None = None
) -> Box | None:
    """The head that stands out most in a stereo pair or in depth, or else the largest frontal face.

    frame: with ``color``. rig, camera: of the pair, and of the depth; by default default ones.
    """
    assert frame.color is not None
    if frame.right is not None:
        baseline = rig_or_default(rig, frame.color.shape).baseline
        return find_head_in_pair(k, frame.color, frame.right, baseline)
    if frame.depth is None:
        return find_face(frame.color)
    focal_length = camera_or_default(camera, frame.depth.shape).fx
    head = find_head_in_depth(k, frame.color, frame.depth, focal_length)
    return find_face(frame.color) if head is None else head


def head_or_face_to_start_on(k: Kernels, frame: Frame) -> Box:
    """The same, for trackers that got no box; TargetNotFoundError if there is none."""
    found = find_head_or_face(k, frame)
    if found is None:
        what = "face" if frame.depth is None else "head and no face"
        what = what if frame.right is None else "head on shoulders"
        raise TargetNotFoundError(
            f"box: expected (x, y, width, height), as no {what} was found in this frame"
        )
    return found
