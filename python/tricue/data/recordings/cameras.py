# SPDX-License-Identifier: MIT
"""Cameras of a recording: intrinsics from camera_info, extrinsics from transforms, and what they allow."""

from collections import deque
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.calibration_formats import skew_note
from tricue.camera.rectification import (
    DISTORTION_COUNTS,
    Rectification,
    RectifyingTransforms,
    StereoCalibration,
    is_rotation,
)
from tricue.camera.registration import Extrinsics, Registration, Reprojection
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.recordings.messages import CameraMessage, Transform
from tricue.data.recordings.topics import stem
from tricue.data.source import Rectify, Register

MAX_SAME_PLACE = 1e-3  # meters between two cameras that count as one
MAX_SAME_CAMERA = 0.5  # pixels between the intrinsics of two cameras that count as one
MAX_SAME_RECTIFIED = 1e-3  # pixels between those of a rectified pair, as in a calibration file


class View(NamedTuple):
    """A channel's camera. frame: its coordinate frame. rectified: whether its topic's name says so."""

    topic: str
    size: tuple[int, int]
    frame: str
    info: CameraMessage | None
    rectified: bool = False


class Cameras(NamedTuple):
    """What is known of the cameras, with the fields of :class:`tricue.data.source.Source`, and notes."""

    camera: Intrinsics | StereoRig | None = None
    register: Register | None = None
    rectify: Rectify | None = None
    notes: tuple[str, ...] = ()


def find_info(image: str, frame: str, infos: Mapping[str, CameraMessage]) -> CameraMessage | None:
    """The camera_info of an image's topic: the one beside it, else the only one with its coordinate frame."""
    own = stem(image)
    folder = own.rsplit("/", 1)[0]
    for place in (f"{own}/camera_info", f"{own}/info/camera_info", f"{folder}/camera_info"):
        if place in infos:
            return infos[place]
    beside = [info for name, info in infos.items() if name.rsplit("/", 1)[0] in (own, folder)]
    of_frame = [info for info in infos.values() if frame and info.frame == frame]
    return next((each[0] for each in (beside, of_frame) if len(each) == 1), None)


def find_extrinsics(transforms: Sequence[Transform], start: str, end: str) -> Extrinsics | None:
    """x_end = rotation @ x_start + translation between two coordinate frames; None if nothing connects them.

    A transform with a quaternion of 0, as in a message that wasn't filled in, is ignored.
    """
    steps: dict[str, list[tuple[str, NDArray[Any]]]] = {}
    for each in transforms:
        matrix = _matrix(each)
        if not np.isfinite(matrix).all():
            continue
        steps.setdefault(each.child, []).append((each.parent, matrix))
        steps.setdefault(each.parent, []).append((each.child, np.linalg.inv(matrix)))
    reached: dict[str, NDArray[Any]] = {start: np.eye(4)}
    waiting = deque([start])
    while waiting and end not in reached:
        here = waiting.popleft()
        for there, matrix in steps.get(here, ()):
            if there not in reached:
                reached[there] = matrix @ reached[here]
                waiting.append(there)
    if end not in reached or not (start and end):
        return None
    matrix = reached[end].astype(np.float64)
    return Extrinsics(matrix[:3, :3], matrix[:3, 3])


def calibrate(views: Mapping[str, View], transforms: Sequence[Transform]) -> Cameras:
    """The cameras of color, depth and right images."""
    if "depth" in views and "color" in views:
        return _color_and_depth(views["color"], views["depth"], transforms)
    if "right" in views:
        return _stereo(views["color"], views["right"], transforms)
    view = next(iter(views.values()))
    camera, notes = _intrinsics(view)
    return Cameras(camera, notes=notes)


def _intrinsics(view: View) -> tuple[Intrinsics | None, tuple[str, ...]]:
    """A camera's intrinsics; None, with a note, if they aren't known."""
    info, (width, height) = view.info, view.size
    if info is None:
        return None, (f"{view.topic} has no camera_info",)
    if not _is_calibrated(info):
        return None, (f"the camera of {view.topic} isn't calibrated, says its camera_info",)
    if (info.width, info.height) != view.size:
        said = f"{info.width}x{info.height}"
        return None, (f"{view.topic} has images of {width}x{height}, its camera_info is for {said}",)
    if view.rectified and _has_projection(info):
        matrix = np.reshape(info.p, (3, 4))
    else:
        matrix = np.reshape(info.k, (3, 3))
    bent = not view.rectified and np.abs(info.d).max(initial=0) > 0
    found = "its lens' distortion isn't taken out" if bent else "", skew_note(matrix, height)
    notes = tuple(f"{view.topic}: {note}" for note in found if note)
    return Intrinsics(matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2], width, height), notes


def _is_calibrated(info: CameraMessage) -> bool:
    """Whether K is valid; in an uncalibrated camera it is 0, NaN or missing."""
    return len(info.k) == 9 and bool(np.isfinite(info.k).all()) and min(info.k[0], info.k[4]) > 0


def _has_projection(info: CameraMessage) -> bool:
    """Whether P is valid; where nobody rectifies the images, it is 0, NaN or missing."""
    return len(info.p) == 12 and bool(np.isfinite(info.p).all()) and min(info.p[0], info.p[5]) > 0


def _color_and_depth(color: View, depth: View, transforms: Sequence[Transform]) -> Cameras:
    """Depth is registered to color, unless both have the same camera."""
    (color_camera, color_notes), (depth_camera, depth_notes) = _intrinsics(color), _intrinsics(depth)
    notes = (*color_notes, *depth_notes)
    if color_camera is None or depth_camera is None:
        same = color.size == depth.size
        taken = "is taken to be" if same else "can't be"
        notes += (f"depth {taken} registered to color, as not both cameras are known",)
        return Cameras(depth_camera or (color_camera if same else None), notes=notes)
    between = find_extrinsics(transforms, depth.frame, color.frame)
    same = _is_same(color_camera, depth_camera) or _have_same_info(color, depth)
    if same and (between is None or _is_none(between)):
        return Cameras(color_camera, notes=notes)
    if between is None:
        notes += ("depth registered to color as from one place, for no transform says where the cameras are",)
        return Cameras(color_camera, Registration(depth_camera, color_camera), notes=notes)
    distance = float(np.linalg.norm(between.translation))
    notes += (f"depth registered to color, whose camera is {1000 * distance:.1f} mm beside it",)
    return Cameras(color_camera, Reprojection(depth_camera, color_camera, between), notes=notes)


def _stereo(left: View, right: View, transforms: Sequence[Transform]) -> Cameras:
    """The rig of a stereo pair, and the rectification if its images are raw."""
    camera, notes = _intrinsics(left)
    first, second = left.info, right.info
    if camera is None or first is None or second is None or not _is_calibrated(second):
        return Cameras(notes=notes or (f"{right.topic} has no camera_info of a calibrated camera",))
    other, other_notes = _intrinsics(right)
    if other is None:
        return Cameras(camera, notes=(*notes, *other_notes))
    baseline = _place(second) - _place(first)
    if baseline and not left.rectified and _is_raw(first, second):
        try:
            rectification = _rectification(first, second, left.size)
        except ValueError as error:
            return Cameras(camera, notes=(*notes, f"the pair can't be rectified: {error}"))
        return Cameras(rectification.rig, rectify=rectification, notes=("the raw pair is rectified",))
    if not _is_same(camera, other, MAX_SAME_RECTIFIED):
        return Cameras(camera, notes=(*notes, _note_two_cameras(camera, other)))
    between = None if baseline else find_extrinsics(transforms, left.frame, right.frame)
    if between is not None:
        baseline = -float(between.translation[0])
    if not baseline:
        return Cameras(camera, notes=(*notes, "the baseline isn't known: no P of the right camera has it"))
    if baseline < 0:
        swapped = {"color": right.topic, "right": left.topic}
        note = f"the right camera is left of the left one; swap the two cameras: topics={swapped}"
        return Cameras(camera, notes=(*notes, note))
    return Cameras(StereoRig(camera, baseline), notes=notes)


def _place(info: CameraMessage) -> float:
    """The position of a camera in a rectified pair, from its P: meters to the right of the pair's origin."""
    return -info.p[3] / info.p[0] if _has_projection(info) else 0.0


def _rectification(left: CameraMessage, right: CameraMessage, size: tuple[int, int]) -> Rectification:
    for info in (left, right):
        if info.model not in ("plumb_bob", "rational_polynomial", ""):
            raise ValueError(f"the distortion model {info.model} isn't known")
        if len(info.d) not in (0, *DISTORTION_COUNTS) or not np.isfinite(info.d).all():
            raise ValueError(f"D isn't one of {info.model or 'plumb_bob'}")
        if len(info.r) != 9 or not is_rotation(np.reshape(info.r, (3, 3))):
            raise ValueError("R isn't a rotation")
        if not _has_projection(info):
            raise ValueError("P isn't known")
    cameras, rotations = (
        [np.reshape(each, (3, 3)) for each in pair] for pair in _both(left, right, "k", "r")
    )
    raw = StereoCalibration(
        (cameras[0], cameras[1]), (np.array(left.d), np.array(right.d)), np.eye(3), np.zeros(3)
    )
    projections = np.reshape(left.p, (3, 4)), np.reshape(right.p, (3, 4))
    return Rectification(raw, size, rectified=RectifyingTransforms((rotations[0], rotations[1]), projections))


def _both(left: CameraMessage, right: CameraMessage, *names: str) -> list[list[tuple[float, ...]]]:
    return [[getattr(info, name) for info in (left, right)] for name in names]


def _is_raw(*infos: CameraMessage) -> bool:
    """Whether a lens distorts, or a camera must be rotated to rectify the pair."""
    turned = any(
        info.r and any(info.r) and not np.allclose(np.reshape(info.r, (3, 3)), np.eye(3)) for info in infos
    )
    return turned or any(np.abs(info.d).max(initial=0) > 0 for info in infos)


def _is_same(first: Intrinsics, second: Intrinsics, tolerance: float = MAX_SAME_CAMERA) -> bool:
    if (first.width, first.height) != (second.width, second.height):
        return False
    return bool(np.abs(first.matrix - second.matrix).max() <= tolerance)


def _have_same_info(color: View, depth: View) -> bool:
    """Whether depth has the same camera_info as color. Drivers publish this for depth aligned to color: both
    then have the same pixels, whether color uses K or P.
    """
    first, second = color.info, depth.info
    if first is None or second is None or color.size != depth.size:
        return False
    return (first.k, first.p) == (second.k, second.p)


def _note_two_cameras(left: Intrinsics, right: Intrinsics) -> str:
    """A note on what to do about a pair whose images were rectified to different intrinsics."""
    names = [name for name in ("fx", "fy", "cx", "cy") if getattr(left, name) != getattr(right, name)]
    differ = ", ".join(f"{name} {getattr(left, name):.6g} and {getattr(right, name):.6g}" for name in names)
    return (
        f"the two cameras of the rectified pair differ ({differ}), which would make wrong meters; rectify "
        "with cv2.CALIB_ZERO_DISPARITY, or rectify the raw images by "
        "tricue.camera.rectification.Rectification"
    )


def _is_none(between: Extrinsics) -> bool:
    """Whether two coordinate frames are the same."""
    near = np.linalg.norm(between.translation) <= MAX_SAME_PLACE
    return bool(near and np.allclose(between.rotation, np.eye(3), atol=1e-3))


def _matrix(transform: Transform) -> NDArray[np.float64]:
    """(4, 4), child to parent; NaN for a quaternion of 0."""
    x, y, z, w = np.divide(transform.rotation, np.linalg.norm(transform.rotation) or np.nan)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = transform.translation
    return matrix
