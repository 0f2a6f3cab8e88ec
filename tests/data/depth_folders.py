# SPDX-License-Identifier: MIT
"""Folders of color and depth in several layouts, and what is read from them."""

from collections.abc import Callable, Iterable
from pathlib import Path

import cv2
import numpy as np
from tricue.data.open_source import Source, open_source


def write_depth(path: Path, units: int, size: tuple[int, int] = (40, 30)) -> Path:
    """A 16-bit image, one value all over but for a corner of 0: nothing measured there."""
    image = np.full(size[::-1], units, np.uint16)
    image[0, 0] = 0
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), image)
    return path


def write_color(path: Path, level: int = 90) -> Path:
    """A color image of one level, larger than the depth images."""
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), np.full((48, 64, 3), level, np.uint8))
    return path


def depth_folder(folder: Path, values: Iterable[int]) -> Path:
    """A folder of 16-bit images 1.png, 2.png, ..."""
    for index, units in enumerate(values, 1):
        write_depth(folder / f"{index}.png", units)
    return folder


def color_folder(folder: Path, count: int) -> Path:
    """A folder of color images of the levels 10, 20, ..."""
    for index in range(1, count + 1):
        write_color(folder / f"{index}.png", 10 * index)
    return folder


def meters(source: Source) -> list[float]:
    """The depth in the middle of each frame."""
    return [float(frame.depth[15, 20]) for frame in source if frame.depth is not None]


def levels(source: Source) -> list[int]:
    """The mean level of each frame's color."""
    return [round(float(frame.color.mean())) for frame in source if frame.color is not None]


def vot(folder: Path, lines: str) -> Path:
    """A VOT folder of two frames, color and depth."""
    color_folder(folder / "color", 2)
    depth_folder(folder / "depth", [1234, 2345])
    (folder / "sequence").write_text(f"fps=4\n{lines}")
    return folder


CHANNELS = "channels.color=color/%08d.png\nchannels.depth=depth/%08d.png\n"


def tum(folder: Path, color: Iterable[float], depth: Iterable[float]) -> Path:
    """A TUM folder: depth of 5000, 5001, ... units in the order given, and the path of the camera."""
    lists: dict[str, list[str]] = {"rgb": [], "depth": []}
    for index, time in enumerate(color, 1):
        write_color(folder / "rgb" / f"{time:.6f}.png", 10 * index)
        lists["rgb"].append(f"{time:.6f} rgb/{time:.6f}.png")
    for index, time in enumerate(depth):
        write_depth(folder / "depth" / f"{time:.6f}.png", 5000 + index)
        lists["depth"].append(f"{time:.6f} depth/{time:.6f}.png")
    for name, lines in lists.items():
        if lines:
            (folder / f"{name}.txt").write_text("\n".join(["# images", "#timestamp filename", *lines, ""]))
    (folder / "groundtruth.txt").write_text("# timestamp tx ty tz qx qy qz qw\n1.0 1 2 3 0 0 0 1\n")
    return folder


def rotated(units: int) -> int:
    """The Princeton benchmark's bits: turned three places to the left."""
    return ((units << 3) | (units >> 13)) & 0xFFFF


def ptb(folder: Path) -> Path:
    """A Princeton folder: three color images and two depth images, numbers that don't sort as text."""
    for index, (time, frame) in enumerate([(0, 9), (33_000, 10), (66_000, 11)], 1):
        write_color(folder / "rgb" / f"r-{time}-{frame}.png", 10 * index)
    write_depth(folder / "depth" / "d-1000-1.png", rotated(9000))  # its top bit is set by the turn
    write_depth(folder / "depth" / "d-60000-2.png", rotated(1500))
    return folder


def beside(make: Callable[[Path], object]) -> Callable[[Path], Source]:
    """One color image, with what ``make`` puts into another folder as its depth."""

    def opened(folder: Path) -> Source:
        make(folder / "d")
        return open_source(color_folder(folder / "c", 1), depth=folder / "d", depth_scale=0.001)

    return opened
