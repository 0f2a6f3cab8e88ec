# SPDX-License-Identifier: MIT
"""The sequences of a data set, each with one target, found without reading images.

An :class:`Entry` is small: it can be sent to another process or machine, which opens it.
"""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.camera import toml
from tricue.camera.numbers import positive
from tricue.camera.read_calibration import read_intrinsics, read_rig
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.datasets import find_sequences
from tricue.data.input_files import stream_files
from tricue.data.layouts import list_targets
from tricue.data.open_source import Source, open_source
from tricue.data.recordings.recording import is_recording
from tricue.data.streams import Images, Video
from tricue.data.summary import count_frames
from tricue.data.truth_check import find_missing_image

STEREO_CALIBRATION = "calibration.yml"
"""File name of OpenCV's calibration of a stereo pair, searched beside its images."""
CLIPPED_FORMATS = ("VOT", "VOT RGB-D", "KITTI tracking")
"""Formats whose boxes end at the image's edge: both true and tracked boxes are clipped to the image before
they are compared, as in the VOT toolkit.
"""

CAMERA_KEYS = {"fx", "fy", "cx", "cy"}  # of a camera's TOML table
OPTIONAL_CAMERA_KEYS = {"width", "height", "pose", "rotation", "translation"}


@dataclass(frozen=True)
class ReadOptions:
    """Values that a data set's files don't contain, needed to read them.

    depth_scale: meters per unit of depth, if the format doesn't define it. fps: frames/s of images without
    times. unit: meters per unit of OpenCV's stereo calibrations. truth: the channel, "color" or "depth", in
    whose pixels the true boxes are. None means color, or depth if depth isn't registered to color and
    positions were measured in it.
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
    reading: ReadOptions = ReadOptions()

    def open(self) -> "OpenedSequence":
        """Its frames, truth and cameras. ValueError or OSError names the file that can't be read."""
        reading = self.reading
        source = open_source(
            self.place,
            depth_scale=_depth_scale_of(self, reading.depth_scale),
            fps=reading.fps,
            target=self.target,
        )
        return OpenedSequence(self, source)


@dataclass(frozen=True)
class OpenedSequence:
    """An entry with its files opened; frames are read on demand."""

    entry: Entry
    source: Source

    @property
    def channels(self) -> tuple[str, ...]:
        """The names of its channels."""
        return tuple(self.source.channels)

    @cached_property
    def channel(self) -> str:
        """The channel in whose pixels the true boxes are."""
        if self.entry.reading.truth is not None:
            return self.entry.reading.truth
        if "color" not in self.source.channels:
            return "depth"
        measured = "depth" in self.source.channels and self.source.positions is not None
        return "depth" if measured and not self.registered else "color"

    @property
    def group(self) -> str:
        """The group in which trackers are compared: "stereo", "rgbd", "depth" or "color"."""
        channels = self.source.channels
        if "right" in channels:
            return "stereo"
        if self.channel == "depth":
            return "depth"
        return "rgbd" if "depth" in channels else "color"

    @cached_property
    def registered(self) -> bool:
        """Whether depth and color pixels coincide; they don't for two different cameras."""
        path = self.source.calibration
        if path is None or path.suffix.lower() != ".toml":
            return True
        color, depth = (toml.read(path).get(name) for name in ("color", "depth"))
        if not isinstance(color, dict) or not isinstance(depth, dict):
            return True
        told = CAMERA_KEYS | (OPTIONAL_CAMERA_KEYS & color.keys() & depth.keys())
        return all(color.get(key) == depth.get(key) for key in told)

    @property
    def clipped(self) -> bool:
        """Whether boxes are clipped to the image before they are compared."""
        return self.source.format in CLIPPED_FORMATS

    @cached_property
    def size(self) -> tuple[int, int]:
        """Width and height of the images in whose pixels the boxes are."""
        return self.source.channels[self.channel].size

    @cached_property
    def frames(self) -> int:
        """The number of frames; those of a video are counted, once in a process."""
        if self.source.length is not None:
            return self.source.length
        return min(
            _count_video(each.path, each.path.stat().st_mtime_ns)
            if isinstance(each, Video)
            else count_frames(each)
            for each in self.source.channels.values()
        )

    @property
    def intrinsics(self) -> Intrinsics | None:
        """The depth camera's intrinsics, if a file beside the images has them."""
        path = self.source.calibration
        if path is None or "depth" not in self.source.channels:
            return None
        return read_intrinsics(path, self.source.size, "depth", self.source.kitti_cameras[0])

    @property
    def rig(self) -> StereoRig | None:
        """The stereo rig, if a file beside the images has it."""
        path = self.source.calibration or self.entry.place / STEREO_CALIBRATION
        if "right" not in self.source.channels or not path.is_file():
            return None
        unit = self.entry.reading.unit if path.name == STEREO_CALIBRATION else None
        return read_rig(path, self.source.size, unit, self.source.kitti_cameras)

    @property
    def boxes(self) -> NDArray[np.float64]:
        """(M, 4) the labeled boxes, on which trackers start; M may differ from the number of frames."""
        known = self.source.truth
        return np.empty((0, 4)) if known is None else known

    def check(self) -> None:
        """ValueError if there is no frame to start in or none after it, or if an image is missing between
        others, which would assign all later true boxes to the wrong images.
        """
        start, length = self.start, self.source.length
        if length is not None and length < start + 2:
            frames = "1 frame" if length == 1 else f"{length} frames"
            raise ValueError(f"{self.entry.place}: expected a frame after the first true box, got {frames}")
        if reason := find_missing_image(self.entry.place, self.source):
            raise ValueError(reason)

    @property
    def start(self) -> int:
        """The first frame with a true box, where trackers start. ValueError if there is none."""
        known = np.flatnonzero(~np.isnan(self.boxes).any(axis=1))
        if not known.size:
            raise ValueError(f"{self.entry.place}: expected a true box in one frame or more, got none")
        return int(known[0])

    def truth(self, frames: int) -> NDArray[np.float64]:
        """True boxes (frames, 4) to compare results with; NaN where the target is absent, its box is unknown,
        or boxes are clipped and it is wholly outside the image.
        """
        boxes: NDArray[np.float64] = _fit_to_frames(self.boxes, frames, np.nan)
        return self.clip(boxes)

    def clip(self, boxes: NDArray[np.float64]) -> NDArray[np.float64]:
        """Boxes (M, 4) as they are compared: clipped to the image in formats that do so, and then NaN if
        outside it.
        """
        if not self.clipped:
            return boxes
        low, high = boxes[:, :2], boxes[:, :2] + boxes[:, 2:]
        crossing = ~((low >= 0) & (high <= self.size)).all(axis=1)  # the others stay exact
        low, high = np.clip(low, 0, self.size), np.clip(high, 0, self.size)
        found: NDArray[np.float64] = boxes.copy()
        found[crossing] = np.concatenate([low, high - low], axis=1)[crossing]
        found[~(found[:, 2:] > 0).all(axis=1)] = np.nan
        return found

    def absent(self, frames: int) -> NDArray[np.bool_]:
        """(frames,) whether the target is labeled as absent."""
        known = self.source.absent
        return _fit_to_frames(np.empty(0, np.bool_) if known is None else known, frames, False)

    def positions(self, frames: int) -> NDArray[np.float64]:
        """(frames, 3) true positions, meters, NaN where unknown."""
        known = self.source.positions
        return _fit_to_frames(np.empty((0, 3)) if known is None else known, frames, np.nan)

    @property
    def digest(self) -> str:
        """A hash of what a run depends on: truth, the images' names, sizes and times, not their folder."""
        known = self.entry.name, self.entry.reading, self.entry.target, self.clipped, self.source.rate
        found = hashlib.sha256(repr(known).encode())
        for values in (self.source.truth, self.source.absent, self.source.positions):
            found.update(b"" if values is None else np.ascontiguousarray(values).tobytes())
        for name, stream in self.source.channels.items():
            found.update(
                repr((name, [(path.name, path.stat().st_size) for path in stream_files(stream)])).encode()
            )
            if isinstance(stream, Images):  # their times are in other files; a video's are in its own
                found.update(repr((stream.rate, stream.times)).encode())
        for path in (self.source.calibration, self.entry.place / STEREO_CALIBRATION):
            if path is not None and path.is_file():
                found.update(path.read_bytes())
        return found.hexdigest()


def find_entries(
    root: Path, reading: ReadOptions = ReadOptions(), progress: Callable[[int], None] = lambda _: None
) -> list[Entry]:
    """The sequences in or under a folder, one per labeled target, sorted by name.

    progress: as :func:`find_sequences` takes it. ValueError if there is none, and for a malformed sequence.
    Targets that are never visible are left out.
    """
    entries = []
    for place in find_sequences(root, progress):
        name = _relative_name(root, place)
        labeled = list_targets(place) if place.is_dir() else ()
        each = [Entry(f"{name}/{target}", place, target, reading) for target in labeled]
        entries += each or [Entry(name, place, None, reading)]
    if not entries:
        raise ValueError(
            f"{root}: expected sequences with true boxes, found none; tricue info says what is there"
        )
    return entries


def short_names(entries: Sequence[Entry]) -> dict[str, str]:
    """By name, the shortest ending of each entry's name, in whole parts, that is unique; for a target at
    least its sequence's name and its own, such as "Jogging/2".
    """
    parts = {each.name: each.name.split("/") for each in entries}

    def is_shared(tail: list[str]) -> bool:
        return sum(other[-len(tail) :] == tail for other in parts.values()) > 1

    found = {}
    for entry in entries:
        whole = parts[entry.name]
        count = 1 if entry.target is None else 2
        while count < len(whole) and is_shared(whole[-count:]):
            count += 1
        found[entry.name] = "/".join(whole[-count:])
    return found


def _relative_name(root: Path, place: Path) -> str:
    relative = place.relative_to(root)
    return relative.with_suffix("").as_posix() if relative.parts else place.resolve().stem


def _depth_scale_of(entry: Entry, scale: float | None) -> float | None:
    """The depth scale; None if the format defines it or there is no depth, because then none may be given.

    A robot recording's own scale is overridden.
    """
    if scale is None:
        return None
    try:
        source = open_source(entry.place, target=entry.target)
    except ValueError:  # depth images alone need it
        return scale
    if "depth" in source.channels:
        return scale if is_recording(entry.place) else None
    return scale if any("depth" in note for note in source.notes) else None


@lru_cache(maxsize=1000)
def _count_video(path: Path, modified: int) -> int:  # modified: a changed video is counted again
    return Video(path).count()


def _fit_to_frames(values: NDArray, frames: int, filler: float | bool) -> NDArray:  # type: ignore[type-arg]
    rows = np.full((frames, *values.shape[1:]), filler, values.dtype)
    rows[: len(values)] = values[:frames]
    return rows
