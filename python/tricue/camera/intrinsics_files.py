# SPDX-License-Identifier: MIT
"""The intrinsics in a calibration file of any known format, for images of a certain size."""

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

from tricue import toml
from tricue.camera.calibration import princeton_intrinsics
from tricue.camera.rig import Intrinsics, Size

Reader = Callable[..., Intrinsics]


def read_intrinsics(path: Path, size: Size, channel: str) -> Intrinsics:
    """The intrinsics of a file by OpenCV (YAML, XML, JSON), by KITTI (.txt), in TOML, or in Princeton's .mat.

    size: width and height of the images, pixels. channel: the table of a TOML file with several, "depth" or
    "color". ValueError or OSError names the file: also where it says that it is for images of another size,
    for then every position would be wrong.
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


def _reader(path: Path, channel: str) -> Reader:
    if path.suffix.lower() == ".toml":
        return partial(Intrinsics.from_toml, path, table=_table(path, channel))
    if path.suffix.lower() == ".mat":
        return partial(princeton_intrinsics, path)
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix.lower() in (".yml", ".yaml", ".xml", ".json") or re.match(r"\s*(%YAML|<\?xml|\{)", text):
        return partial(Intrinsics.from_opencv, path)
    if re.search(r"^P(_rect_)?\d+:? ", text, re.MULTILINE):
        return partial(Intrinsics.from_kitti, path)
    raise ValueError(
        f"{path}: expected a calibration by OpenCV (.yml, .xml, .json), KITTI (.txt), Princeton (.mat) "
        "or in .toml"
    )


def _table(path: Path, channel: str) -> str | None:
    """The channel's table where there is one; else the reader takes the only one."""
    return channel if isinstance(toml.read(path).get(channel), dict) else None
