# SPDX-License-Identifier: MIT
"""VOT's folders: ``sequence`` lists the channels; CDTB and DepthTrack have only color/ and depth/."""

import re
from collections.abc import Mapping
from pathlib import Path

from tricue.camera.text import lines_of
from tricue.data.depth_images import METERS_PER_MILLIMETER, DepthReader
from tricue.data.files import image_paths, listed_path
from tricue.data.streams import Images, Stream, plausible_fps
from tricue.data.truth import VOT_TRUTH

SEQUENCE_FILE = "sequence"


def read_channels(folder: Path, scale: float | None) -> dict[str, Stream] | None:
    """The folder's channels; None if it isn't VOT's. scale: meters per unit of depth, 0.001 by default."""
    if (folder / SEQUENCE_FILE).is_file():
        return _listed(folder, DepthReader(METERS_PER_MILLIMETER if scale is None else scale))
    if (folder / VOT_TRUTH).is_file() and all(
        _has_numbered_images(folder / channel) for channel in ("color", "depth")
    ):
        reader = DepthReader(METERS_PER_MILLIMETER if scale is None else scale)
        color, depth = (image_paths(folder / channel) for channel in ("color", "depth"))
        return {"color": Images(color), "depth": Images(depth, read=reader)}
    return None


def _listed(folder: Path, reader: DepthReader) -> dict[str, Stream]:
    """The channels that the file lists as patterns, such as color/%08d.jpg."""
    lines = lines_of(folder / SEQUENCE_FILE)
    values = {
        key.strip(): value.strip() for key, found, value in (line.partition("=") for line in lines) if found
    }
    fps, color, depth = _fps(values), _color(values), values.get("channels.depth", "")
    listed: dict[str, Stream] = {}
    if color or not depth:
        listed["color"] = Images(_images(folder, "color", color), fps)
    if depth:
        listed["depth"] = Images(_images(folder, "depth", depth), fps, reader)
    return listed


def _fps(values: Mapping[str, str]) -> float | None:
    try:
        return plausible_fps(float(values.get("fps", "")))
    except ValueError:
        return None


def _color(values: Mapping[str, str]) -> str:
    """The pattern of the channel color, or else of the default channel; "" without both."""
    default = values.get("channel.default")
    return values.get("channels.color") or (
        values.get(f"channels.{default}", "") if default != "depth" else ""
    )


def _images(folder: Path, channel: str, pattern: str) -> list[Path]:
    """The images that match the pattern, sorted by number."""
    place = listed_path(folder, pattern, folder / SEQUENCE_FILE).parent
    around = re.split(r"%\d*d", Path(pattern).name)
    if len(around) != 2 or not _is_folder(place):
        suffix = {"color": "jpg", "depth": "png"}[channel]
        raise ValueError(
            f"{folder / SEQUENCE_FILE}: expected channels.{channel}={channel}/%08d.{suffix}, got {pattern!r}"
        )
    name = re.compile(r"\d+".join(map(re.escape, around)))
    paths = [path for path in image_paths(place) if name.fullmatch(path.name)]
    if not paths:
        raise ValueError(f"{place}: expected the images of the {channel} channel, found none")
    return paths


def _is_folder(path: Path) -> bool:
    """Whether there is such a folder; False for an invalid file name, too."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def _has_numbered_images(folder: Path) -> bool:
    """Whether all names are eight digits, such as 00000001.jpg, as VOT's are."""
    paths = image_paths(folder) if folder.is_dir() else []
    return bool(paths) and all(re.fullmatch(r"\d{8}", path.stem) for path in paths)
