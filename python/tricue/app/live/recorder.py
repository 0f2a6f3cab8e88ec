# SPDX-License-Identifier: MIT
"""Records a live camera's tracks while it runs: tables line by line, and the overlay video."""

import csv
import io
import threading
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from queue import Full, Queue
from typing import Any, NamedTuple

from tricue.app.exports import draw_targets
from tricue.app.project import ProjectTarget
from tricue.camera.frame import Frame
from tricue.draw.video import OverlayWriter
from tricue.errors import one_line
from tricue.export.table import TableForm, columns, row
from tricue.export.text_file import TextFile
from tricue.export.tracks_json import NamedTarget, TracksJson
from tricue.track.base.track import Track

MAX_WAITING = 8  # frames waiting to be drawn; with more, the video shows one for longer
MAX_STILL = 1.0  # seconds for which the video shows one picture at most, even if none comes for longer

Tracks = Sequence[tuple[ProjectTarget, Track]]


class VideoFrame(NamedTuple):
    """A frame for the overlay video."""

    seconds: float
    frame: Frame
    tracks: Tracks


class Recorder:
    """Writes ``stem``.csv, .json and .mp4; what was written survives a killed process.

    about: the JSON's entries about the run. fps: of the video, which shows frames at the times they came; a
    thread draws it. error: why the video can't be written, "" if it can. OSError if a file can't be created.
    """

    def __init__(self, stem: Path, about: dict[str, Any], fps: float, form: TableForm) -> None:
        self.started: float | None = None
        self.latest = 0.0  # seconds, time of the last frame
        self.error = ""
        self._form = form
        self._video = OverlayWriter(stem.with_name(f"{stem.name}.mp4"), fps)
        self._csv = TextFile(stem.with_name(f"{stem.name}.csv"))
        self._json = _JsonFile(stem.with_name(f"{stem.name}.json"), TracksJson(lambda: fps, form))
        self.files = (self._csv.path, self._json.path, self._video.path)
        self._put_rows([columns(form)])
        self._json.begin(about)
        self._waiting: Queue[VideoFrame | None] = Queue(MAX_WAITING)
        self._thread = threading.Thread(target=self._draw, name="recorder", daemon=True)
        self._thread.start()

    @property
    def seconds(self) -> float:
        """The recording's length, seconds."""
        return 0.0 if self.started is None else self.latest - self.started

    def write(self, number: int, seconds: float, frame: Frame, tracks: Tracks) -> None:
        """Write the targets of the next frame. OSError if that fails."""
        self.started = seconds if self.started is None else self.started
        self.latest = seconds
        self._put_rows(row(number, seconds, track, target.id, self._form) for target, track in tracks)
        self._json.add(number, seconds, tracks)
        with suppress(Full):  # the video shows the previous picture for longer
            self._waiting.put_nowait(VideoFrame(seconds, frame, tracks))

    def close(self) -> list[str]:
        """Finish each file, even if another one fails; return why tables failed, a line each."""
        problems = [_finished(table) for table in (self._csv, self._json)]
        self._waiting.put(None)
        self._thread.join()
        return [each for each in problems if each]

    def _put_rows(self, rows: Iterable[Iterable[Any]]) -> None:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(rows)
        self._csv.put(text.getvalue())

    def _draw(self) -> None:
        """The thread's body: draw the video at a constant rate, by the frames' times."""
        written, begin = 0, None
        while (drawn := self._waiting.get()) is not None:
            if self.error:
                continue
            begin = drawn.seconds if begin is None else begin
            due = round((drawn.seconds - begin) * self._video.fps) + 1 - written
            most = max(1, round(MAX_STILL * self._video.fps))
            if due > most:  # leave out a pause
                begin += (due - most) / self._video.fps
            try:
                picture = draw_targets(drawn.frame, drawn.tracks)
                for _ in range(min(due, most)):
                    self._video.write(picture)
                    written += 1
            except Exception as error:
                self.error = one_line(error)
        try:
            self._video.close()
        except Exception as error:
            self.error = self.error or one_line(error)


class _JsonFile(TextFile):
    """A file of the text, which has a frame's rows at once, and at the end the targets."""

    def __init__(self, path: Path, text: TracksJson) -> None:
        super().__init__(path)
        self._text = text
        self._targets: dict[int, NamedTarget] = {}

    def begin(self, about: dict[str, Any]) -> None:
        self.put(self._text.begin(about))

    def add(self, number: int, seconds: float, tracks: Tracks) -> None:
        if text := self._text.add(number, seconds, {target.id: track for target, track in tracks}):
            self.put(text)
        self._targets |= {each.id: NamedTarget(each.id, each.name, each.tracker) for each, _ in tracks}

    def finish(self) -> None:
        self.put(self._text.end(self._targets.values()))


def _finished(table: TextFile) -> str:
    """Finish a file; return why that failed, or ""."""
    try:
        with table:
            return ""
    except OSError as error:
        return one_line(error)
