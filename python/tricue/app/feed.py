# SPDX-License-Identifier: MIT
"""Sends pages the news of a session over WebSockets: the state, tracks, pictures of a run, errors."""

import asyncio
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from starlette.concurrency import run_in_threadpool
from starlette.websockets import WebSocket

from tricue.app.frames import RecordedFrames
from tricue.app.project import ProjectTarget
from tricue.app.runs import TrackingRun
from tricue.app.serving import Serving
from tricue.app.web import jpeg, talk, tell
from tricue.track.base.track import Status, Track

LIVE_INTERVAL = 0.08  # seconds between messages about a run
STATUSES = tuple(Status)


async def tell_page(serving: Serving, socket: WebSocket) -> None:
    """Send a page the news until it is closed."""
    page = _Page(serving, socket)
    await socket.accept()
    await talk(page, socket)


class _Page:
    """What one page has been sent, so that only news is sent."""

    def __init__(self, serving: Serving, socket: WebSocket) -> None:
        self.serving, self.socket = serving, socket
        self.known: dict[int, Any] = {}  # the tracks of each target that were sent
        self.state: dict[str, Any] | None = None
        self.run: TrackingRun | None = None
        self.found = 0  # how many of the run's tracks were sent
        self.mixed: set[int] = set()  # targets with some of the run's tracks sent
        self.errors = len(serving.session.errors)
        self.shown, self.sent = True, -1  # whether the last picture was shown, and its frame

    def hear(self, message: Any) -> None:
        """The page has shown a picture."""
        self.shown = self.shown or "shown" in message

    async def tell(self) -> None:
        """Send the news repeatedly."""
        times = await run_in_threadpool(_times, self.serving.session.recording)
        await tell(self.socket, {"type": "times", "times": times})
        await self._tell_state(await run_in_threadpool(state, self.serving))
        while True:
            now = await run_in_threadpool(state, self.serving)  # before the tracks, which then have all of it
            await self._tell_tracks()
            await self._tell_run(self.serving.session.run)
            await self._tell_state(now)
            await self._tell_errors()
            await asyncio.sleep(LIVE_INTERVAL)

    async def _tell_run(self, run: TrackingRun | None) -> None:
        if run is not self.run:
            self.run, self.found, self.sent = run, 0, -1
        if run is None:
            return
        latest = run.latest  # before the tracks, so that they include its own
        count = len(run.found)
        tracks, self.found = run.tracks(self.found, count), count
        self.mixed |= tracks.keys()
        message = {
            "type": "run",
            "frame": run.start if latest is None else latest[0],
            "speed": run.updates / run.seconds if run.seconds else 0,
            "tracks": {number: _rows(found) for number, found in tracks.items()},
        }
        await tell(self.socket, message)
        if latest is not None and self.shown and latest[0] != self.sent:
            number, frame = latest
            self.shown, self.sent = False, number
            data = await run_in_threadpool(lambda: jpeg(self.serving.picture(frame), "live"))
            await self.socket.send_bytes(np.uint32(number).tobytes() + data)

    async def _tell_state(self, now: dict[str, Any]) -> None:
        if now != self.state:
            self.state = now
            await tell(self.socket, {"type": "state", **now})
            there = {each["id"] for each in now["targets"]}  # the page forgets the tracks of all others
            self.known = {number: tracks for number, tracks in self.known.items() if number in there}

    async def _tell_tracks(self) -> None:
        over = self.serving.session.run is not self.run  # and perhaps undone
        for target in self.serving.session.history.present.targets:
            if self.known.get(target.id) is not target.tracks or (over and target.id in self.mixed):
                self.known[target.id] = target.tracks
                self.mixed.discard(target.id)
                rows = await run_in_threadpool(_rows, target.tracks)
                await tell(self.socket, {"type": "tracks", "target": target.id, "tracks": rows})

    async def _tell_errors(self) -> None:
        errors = self.serving.session.errors[self.errors :]
        self.errors += len(errors)
        for error in errors:
            await tell(self.socket, {"type": "error", "error": self.serving.word(error)})


def state(serving: Serving) -> dict[str, Any]:
    """Everything that a page shows except tracks: the recording, targets, the run, possible commands."""
    session = serving.session
    # A run may end meanwhile. Read in this order, it is never reported as both running and ended.
    last, ended = session.last_run, session.runs
    run, recording, history, job = session.run, session.recording, session.history, session.job
    source = recording.source
    return {
        "name": session.place.name,
        "frames": recording.length,
        "fps": recording.fps,
        "size": recording.size,
        "channels": list(source.channels),
        "trackers": session.trackers,
        "tracker": serving.tracker,
        "selecting": serving.selecting,
        "notes": list(serving.notes),
        "file": None if session.path is None else str(session.path),
        "beside": session.path is not None and session.path.parent == session.place.parent,
        "saved": session.saved,
        "unsaved": session.unsaved,
        "changed_video": session.changed_video,
        "undo": bool(history.past),
        "redo": bool(history.future),
        "run": None if run is None else {"step": run.step, "targets": list(run.followed)},
        "ended": None
        if last is None
        else {
            "run": ended,
            "frame": last.reached,
            "step": last.step,
            "targets": list(last.followed),
            "stopped": last.stopped,
        },
        "version": session.version,
        "video": None
        if job is None
        else {"written": job.written, "total": job.total, "done": job.path is not None, "error": job.error},
        "targets": [_as_told(target) for target in history.present.targets],
    }


def _times(recording: RecordedFrames) -> list[float]:
    """The frames' times relative to the first; those of robot recordings are seconds since 1970."""
    begin = recording.seconds(0)
    return [round(recording.seconds(number) - begin, 4) for number in range(recording.length)]


def _as_told(target: ProjectTarget) -> dict[str, Any]:
    return {
        "id": target.id,
        "name": target.name,
        "tracker": target.tracker,
        "drawn": sorted(target.drawn),
        "untracked": sorted(target.untracked),
    }


def _rows(tracks: Mapping[int, Track]) -> list[list[Any]]:
    """Frame, number of the status, score, box, and, where known, position in meters or depth."""
    return [as_row(at, track) for at, track in tracks.items()]


def as_row(at: int, track: Track) -> list[Any]:
    """A track for the page: frame, number of the status, score, box, and, where known, position or depth."""
    values: list[Any] = [at, STATUSES.index(track.status), round(track.score, 3)]
    values += [round(number, 2) for number in track.box]
    if track.position is not None:
        values += [round(number, 3) for number in track.position.tolist()]
    elif track.depth is not None and math.isfinite(track.depth):
        values += [None, None, round(track.depth, 3)]
    return values
