# SPDX-License-Identifier: MIT
"""Reads a calibration file in any known format, and checks it against the images' size."""

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
from tricue.camera.text import read_text
from tricue.camera.types import PathLike, Size

TOML, PRINCETON, OPENCV, KITTI = "toml", "princeton", "opencv", "kitti"
KITTI_COLOR_CAMERAS = 2, 3
"""KITTI's numbers of the left and right color camera; the gray ones are 0 and 1."""
T = TypeVar("T", Intrinsics, StereoRig)


def read_intrinsics(
    path: PathLike, size: Size, channel: str, kitti_camera: int = KITTI_COLOR_CAMERAS[0]
) -> Intrinsics:
    """The intrinsics in a calibration file of any known format.

    The formats are OpenCV's (YAML, XML, JSON), ROS's (YAML), KITTI's (.txt), Princeton's (.mat) and TOML.
    size: width and height of the images, pixels. channel: "depth" or "color", the table to read in a TOML
    file with several. kitti_camera: the camera to read in KITTI's file. ValueError or OSError names the file;
    a file for another image size is an error, because every position would be wrong. Warns (UserWarning) of
    distortion, which isn't corrected.
    """
    path = Path(path)
    return _read_for(channel, path, size, _reader(path, channel, kitti_camera))


def read_registration(path: PathLike, depth: Size, color: Size) -> Registration | None:
    """The registration of depth images to the color camera, from a TOML file with both cameras.

    The file has the tables ``depth`` and ``color``. None for any other file, and if both cameras are equal,
    as the images are registered already. Both cameras are assumed to be in one place, whatever their poses; a
    color camera without a pose gets the depth camera's. depth, color: width and height of the images, pixels.
    ValueError as from :func:`read_intrinsics`.
    """
    path = Path(path)
    if _format(path) != TOML or not all(_table(path, name) for name in ("depth", "color")):
        return None
    of_depth, of_color = read_intrinsics(path, depth, "depth"), read_intrinsics(path, color, "color")
    of_color = replace(of_color, pose=of_color.pose or of_depth.pose)
    return None if of_depth == of_color else Registration(of_depth, of_color)


def read_rig(
    path: PathLike,
    size: Size,
    unit: float | None = None,
    kitti_cameras: tuple[int, int] = KITTI_COLOR_CAMERAS,
) -> StereoRig:
    """The rectified rig in a calibration file of any known format.

    The formats are OpenCV's (YAML, XML, JSON; P1, P2), ROS's (YAML) of the right camera, KITTI's (.txt) and
    TOML. size: width and height of the images, pixels. unit: meters per unit of the board of OpenCV's
    calibration, 1 by default. kitti_cameras: the left and right camera to read in KITTI's file. ValueError
    or OSError names the file, as from :func:`read_intrinsics`; ValueError, too, for a unit other than 1 with
    ROS's, and for any unit with KITTI's and TOML, which are in meters.
    """
    path = Path(path)
    kind = _format(path)
    if unit is not None and kind != OPENCV:
        raise ValueError(f"unit: expected with a calibration by OpenCV, got {path}, which is in meters")
    if kind == PRINCETON:
        raise ValueError(f"{path}: expected the calibration of a stereo pair, got one camera's")
    return _read_for("color", path, size, _rig_reader(path, kind, unit, kitti_cameras))


def _read_for(channel: str, path: Path, size: Size, read: Callable[..., T]) -> T:
    """The result of ``read``; the error for another image size says which channel's images differ."""
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
    text = read_text(path)
    if path.suffix.lower() in (".yml", ".yaml", ".xml", ".json") or re.match(r"\s*(%YAML|<\?xml|\{)", text):
        return OPENCV
    if re.search(r"^\s*P(_rect_)?\d+:?\s", text, re.MULTILINE):
        return KITTI
    raise ValueError(
        f"{path}: expected a calibration by OpenCV or ROS (.yml, .xml, .json), KITTI (.txt), "
        "Princeton (.mat) or in .toml"
    )


def _table(path: Path, channel: str) -> str | None:
    """The TOML table named like the channel; None if there is none, so that the only table is read."""
    return channel if isinstance(toml.read(path).get(channel), dict) else None
