# SPDX-License-Identifier: MIT
"""How sequence folders are laid out: VOT's, TUM's, Princeton's, KITTI's, OTB's, images alone."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera import kitti, princeton
from tricue.camera.depth_images import MILLIMETRES, DepthReader, is_depth, known_scale
from tricue.camera.streams import Images, Stream, Timed, Video, image_paths, sane_rate, timed_images
from tricue.camera.truth import VOT, find_ptb_truth, find_truth

TUM_SCALE = 1 / 5000  # metres per unit; the format's definition, as the next
TUM_APART = 0.02  # seconds, within which a color and a depth image belong together
_COLOR_FOLDERS = ("img", "color", "left", "rgb")  # OTB, VOT, stereo pairs, RGB-D recordings
_VIDEOS = {".avi", ".m4v", ".mkv", ".mov", ".mp4", ".mpeg", ".mpg", ".ogv", ".webm", ".wmv"}


class Layout(NamedTuple):
    """What a folder holds: a stream a channel, true boxes, and what its user should know."""

    channels: dict[str, Stream]
    truth: NDArray[np.float64] | None = None
    notes: tuple[str, ...] = ()
    calibration: Path | None = None


def read_layout(folder: Path, scale: float | None) -> Layout:
    """The folder's channels.

    scale: metres per unit of depth, where the format doesn't say it or the files don't keep to it.
    ValueError names the folder or the file in it, and what was expected.
    """
    if (folder / "sequence").is_file():
        return _vot(folder, scale)
    if (folder / "depth.txt").is_file() or (folder / "rgb.txt").is_file():
        return _tum(folder, scale)
    color, depth = (princeton.images_in(folder / channel) for channel in ("rgb", "depth"))
    if color and depth:
        return Layout(princeton.pair(color, depth, scale), find_ptb_truth(folder))
    if (folder / VOT).is_file() and all(_counted(folder / channel) for channel in ("color", "depth")):
        return _vot_rgbd(folder, scale)
    if sequence := kitti.find_sequence(folder):
        return _kitti(sequence)
    return _plain(folder, scale)


def depth_images(paths: Sequence[Path], scale: float | None) -> Images:
    """Images of depth; ValueError where their unit is needed and unknown. Princeton's are known by their
    names.
    """
    if len(images := princeton.named_images(paths)) == len(paths):
        return princeton.depth_images(images, scale)
    return Images(paths, read=DepthReader(known_scale(paths[0].parent, scale)))


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


def _vot_fps(values: Mapping[str, str]) -> float | None:
    try:
        return sane_rate(float(values.get("fps", "")))
    except ValueError:
        return None


def _vot_color(values: Mapping[str, str]) -> str:
    """The pattern of the color channel, which may have another name if it is the default; "" without one."""
    default = values.get("channel.default")
    return values.get("channels.color") or (
        values.get(f"channels.{default}", "") if default != "depth" else ""
    )


def _vot_images(folder: Path, channel: str, pattern: str) -> list[Path]:
    """The images that the pattern names, in the order of their numbers."""
    place = (folder / pattern).parent
    around = re.split(r"%\d*d", Path(pattern).name)
    if len(around) != 2 or not place.is_dir():
        suffix = {"color": "jpg", "depth": "png"}[channel]
        raise ValueError(
            f"{folder / 'sequence'}: expected channels.{channel}={channel}/%08d.{suffix}, got {pattern!r}"
        )
    name = re.compile(r"\d+".join(map(re.escape, around)))
    paths = [path for path in image_paths(place) if name.fullmatch(path.name)]
    if not paths:
        raise ValueError(f"{place}: expected the images of the {channel} channel, found none")
    return paths


def _counted(folder: Path) -> bool:
    """Whether the images are called 00000001.jpg and so on, as all of VOT's are."""
    paths = image_paths(folder) if folder.is_dir() else []
    return bool(paths) and all(re.fullmatch(r"\d{8}", path.stem) for path in paths)


def _vot_rgbd(folder: Path, scale: float | None) -> Layout:
    """The same without a sequence file, as CDTB's and DepthTrack's come: color/, depth/, true boxes."""
    reader = DepthReader(MILLIMETRES if scale is None else scale)
    channels: dict[str, Stream] = {
        "color": Images(image_paths(folder / "color")),
        "depth": Images(image_paths(folder / "depth"), read=reader),
    }
    return Layout(channels, find_truth(folder))


def _tum(folder: Path, scale: float | None) -> Layout:
    """TUM's RGB-D lists of times and files. Its groundtruth.txt is the camera's path: it has no boxes."""
    listed = {name: _tum_list(folder / f"{name}.txt") for name in ("rgb", "depth")}
    color, depth = listed["rgb"], listed["depth"]
    reader = DepthReader(TUM_SCALE if scale is None else scale)
    if not (color and depth):
        name, images = ("color", color) if color else ("depth", depth)
        return Layout({name: timed_images(images, reader) if depth else timed_images(images)})
    pairs = _closest_pairs([time for time, _ in color], [time for time, _ in depth], TUM_APART)
    if not pairs:
        raise ValueError(
            f"{folder}: expected color and depth images within {TUM_APART} s of each other, found none"
        )
    channels: dict[str, Stream] = {
        "color": timed_images([color[i] for i, _ in pairs]),
        "depth": timed_images([depth[j] for _, j in pairs], reader),
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
    time, *name = re.split(r"[\s,]+", line.strip(), maxsplit=1)  # as the benchmark's own reader does
    try:
        seconds = float(time)
    except ValueError:
        seconds = np.nan
    if not (name and np.isfinite(seconds)):
        raise ValueError(f"{path}, line {number}: expected a timestamp and a file name, got {line!r:.60}")
    return seconds, path.parent / name[0]


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


def _kitti(sequence: kitti.Sequence) -> Layout:
    """The color pair, or the left images alone. Its labels are of many targets: none of them is the truth."""
    channels: dict[str, Stream] = {"color": Images(image_paths(sequence.left))}
    if sequence.right:
        channels["right"] = Images(image_paths(sequence.right))
    return Layout(channels, calibration=sequence.calibration)


def _plain(folder: Path, scale: float | None) -> Layout:
    """Images in a folder of a usual name or in the folder itself, or one video; depth in depth/, and right/
    beside left/.
    """
    places = [folder / sub for sub in _COLOR_FOLDERS if (folder / sub).is_dir()]
    images = next((paths for place in (*places, folder) if (paths := image_paths(place))), [])
    if images and is_depth(images[0]):
        return Layout({"depth": depth_images(images, scale)}, find_truth(folder))
    depth = image_paths(folder / "depth") if (folder / "depth").is_dir() else []
    channels: dict[str, Stream] = {}
    if images:
        channels["color"] = _color_images(images)
        if images[0].parent == folder / "left" and (folder / "right").is_dir():
            channels["right"] = Images(image_paths(folder / "right"))
    elif video := _video(folder, optional=bool(depth)):
        channels["color"] = video
    if depth and channels and scale is None:
        note = f"left out {folder / 'depth'}: --depth-scale gives its metres per unit, 0.001 for millimetres"
        return Layout(channels, find_truth(folder), (note,))
    if depth:
        channels["depth"] = depth_images(depth, scale)
    return Layout(channels, find_truth(folder))


def _color_images(paths: Sequence[Path]) -> Images:
    images = princeton.named_images(paths)
    return timed_images(images) if len(images) == len(paths) else Images(paths)


def _video(folder: Path, optional: bool) -> Video | None:
    videos = [path for path in sorted(folder.iterdir()) if path.suffix.lower() in _VIDEOS]
    if len(videos) == 1:
        return Video(videos[0])
    if optional and not videos:
        return None
    found = f"{len(videos)} videos; name one of them" if videos else "neither images nor a video"
    raise ValueError(f"{folder}: expected a folder of images or a sequence, found {found}")
