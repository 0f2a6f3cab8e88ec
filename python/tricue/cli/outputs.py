# SPDX-License-Identifier: MIT
"""Outputs of a run, written frame by frame: CSV, JSON, overlay video. A file is complete once closed.

Creating an output empties its file, so only a run that has started does so.
"""

import csv
import io
import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image
from tricue.camera.frame import Frame
from tricue.camera.rig import StereoRig
from tricue.data.streams import DEFAULT_FPS
from tricue.draw.canvas import choose_scale
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.draw.masks import flow_depth_overlay
from tricue.draw.overlays import depth_overlay, overlay
from tricue.draw.status_strip import StatusStrip
from tricue.draw.stereo import stereo_overlay
from tricue.draw.targets import target_color, targets_overlay
from tricue.draw.trail import Trail
from tricue.draw.video import OverlayWriter
from tricue.export.table import PLAIN, TableForm, columns, row
from tricue.export.text_file import TextFile
from tricue.export.tracks_json import NamedTarget, TracksJson
from tricue.track.base.track import Track

STANDARD_OUTPUT = Path("-")  # in place of a file
RANGE_SMOOTHING = 0.1  # weight of a new frame in the depth range of the video


class Step(NamedTuple):
    """One tracked frame: its number from 0, the frame, its track, and the tracking time in seconds.

    particles, objects, mask, blocks: the tracker's, if it has them. tracks: of several targets, by their ids;
    ``track`` is then the first one's. None for one target.
    """

    number: int
    frame: Frame
    track: Track
    seconds: float
    particles: Any = None
    objects: Any = None
    mask: Any = None
    blocks: Any = None
    tracks: Mapping[int, Track] | None = None

    @property
    def targets(self) -> Mapping[int, Track]:
        """The tracks by their targets' ids; a single target has the id 1."""
        return {1: self.track} if self.tracks is None else self.tracks

    def time(self, fps: float) -> float:
        """The frame's time, seconds; at so many frames/s where it has no timestamp."""
        return self.number / fps if self.frame.timestamp is None else self.frame.timestamp


class Output(AbstractContextManager[Any], Protocol):
    """A context manager that writes the steps of a run."""

    @property
    def path(self) -> Path: ...

    @property
    def about(self) -> str: ...

    def write(self, step: Step) -> None: ...


def rows(step: Step, form: TableForm) -> Iterator[list[Any]]:
    """The values of ``columns`` for each target."""
    for target, track in step.targets.items():
        yield row(step.number, step.frame.timestamp, track, target, form)


class CsvOutput(TextFile):
    """A header and a line per frame and target; absent values are empty."""

    def __init__(self, path: Path, form: TableForm = PLAIN) -> None:
        super().__init__(path)
        self._form = form
        self._put_rows([columns(form)])

    def write(self, step: Step) -> None:
        self._put_rows(rows(step, self._form))

    def _put_rows(self, lines: Iterable[Iterable[Any]]) -> None:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(lines)
        self.put(text.getvalue())


class JsonOutput(TextFile):
    """One object, see :class:`tricue.export.tracks_json.TracksJson`. All targets have the tracker that
    ``about`` names.
    """

    def __init__(
        self,
        path: Path,
        about: dict[str, Any],
        rate: Callable[[], float] = lambda: DEFAULT_FPS,
        form: TableForm = PLAIN,
    ) -> None:
        super().__init__(path)
        self._text, self._tracker = TracksJson(rate, form), about.get("tracker", "")
        self._targets: dict[int, NamedTarget] = {}
        self.put(self._text.begin(about))

    def write(self, step: Step) -> None:
        for target in step.targets:
            self._targets.setdefault(target, NamedTarget(target, f"Target {target}", self._tracker))
        self.put(self._text.add(step.number, step.frame.timestamp, step.targets))

    def finish(self) -> None:
        self.put(self._text.end(self._targets.values()))


class JsonLines:
    """One object per line on standard output, with the columns as keys, for other programs."""

    about = ""

    def __init__(self, form: TableForm = PLAIN) -> None:
        self.path = STANDARD_OUTPUT
        self._form, self._stream = form, sys.stdout

    def write(self, step: Step) -> None:
        names = columns(self._form)
        for values in rows(step, self._form):
            line = json.dumps(dict(zip(names, values, strict=True)), allow_nan=False)
            self._stream.write(f"{line}\n")
        self._stream.flush()

    def __enter__(self) -> "JsonLines":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        pass


class VideoOutput:
    """The overlay video, drawn on depth if the tracker segments depth or there is no color.

    Several targets are drawn on the color, or on the depth without it.

    rig: the stereo rig, if the tracker knows it; then the disparity is shown, or the target's mask if the
    tracker has one. assumed: whether its camera is only assumed, which each picture then says. length: the
    number of frames from the frame ``first`` on; a strip for each target shows when it was tracked, occluded
    and lost. trail: seconds over which the targets' paths are drawn, None for no paths.
    """

    def __init__(
        self,
        path: Path,
        fps: float,
        rig: StereoRig | None = None,
        assumed: bool = False,
        length: int | None = None,
        trail: float | None = None,
        first: int = 0,
    ) -> None:
        self._fps, self._trail, self._trails = fps, trail, dict[int, Trail]()
        self._first, self._length, self._strips = first, length, dict[int, StatusStrip]()
        self._assumed = "   assumed camera" if assumed else ""
        self._writer = OverlayWriter(path, fps)
        self._rig = rig
        self._range: tuple[float, float] | None = None

    @property
    def path(self) -> Path:
        return self._writer.path

    @property
    def about(self) -> str:
        """The file's name, and a note if there is one."""
        return self._writer.about

    def write(self, step: Step) -> None:
        speed = f"   {1 / step.seconds:,.0f} frames/s" if step.number and step.seconds else ""
        picture = self._picture(step, f"frame {step.number}{speed}{self._assumed}")
        if self._trail is not None:
            self._draw_trails(picture, step, self._trail)
        for line, (target, track) in enumerate(step.targets.items()):
            strip = self._strips.setdefault(target, StatusStrip(self._length, step.number - self._first))
            strip.add(track.status)
            strip.draw(picture, line)
        self._writer.write(picture, step.time(self._fps))

    def _draw_trails(self, picture: Image, step: Step, seconds: float) -> None:
        image = step.frame.depth if step.frame.color is None else step.frame.color
        assert image is not None  # a frame has one of the two
        for target, track in step.targets.items():
            trail = self._trails.setdefault(target, Trail(seconds))
            trail.add(step.time(self._fps), track)
            trail.draw(picture, choose_scale(*image.shape[:2]), target_color(target))

    def _picture(self, step: Step, note: str) -> Image:
        color, depth = step.frame.color, step.frame.depth
        if step.tracks is not None:
            return targets_overlay(self._image(step.frame), step.tracks, note=note)
        if step.mask is not None:
            return flow_depth_overlay(self._image(step.frame), step.track, step.mask, step.blocks, note=note)
        if depth is not None and (color is None or step.objects is not None):
            near, far = self._smoothed_range(depth)
            return depth_overlay(
                depth,
                step.track,
                particles=step.particles,
                objects=step.objects or (),
                note=note,
                near=near,
                far=far,
            )
        if self._rig is not None and step.frame.right is not None:
            return stereo_overlay(step.frame, step.track, self._rig, note=note)
        assert color is not None  # a frame has one of the two
        return overlay(color, step.track, particles=step.particles, note=note)

    def _image(self, frame: Frame) -> NDArray[np.uint8]:
        """The color, or a picture of the depth without it."""
        if frame.color is not None:
            return frame.color
        assert frame.depth is not None  # a frame has one of the two
        return depth_picture(frame.depth, *self._smoothed_range(frame.depth))

    def _smoothed_range(self, depth: NDArray[np.float32]) -> tuple[float, float]:
        """The displayed depth range, meters; it follows the frames' range slowly to avoid flicker."""
        now = depth_range(depth) or self._range or (0.0, 1.0)
        before = self._range or now
        near, far = (b + RANGE_SMOOTHING * (n - b) for b, n in zip(before, now, strict=True))
        self._range = near, far
        return self._range

    def __enter__(self) -> "VideoOutput":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        self._writer.close()
