# SPDX-License-Identifier: MIT
"""Exports of a project: tables and annotations as text, and the overlay video."""

import csv
import io
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from tricue.app.frames import RecordedFrames
from tricue.app.project import Project, ProjectTarget
from tricue.arrays import Image
from tricue.camera.frame import Frame
from tricue.data.streams import image_names
from tricue.draw.canvas import choose_scale, to_bgr
from tricue.draw.depth_pictures import depth_picture
from tricue.draw.targets import target_color, targets_overlay
from tricue.draw.trail import Trail
from tricue.export.coco import CocoTracks
from tricue.export.mot import mot_line
from tricue.export.table import TableForm, columns, row
from tricue.export.tracks_json import NamedTarget, TracksJson
from tricue.track.base.track import Track


@dataclass(frozen=True)
class Tracked:
    """The data for exports: the targets' tracks, and the recording that they were tracked in.

    about: the JSON's entries about the run. world: whether the camera's pose is known.
    """

    project: Project
    recording: RecordedFrames
    about: dict[str, Any]
    world: bool = False

    @property
    def form(self) -> TableForm:
        """The form of its tables."""
        return TableForm(self.world, several=True)

    def tracks(self) -> Iterator[tuple[int, ProjectTarget, Track]]:
        """Frame, target and track, sorted by frame and then by id."""
        rows = [(at, target.id) for target in self.project.targets for at in target.tracks]
        by_id = {target.id: target for target in self.project.targets}
        for at, number in sorted(rows):
            yield at, by_id[number], by_id[number].tracks[at]


@dataclass(frozen=True)
class Export:
    """A text format for a project: the ending of the file's name, its media type, and the function."""

    suffix: str
    media_type: str
    write: Callable[[Tracked], str]


def as_csv(tracked: Tracked) -> str:
    """A header and a line per frame and target, see :mod:`tricue.export.table`."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns(tracked.form))
    writer.writerows(_rows(tracked))
    return text.getvalue()


def as_json(tracked: Tracked) -> str:
    """One object, see :class:`tricue.export.tracks_json.TracksJson`."""
    recording, targets = tracked.recording, tracked.project.targets
    text = TracksJson(lambda: recording.fps, tracked.form)
    parts = [text.begin(tracked.about)]
    for at in range(recording.length):
        here = {each.id: each.tracks[at] for each in targets if at in each.tracks}
        parts.append(text.add(at, recording.seconds(at), here))
    parts.append(text.end(NamedTarget(each.id, each.name, each.tracker) for each in targets))
    return "".join(parts)


def as_mot(tracked: Tracked) -> str:
    """MOTChallenge's text, see :func:`tricue.export.mot.mot_line`."""
    return "".join(mot_line(at, target.id, track) for at, target, track in tracked.tracks())


def as_coco(tracked: Tracked) -> str:
    """COCO's JSON, see :class:`tricue.export.coco.CocoTracks`: a category is a target's name."""
    recording, source = tracked.recording, tracked.recording.source
    targets = tracked.project.targets
    found = CocoTracks(source.name, {target.id: target.name for target in targets})
    names = image_names(source.channels)
    for at in range(recording.length):
        tracks = {each.id: each.tracks[at] for each in targets if at in each.tracks}
        size = recording.size if tracks or not names else recording.image_size(at)  # tracks prove the size
        found.add(at, size, tracks, names[at] if names else "")
    return json.dumps(found.content(recording.fps), allow_nan=False, ensure_ascii=False)


EXPORTS = {
    "csv": Export(".csv", "text/csv", as_csv),
    "json": Export(".json", "application/json", as_json),
    "mot": Export(".mot.txt", "text/plain", as_mot),
    "coco": Export(".coco.json", "application/json", as_coco),
}


def write_video(path: Path, tracked: Tracked, progress: Callable[[int], bool], trail: bool = False) -> str:
    """Write the overlay video of all frames; return OverlayWriter's note about the file.

    progress: called with the number of frames written; it returns False to stop. trail: whether to draw the
    targets' trails.
    """
    from tricue.draw.video import OverlayWriter

    recording, trails = tracked.recording, {each.id: Trail() for each in tracked.project.targets if trail}
    with OverlayWriter(path, recording.fps) as writer:
        for number, frame in recording.frames(recording.first, recording.length):
            here = [(each, each.tracks[number]) for each in tracked.project.targets if number in each.tracks]
            for target in tracked.project.targets if trail else ():
                trails[target.id].add(recording.seconds(number), target.tracks.get(number))
            writer.write(draw_targets(frame, here, trails), recording.seconds(number))
            if not progress(number + 1):
                break
    return writer.about


def draw_targets(
    frame: Frame, tracks: Sequence[tuple[ProjectTarget, Track]], trails: Mapping[int, Trail] | None = None
) -> Image:
    """The frame's image, enlarged if it is small, with each target's box and name in its color.

    trails: to draw, by the targets' ids.
    """
    image = picture(frame)
    names = {target.id: target.name for target, _ in tracks}
    canvas = targets_overlay(image, {target.id: track for target, track in tracks}, names=names)
    for number, trail in (trails or {}).items():
        trail.draw(canvas, choose_scale(*image.shape[:2]), target_color(number))
    return canvas


def boxed_channel(frame: Frame) -> str:
    """The channel in whose pixels boxes are."""
    return "depth" if frame.color is None else "color"


def picture(frame: Frame, channel: str | None = None, span: tuple[float, float] | None = None) -> Image:
    """A channel of a frame as BGR; by default the one in whose pixels boxes are.

    span: the depths of the nearest and the farthest color, meters. ValueError for a missing channel.
    """
    name = channel or boxed_channel(frame)
    image: NDArray[Any] | None = getattr(frame, name) if name in ("color", "depth", "right") else None
    if image is None:
        raise ValueError(f"channel: expected one of {', '.join(frame.channels)}, got {name}")
    if name == "depth":
        return depth_picture(image, *(span or (None, None)))
    return to_bgr(image)


def _rows(tracked: Tracked) -> Iterator[list[Any]]:
    for at, target, track in tracked.tracks():
        yield row(at, tracked.recording.seconds(at), track, target.id, tracked.form)
