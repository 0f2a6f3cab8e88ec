# SPDX-License-Identifier: MIT
"""The Princeton Tracking Benchmark's files: rgb/r-<time>-<frame>.png, depth/d-<time>-<frame>.png.

Source: Song, Xiao, "Tracking Revisited using RGBD Camera: Unified Benchmark and Baselines", ICCV 2013, and
the code that its page gives to read the sequences.
"""

import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from tricue.data.depth_images import MILLIMETRES, DepthReader
from tricue.data.streams import Images, Stream, Timed, timed_images

TICK = 1e-6  # seconds per unit of the times in the files' names
_NAME = re.compile(r"[rd]-(\d+)-(\d+)\.png")


def named_images(paths: Iterable[Path]) -> Timed:
    """Times in seconds and files, in the order of the frames' numbers; other files are left out."""
    names = ((_NAME.fullmatch(path.name), path) for path in paths)
    found = sorted((int(name[2]), int(name[1]) * TICK, path) for name, path in names if name)
    return [(time, path) for _, time, path in found]


def images_in(folder: Path) -> Timed:
    """The same of a folder; nothing where there is none."""
    return named_images(folder.iterdir()) if folder.is_dir() else []


def depth_images(images: Timed, scale: float | None) -> Images:
    """Depth in millimetres unless the scale says otherwise, whose bits are turned."""
    return timed_images(images, DepthReader(MILLIMETRES if scale is None else scale, rotated=True))


def channels(folder: Path, scale: float | None) -> dict[str, Stream] | None:
    """Each color image, for which a true box stands, with the depth image that is nearest in time; None where
    it isn't Princeton's.
    """
    color, depth = (images_in(folder / channel) for channel in ("rgb", "depth"))
    if not (color and depth):
        return None
    times = np.array([time for time, _ in depth])
    nearest = [depth[int(np.argmin(np.abs(times - time)))] for time, _ in color]
    return {"color": timed_images(color), "depth": depth_images(nearest, scale)}
