# SPDX-License-Identifier: MIT
"""Recordings with color and depth in the same pixels, for depth_properties."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics
from tricue.data.truth import VOT_TRUTH
from tricue.evaluation.dataset import Entry, ReadOptions, find_entries
from tricue.scenes.rooms.scene import room_scene

from benchmarks.quality.common.registered_frames import color_camera, registered

Array = NDArray[np.float64]


class DepthSequence(NamedTuple):
    """N frames with ``color`` and ``depth`` in the same pixels.

    targets: the boxes (N, 4) of each, NaN where it isn't visible. rate: frames per second, NaN if unknown.
    """

    name: str
    frames: tuple[Frame, ...]
    targets: tuple[Array, ...]
    intrinsics: Intrinsics
    rate: float

    def every(self, count: int) -> list[int]:
        """The numbers of at most ``count`` frames, evenly spaced."""
        last = len(self.frames) - 1
        spread = np.linspace(0, last, min(count, last + 1)).round()
        return [int(number) for number in np.unique(spread)]


def gray_of(frame: Frame) -> NDArray[np.uint8]:
    """The brightness (H, W) of a frame."""
    assert frame.color is not None
    return np.asarray(cv2.cvtColor(frame.color, cv2.COLOR_BGR2GRAY), np.uint8)


def depth_of(frame: Frame) -> Array:
    """The depth (H, W), meters, NaN where nothing was measured."""
    assert frame.depth is not None
    depth = np.asarray(frame.depth, np.float64)
    return np.where(depth > 0, depth, np.nan)


def recorded(root: Path, shift: float) -> Iterator[DepthSequence]:
    """The recordings under ``root`` with color and depth. shift: as in rgbd_people, meters."""
    for entry in find_entries(root, ReadOptions(truth="depth")):
        opened = entry.open()
        camera, intrinsics = color_camera(opened), opened.intrinsics
        if camera is None or intrinsics is None:
            continue
        frames = tuple(registered(opened, camera, shift))
        rate = opened.source.channels["depth"].fps
        yield DepthSequence(entry.name, frames, _targets(entry, len(frames)), intrinsics, rate or np.nan)


def rendered(kind: str, seed: int) -> DepthSequence:
    """A scene of tricue.scenes.rooms, as a recording."""
    scene = room_scene(kind, seed, channels="rgbd")
    boxes = np.where(scene.visible[:, None] > 0, scene.boxes, np.nan)
    return DepthSequence(f"room {kind} {seed}", scene.frames, (boxes,), scene.intrinsics, scene.rate)


def _targets(entry: Entry, count: int) -> tuple[Array, ...]:
    """The boxes of the entry's target, and of others whose files are beside its own."""
    place = entry.place if entry.place.is_dir() else entry.place.parent
    files = [place / VOT_TRUTH, *sorted(place.glob(f"{Path(VOT_TRUTH).stem}_*.txt"))]
    tables = [np.loadtxt(file, delimiter=",", ndmin=2)[:count] for file in files]
    return tuple(np.vstack([table, np.full((count - len(table), 4), np.nan)]) for table in tables)
