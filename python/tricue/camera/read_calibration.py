# SPDX-License-Identifier: MIT
"""Reads a calibration file of any known format, and checks it against the size of the images it is for."""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TypeVar

from tricue.camera import toml
from tricue.camera.calibration_formats import ImageSizeError, other_size, read_princeton_camera
from tricue.camera.registration import Registration
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.types import Size

TOML, PRINCETON, OPENCV, KITTI = "toml", "princeton", "opencv", "kitti"
KITTI_COLOR_CAMERAS = 2, 3
"""Their numbers, left and right; the gray ones are 0 and 1."""
T = TypeVar("T", Intrinsics, StereoRig)


def read_intrinsics(
    path: Path, size: Size, channel: str, kitti_camera: int = KITTI_COLOR_CAMERAS[0]
) -> Intrinsics:
    """The intrinsics in a file by OpenCV (YAML, XML, JSON), ROS (YAML) or KITTI (.txt), in TOML, or in
    Princeton's .mat.

    size: width and height of the images, pixels. channel: "depth" or "color", which table to take of a TOML
    file with several. kitti_camera: which one to take of KITTI's. ValueError or OSError names the file, also
    where it holds another image size: then every position would be wrong. Warns (UserWarning) of distortion,
    which isn't taken out.
    """
    return _read_for(channel, path, size, _reader(path, channel, kitti_camera))


def read_registration(path: Path, depth: Size, color: Size) -> Registration | None:
    """What brings depth images into the color camera's pixels, from a TOML file with both cameras.

    The file has the tables ``depth`` and ``color``. None for any other file, and where both cameras are the
    same, for then the images are registered already. Their poses don't change that both are taken to be in
    one place, which the only pose is of. depth, color: width and height of the images, pixels. ValueError as
    :func:`read_intrinsics`.
    """
    if _format(path) != TOML or not all(_table(path, name) for name in ("depth", "color")):
        return None
    of_depth, of_color = read_intrinsics(path, depth, "depth"), read_intrinsics(path, color, "color")
    of_color = replace(of_color, pose=of_color.pose or of_depth.pose)
    return None if of_depth == of_color else Registration(of_depth, of_color)


def read_rig(
    path: Path,
    size: Size,
    unit: float | None = None,
    kitti_cameras: tuple[int, int] = KITTI_COLOR_CAMERAS,
) -> StereoRig:
    """The rectified rig in a file by OpenCV (YAML, XML, JSON) with P1 and P2, of ROS's right camera (YAML),
    by KITTI (.txt), or in TOML.

    size: width and height of the images, pixels. unit: meters per unit of the board of OpenCV's calibration,
    1 by default. kitti_cameras: which ones to take of KITTI's, left and right. ValueError or OSError names
    the file, as :func:`read_intrinsics` does; ValueError also for a
    unit with the other formats, which are in meters.
    """
    kind = _format(path)
    if unit is not None and kind != OPENCV:
        raise ValueError(f"--unit: expected with a calibration by OpenCV, got {path}, which is in meters")
    if kind == PRINCETON:
        raise ValueError(f"{path}: expected the calibration of a stereo pair, got one camera's")
    return _read_for("color", path, size, _rig_reader(path, kind, unit, kitti_cameras))


def _read_for(channel: str, path: Path, size: Size, read: Callable[..., T]) -> T:
    """What ``read`` finds; the error about another size says whose images these are."""
    try:
        return read(size=size)
    except ImageSizeError as error:
        raise other_size(error.own, size, path, f"the {channel} images") from None


def _rig_reader(
    path: Path, kind: str, unit: float | None, kitti_cameras: tuple[int, int]
) -> Callable[..., StereoRig]:
    if kind == OPENCV:
        return partial(StereoRig.from_opencv, path, unit=1.0 if unit is None else unit)
    if kind == KITTI:
        return partial(StereoRig.from_kitti, path, cameras=kitti_cameras)
    return partial(StereoRig.from_toml, path, table=_table(path, "color"))


def _reader(path: Path, channel: str, kitti_camera: int) -> Callable[..., Intrinsics]:
    kind = _format(path)
    if kind == TOML:
        return partial(Intrinsics.from_toml, path, table=_table(path, channel))
    if kind == KITTI:
        return partial(Intrinsics.from_kitti, path, camera=kitti_camera)
    return partial(_read_princeton if kind == PRINCETON else Intrinsics.from_opencv, path)


def _read_princeton(path: Path, *, size: Size | None = None) -> Intrinsics:
    return Intrinsics(*read_princeton_camera(path, size=size))


def _format(path: Path) -> str:
    if path.suffix.lower() == ".toml":
        return TOML
    if path.suffix.lower() == ".mat":
        return PRINCETON
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    if path.suffix.lower() in (".yml", ".yaml", ".xml", ".json") or re.match(r"\s*(%YAML|<\?xml|\{)", text):
        return OPENCV
    if re.search(r"^\s*P(_rect_)?\d+:?\s", text, re.MULTILINE):
        return KITTI
    raise ValueError(
        f"{path}: expected a calibration by OpenCV or ROS (.yml, .xml, .json), KITTI (.txt), "
        "Princeton (.mat) or in .toml"
    )


def _table(path: Path, channel: str) -> str | None:
    """The TOML table named like the channel; None where there is none, so that the only table is taken."""
    return channel if isinstance(toml.read(path).get(channel), dict) else None
