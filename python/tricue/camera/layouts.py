# SPDX-License-Identifier: MIT
"""How sequence folders are laid out: VOT's, TUM's, Princeton's, OTB's, images alone."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.depth_images import MILLIMETRES, DepthReader, is_depth, known_scale
from tricue.camera.streams import DEFAULT_FPS, Images, Read, Stream, Video, image_paths, read_color
from tricue.camera.truth import find_ptb_truth, find_truth

TUM_SCALE = 1 / 5000  # metres per unit; the format's definition, as the next
TUM_APART = 0.02  # seconds, within which a color and a depth image belong together
PTB_TICK = 1e-6  # seconds per unit of the times in the names of the Princeton benchmark's files
_COLOR_FOLDERS = ("img", "color", "left", "rgb")  # OTB, VOT, stereo pairs, RGB-D recordings
_VIDEOS = {".avi", ".m4v", ".mkv", ".mov", ".mp4", ".mpeg", ".mpg", ".ogv", ".webm", ".wmv"}

Timed = list[tuple[float, Path]]


class Layout(NamedTuple):
    """What a folder holds: a stream a channel, true boxes, and what its user should know."""

    channels: dict[str, Stream]
    truth: NDArray[np.float64] | None = None
    notes: tuple[str, ...] = ()


def read_layout(folder: Path, scale: float | None) -> Layout:
    """The folder's channels.

    scale: metres per unit of depth, where the format doesn't say it or the files don't keep to it.
    ValueError names the folder or the file in it, and what was expected.
    """
    if (folder / "sequence").is_file():
        return _vot(folder, scale)
    if (folder / "depth.txt").is_file() or (folder / "rgb.txt").is_file():
        return _tum(folder, scale)
    color, depth = (_ptb_images(folder / channel) for channel in ("rgb", "depth"))
    if color and depth:
        return _ptb(folder, color, depth, scale)
    return _plain(folder, scale)


def _vot(folder: Path, scale: float | None) -> Layout:
    """VOT's channels: patterns such as color/%08d.jpg, counted from 1; depth in millimetres."""
    lines = (folder / "sequence").read_text(encoding="utf-8", errors="replace").splitlines()
    values = {
        key.strip(): value.strip() for key, found, value in (line.partition("=") for line in lines) if found
    }
    fps, color, depth = _vot_fps(values), _vot_color(values), values.get("channels.depth", "")
    channels: dict[str, Stream] = {}
    if color or not depth:
        channels["color"] = Images(_vot_images(folder, "color", color), fps)
    if depth:
        reader = DepthReader(MILLIMETRES if scale is None else scale)
        channels["depth"] = Images(_vot_images(folder, "depth", depth), fps, reader)
    return Layout(channels, find_truth(folder))


def _vot_fps(values: Mapping[str, str]) -> float:
    try:
        fps = float(values.get("fps", ""))
    except ValueError:
        return DEFAULT_FPS
    return fps if 0 < fps <= 1000 else DEFAULT_FPS


def _vot_color(values: Mapping[str, str]) -> str:
    """The pattern of the color channel, which may have another name if it is the default; "" without one."""
    default = values.get("channel.default")
    return values.get("channels.color") or (
        values.get(f"channels.{default}", "") if default != "depth" else ""
    )


def _vot_images(folder: Path, channel: str, pattern: str) -> list[Path]:
    place = (folder / pattern).parent
    if "%" not in pattern or not place.is_dir():
        suffix = {"color": "jpg", "depth": "png"}[channel]
        raise ValueError(
            f"{folder / 'sequence'}: expected channels.{channel}={channel}/%08d.{suffix}, got {pattern!r}"
        )
    paths = image_paths(place)
    if not paths:
        raise ValueError(f"{place}: expected the images of the {channel} channel, found none")
    return paths


def _tum(folder: Path, scale: float | None) -> Layout:
    """TUM's RGB-D lists of times and files. Its groundtruth.txt is the camera's path: it has no boxes."""
    listed = {name: _tum_list(folder / f"{name}.txt") for name in ("rgb", "depth")}
    color, depth = listed["rgb"], listed["depth"]
    reader = DepthReader(TUM_SCALE if scale is None else scale)
    if not (color and depth):
        name, images = ("color", color) if color else ("depth", depth)
        return Layout({name: _timed(images, reader) if depth else _timed(images)})
    pairs = _closest_pairs([time for time, _ in color], [time for time, _ in depth], TUM_APART)
    if not pairs:
        raise ValueError(
            f"{folder}: expected color and depth images within {TUM_APART} s of each other, found none"
        )
    channels: dict[str, Stream] = {
        "color": _timed([color[i] for i, _ in pairs]),
        "depth": _timed([depth[j] for _, j in pairs], reader),
    }
    alone = len(color) - len(pairs)
    note = f"left out {alone} of {len(color)} color images, with no depth image within {TUM_APART} s"
    return Layout(channels, notes=(note,) if alone else ())


def _tum_list(path: Path) -> Timed:
    """The times and images of a list, in the order of time; empty where there is no such file."""
    if not path.is_file():
        return []
    lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    images = [
        _tum_line(line, path, number)
        for number, line in enumerate(lines, 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not images:
        raise ValueError(f"{path}: expected a line of timestamp and file name an image, found none")
    return sorted(images)


def _tum_line(line: str, path: Path, number: int) -> tuple[float, Path]:
    time, *name = line.split(maxsplit=1)
    try:
        seconds = float(time)
    except ValueError:
        seconds = np.nan
    if not (name and np.isfinite(seconds)):
        raise ValueError(f"{path}, line {number}: expected a timestamp and a file name, got {line!r:.60}")
    return seconds, path.parent / name[0].strip()


def _closest_pairs(first: Sequence[float], second: Sequence[float], apart: float) -> list[tuple[int, int]]:
    """Indices of times that belong together, each once, the closest first served; both are sorted."""
    times = np.array(second)
    low = np.searchsorted(times, np.subtract(first, apart), "left").tolist()
    high = np.searchsorted(times, np.add(first, apart), "right").tolist()
    close = sorted(
        (abs(first[i] - second[j]), i, j) for i in range(len(first)) for j in range(low[i], high[i])
    )
    pairs: dict[int, int] = {}
    taken: set[int] = set()
    for _, i, j in close:
        if i not in pairs and j not in taken:
            pairs[i] = j
            taken.add(j)
    return sorted(pairs.items())


def _ptb_images(folder: Path) -> Timed:
    """Princeton's files r-<time>-<frame>.png or d-<time>-<frame>.png, in the order of the frames."""
    if not folder.is_dir():
        return []
    names = ((re.fullmatch(r"[rd]-(\d+)-(\d+)\.png", path.name), path) for path in folder.iterdir())
    found = sorted((int(name[2]), int(name[1]) * PTB_TICK, path) for name, path in names if name)
    return [(time, path) for _, time, path in found]


def _ptb(folder: Path, color: Timed, depth: Timed, scale: float | None) -> Layout:
    """Each color image, for which a true box stands, with the depth image that is nearest in time."""
    times = np.array([time for time, _ in depth])
    nearest = [depth[int(np.argmin(np.abs(times - time)))] for time, _ in color]
    reader = DepthReader(MILLIMETRES if scale is None else scale, rotated=True)
    channels: dict[str, Stream] = {"color": _timed(color), "depth": _timed(nearest, reader)}
    return Layout(channels, find_ptb_truth(folder))


def _timed(images: Timed, read: Read = read_color) -> Images:
    times = [time for time, _ in images]
    step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    fps = 1 / step if step > 0.001 else DEFAULT_FPS
    return Images([path for _, path in images], fps, read, times)


def _plain(folder: Path, scale: float | None) -> Layout:
    """Images in a folder of a usual name or in the folder itself, or one video; depth in depth/."""
    places = [folder / sub for sub in _COLOR_FOLDERS if (folder / sub).is_dir()]
    images = next((paths for place in (*places, folder) if (paths := image_paths(place))), [])
    if images and is_depth(images[0]):
        return Layout({"depth": _depth_images(images, scale)}, find_truth(folder))
    depth = image_paths(folder / "depth") if (folder / "depth").is_dir() else []
    channels: dict[str, Stream] = {}
    if images:
        channels["color"] = Images(images)
    elif video := _video(folder, optional=bool(depth)):
        channels["color"] = video
    if depth and channels and scale is None:
        note = f"left out {folder / 'depth'}: --depth-scale gives its metres per unit, 0.001 for millimetres"
        return Layout(channels, find_truth(folder), (note,))
    if depth:
        channels["depth"] = _depth_images(depth, scale)
    return Layout(channels, find_truth(folder))


def _depth_images(paths: Sequence[Path], scale: float | None) -> Images:
    return Images(paths, read=DepthReader(known_scale(paths[0].parent, scale)))


def _video(folder: Path, optional: bool) -> Video | None:
    videos = [path for path in sorted(folder.iterdir()) if path.suffix.lower() in _VIDEOS]
    if len(videos) == 1:
        return Video(videos[0])
    if optional and not videos:
        return None
    found = f"{len(videos)} videos; name one of them" if videos else "neither images nor a video"
    raise ValueError(f"{folder}: expected a folder of images or a sequence, found {found}")
