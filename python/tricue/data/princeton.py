# SPDX-License-Identifier: MIT
"""The Princeton Tracking Benchmark's files: rgb/r-<time>-<frame>.png, depth/d-<time>-<frame>.png.

Source: Song, Xiao, "Tracking Revisited using RGBD Camera: Unified Benchmark and Baselines", ICCV 2013, and
the code that its page gives to read the sequences.
"""

import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from tricue.data.depth_images import METERS_PER_MILLIMETER, DepthReader
from tricue.data.streams import Images, Stream, TimedPaths, timed_images

SECONDS_PER_TICK = 1e-6  # seconds per unit of the times in the files' names
_FILE_NAME = re.compile(r"[rd]-(\d+)-(\d+)\.png")


def timestamped_images(paths: Iterable[Path]) -> TimedPaths:
    """Times in seconds and files, sorted by the frame numbers in the names; other files are left out."""
    names = ((_FILE_NAME.fullmatch(path.name), path) for path in paths)
    found = sorted((int(name[2]), int(name[1]) * SECONDS_PER_TICK, path) for name, path in names if name)
    return [(time, path) for _, time, path in found]


def find_timestamped_images(folder: Path) -> TimedPaths:
    """The timestamped images in a folder; empty if there is no such folder."""
    return timestamped_images(folder.iterdir()) if folder.is_dir() else []


def depth_images(images: TimedPaths, scale: float | None) -> Images:
    """A stream of depth images with rotated bits. scale: meters per unit, 0.001 by default."""
    return timed_images(images, DepthReader(METERS_PER_MILLIMETER if scale is None else scale, rotated=True))


def read_channels(folder: Path, scale: float | None) -> dict[str, Stream] | None:
    """Each color image with the depth image nearest in time; None if the folder isn't Princeton's.

    Frames are those of color, because the true boxes belong to the color images.
    """
    color, depth = (find_timestamped_images(folder / channel) for channel in ("rgb", "depth"))
    if not (color and depth):
        return None
    times = np.array([time for time, _ in depth])
    nearest = [depth[int(np.argmin(np.abs(times - time)))] for time, _ in color]
    return {"color": timed_images(color), "depth": depth_images(nearest, scale)}
