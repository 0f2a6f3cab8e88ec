# SPDX-License-Identifier: MIT
"""What is evaluated on: the sequences under a folder, each with one target, found without reading images.

An :class:`Entry` is small and can be sent to another process or machine, which opens it.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.camera import toml
from tricue.camera.numbers import positive
from tricue.camera.read_calibration import read_intrinsics, read_rig
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.datasets import find_sequences
from tricue.data.layouts import list_targets
from tricue.data.open_source import Source, open_source
from tricue.data.streams import Images, Stream, Video

RATES = {"KITTI tracking": 10.0}
"""Frames a second of the cameras of formats whose files don't tell them (Geiger et al. 2013)."""
PAIR = "calibration.yml"
"""OpenCV's calibration of a pair, looked for beside its images."""
BOUNDED = ("VOT", "VOT RGB-D", "KITTI tracking")
"""Formats whose true boxes end at the image's edge, so that of a found box only the part inside counts."""


@dataclass(frozen=True)
class Reading:
    """How a data set's files are read, where they don't tell it themselves.

    depth_scale: meters per unit of depth. fps: frames a second of images without times. unit: meters per
    unit of OpenCV's stereo calibrations. truth: the channel, "color" or "depth", whose pixels the true boxes
    count; None for color, but for depth where it isn't registered to the color and positions of the target
    were measured in it.
    """

    depth_scale: float | None = None
    fps: float | None = None
    unit: float | None = None
    truth: str | None = None

    def __post_init__(self) -> None:
        units = {"depth_scale": "meters per unit", "fps": "frames a second", "unit": "meters per unit"}
        for name, unit in units.items():
            if (value := getattr(self, name)) is not None:
                positive(value, name, unit)


@dataclass(frozen=True)
class Entry:
    """A sequence with one target. name: unique in the data set, such as "color/David" or "kitti/Car 31"."""

    name: str
    place: Path
    target: str | None = None
    reading: Reading = Reading()

    def open(self) -> "Opened":
        """Its frames, truth and cameras. ValueError or OSError names the file that can't be read."""
        reading = self.reading
        source = open_source(
            self.place, depth_scale=_scale(self, reading.depth_scale), fps=reading.fps, target=self.target
        )
        if reading.fps is None and source.format in RATES and not source.clock.timed:
            source = replace(source, rate=RATES[source.format])
        return Opened(self, source)


@dataclass(frozen=True)
class Opened:
    """An entry whose files were looked at; its frames are read as they are asked for."""

    entry: Entry
    source: Source

    @property
    def channels(self) -> tuple[str, ...]:
        """Those of its frames."""
        return tuple(self.source.channels)

    @cached_property
    def channel(self) -> str:
        """The channel whose pixels the true boxes count."""
        if self.entry.reading.truth is not None:
            return self.entry.reading.truth
        if "color" not in self.source.channels:
            return "depth"
        measured = "depth" in self.source.channels and self.source.positions is not None
        return "depth" if measured and not self.registered else "color"

    @property
    def group(self) -> str:
        """The trackers that can be compared: those that see "stereo", "rgbd", "depth" or "color"."""
        channels = self.source.channels
        if "right" in channels:
            return "stereo"
        if self.channel == "depth":
            return "depth"
        return "rgbd" if "depth" in channels else "color"

    @cached_property
    def registered(self) -> bool:
        """Whether a depth pixel is the color pixel of the same place: not with two different cameras."""
        path = self.source.calibration
        if path is None or path.suffix.lower() != ".toml":
            return True
        tables = toml.read(path)
        return not ("color" in tables and "depth" in tables) or tables["color"] == tables["depth"]

    @property
    def bounded(self) -> bool:
        """Whether the true boxes end at the image's edge."""
        return self.source.format in BOUNDED

    @cached_property
    def size(self) -> tuple[int, int]:
        """Width and height of the images whose pixels the boxes count."""
        return self.source.channels[self.channel].size

    @property
    def intrinsics(self) -> Intrinsics | None:
        """The depth camera's, where a file beside the images tells them."""
        path = self.source.calibration
        if path is None or "depth" not in self.source.channels:
            return None
        return read_intrinsics(path, self.source.size, "depth")

    @property
    def rig(self) -> StereoRig | None:
        """The pair's, where a file beside the images tells it."""
        path = self.source.calibration or self.entry.place / PAIR
        if "right" not in self.source.channels or not path.is_file():
            return None
        unit = self.entry.reading.unit if path.name == PAIR else None
        return read_rig(path, self.source.size, unit)

    @property
    def boxes(self) -> NDArray[np.float64]:
        """(M, 4) the true boxes that are told; M may differ from the number of frames."""
        known = self.source.truth
        return np.empty((0, 4)) if known is None else known

    def check(self) -> None:
        """ValueError where trackers can't even start."""
        _ = self.start

    @property
    def start(self) -> int:
        """The first frame with a true box, in which trackers start. ValueError where there is none."""
        known = np.flatnonzero(~np.isnan(self.boxes).any(axis=1))
        if not known.size:
            raise ValueError(f"{self.entry.place}: expected a true box in one frame or more, got none")
        return int(known[0])

    def truth(self, frames: int) -> NDArray[np.float64]:
        """(frames, 4) true boxes, NaN where the target is absent or its box unknown."""
        return _rows(self.boxes, frames, np.nan)

    def absent(self, frames: int) -> NDArray[np.bool_]:
        """(frames,) whether the target isn't visible, as far as it is known."""
        known = self.source.absent
        return _rows(np.empty(0, np.bool_) if known is None else known, frames, False)

    def positions(self, frames: int) -> NDArray[np.float64]:
        """(frames, 3) true positions, meters, NaN where unknown."""
        known = self.source.positions
        return _rows(np.empty((0, 3)) if known is None else known, frames, np.nan)

    @property
    def digest(self) -> str:
        """Of what decides a run: the truth, and the names and sizes of the images. Not of where they are."""
        found = hashlib.sha256(repr((self.entry.name, self.entry.reading, self.entry.target)).encode())
        for values in (self.source.truth, self.source.absent, self.source.positions):
            found.update(b"" if values is None else np.ascontiguousarray(values).tobytes())
        for name, stream in self.source.channels.items():
            found.update(repr((name, [(path.name, path.stat().st_size) for path in _files(stream)])).encode())
        for path in (self.source.calibration, self.entry.place / PAIR):
            if path is not None and path.is_file():
                found.update(path.read_bytes())
        return found.hexdigest()


def find_entries(root: Path, reading: Reading = Reading()) -> list[Entry]:
    """The sequences at or under a folder, one for each labeled target, by name.

    ValueError where there is none, and for what can't be opened: a folder that looks like a sequence but is
    malformed is told, not left out. Targets that are never visible are left out.
    """
    entries = []
    for place in find_sequences(root):
        name = _name(root, place)
        labeled = list_targets(place) if place.is_dir() else ()
        each = [Entry(f"{name}/{target}", place, target, reading) for target in labeled]
        entries += each or [Entry(name, place, None, reading)]
    if not entries:
        raise ValueError(f"{root}: expected sequences with true boxes, found none")
    return entries


def _name(root: Path, place: Path) -> str:
    relative = place.relative_to(root)
    return relative.with_suffix("").as_posix() if relative.parts else place.resolve().stem


def _scale(entry: Entry, scale: float | None) -> float | None:
    """The scale for a place with depth; one without it would refuse it."""
    if scale is None:
        return None
    source = open_source(entry.place, target=entry.target)
    has_depth = "depth" in source.channels or any("depth" in note for note in source.notes)
    return scale if has_depth else None


def _files(stream: Stream) -> Sequence[Path]:
    """A recording's; a camera has none."""
    if isinstance(stream, Images):
        return stream.paths
    return [stream.path] if isinstance(stream, Video) else []


def _rows(values: NDArray, frames: int, filler: float | bool) -> NDArray:  # type: ignore[type-arg]
    rows = np.full((frames, *values.shape[1:]), filler, values.dtype)
    rows[: len(values)] = values[:frames]
    return rows
