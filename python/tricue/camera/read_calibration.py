# SPDX-License-Identifier: MIT
"""Reads a calibration file of any known format, and checks it against the size of the images it is for."""

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

from tricue.camera import toml
from tricue.camera.calibration_formats import read_princeton_camera
from tricue.camera.registration import Registration
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.types import Size

TOML, PRINCETON, OPENCV, KITTI = "toml", "princeton", "opencv", "kitti"


def read_intrinsics(path: Path, size: Size, channel: str) -> Intrinsics:
    """The intrinsics in a file by OpenCV (YAML, XML, JSON), by KITTI (.txt), in TOML, or in Princeton's .mat.

    size: width and height of the images, pixels. channel: "depth" or "color", which table to take of a TOML
    file with several. ValueError or OSError names the file, also where it holds another image size: then
    every position would be wrong.
    """
    read = _reader(path, channel)
    found = read(size=size)  # many files don't hold the size
    try:
        own = read()
    except ValueError:
        return found
    if (own.width, own.height) != size:
        raise ValueError(
            f"{path}: expected a calibration for the {channel} images of {size[0]}x{size[1]} pixels, "
            f"got one for {own.width}x{own.height}"
        )
    return own


def read_registration(path: Path, depth: Size, color: Size) -> Registration | None:
    """What brings depth images into the color camera's pixels, from a TOML file with both cameras.

    The file has the tables ``depth`` and ``color``. None for any other file, and where both cameras are the
    same, for then the images are registered already. depth, color: width and height of the images, pixels.
    ValueError as :func:`read_intrinsics`.
    """
    if _format(path) != TOML or not all(_table(path, name) for name in ("depth", "color")):
        return None
    found = Registration(read_intrinsics(path, depth, "depth"), read_intrinsics(path, color, "color"))
    return None if found.depth == found.color else found


def read_rig(path: Path, size: Size, unit: float | None = None) -> StereoRig:
    """The rectified rig in a file by OpenCV (YAML, XML, JSON) with P1 and P2, by KITTI (.txt), or in TOML.

    size: width and height of the images, pixels. unit: meters per unit of the board of OpenCV's calibration,
    1 by default. ValueError or OSError names the file, as :func:`read_intrinsics` does; ValueError also for a
    unit with the other formats, which are in meters.
    """
    kind = _format(path)
    if unit is not None and kind != OPENCV:
        raise ValueError(f"--unit: expected with a calibration by OpenCV, got {path}, which is in meters")
    if kind == PRINCETON:
        raise ValueError(f"{path}: expected the calibration of a stereo pair, got one camera's")
    read_intrinsics(path, size, "color")  # refuses a calibration for images of another size
    if kind == OPENCV:
        return StereoRig.from_opencv(path, unit=1.0 if unit is None else unit, size=size)
    if kind == KITTI:
        return StereoRig.from_kitti(path, size=size)
    return StereoRig.from_toml(path, table=_table(path, "color"), size=size)


def _reader(path: Path, channel: str) -> Callable[..., Intrinsics]:
    kind = _format(path)
    if kind == TOML:
        return partial(Intrinsics.from_toml, path, table=_table(path, channel))
    readers = {PRINCETON: _read_princeton, OPENCV: Intrinsics.from_opencv, KITTI: Intrinsics.from_kitti}
    return partial(readers[kind], path)


def _read_princeton(path: Path, *, size: Size | None = None) -> Intrinsics:
    return Intrinsics(*read_princeton_camera(path, size=size))


def _format(path: Path) -> str:
    if path.suffix.lower() == ".toml":
        return TOML
    if path.suffix.lower() == ".mat":
        return PRINCETON
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix.lower() in (".yml", ".yaml", ".xml", ".json") or re.match(r"\s*(%YAML|<\?xml|\{)", text):
        return OPENCV
    if re.search(r"^P(_rect_)?\d+:? ", text, re.MULTILINE):
        return KITTI
    raise ValueError(
        f"{path}: expected a calibration by OpenCV (.yml, .xml, .json), KITTI (.txt), Princeton (.mat) "
        "or in .toml"
    )


def _table(path: Path, channel: str) -> str | None:
    """The TOML table named like the channel; None where there is none, so that the only table is taken."""
    return channel if isinstance(toml.read(path).get(channel), dict) else None
