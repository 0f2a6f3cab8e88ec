# SPDX-License-Identifier: MIT
"""The local server of a camera: its page, commands, recordings, and news over a WebSocket."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp
from starlette.websockets import WebSocket

from tricue.app.exports import picture
from tricue.app.feed import as_row
from tricue.app.live.session import LiveSession, Shown
from tricue.app.local_server import Served
from tricue.app.trackers import default_tracker
from tricue.app.web import OwnPagesOnly, answer, as_json, attached, bound, jpeg, page_of, talk, tell

INTERVAL = 0.04  # seconds between messages to a page


@dataclass
class LiveServing(Served):
    """State shared by the routes. tracker: the default for new targets."""

    session: LiveSession
    tracker: str = ""


def make_live_app(serving: LiveServing) -> ASGIApp:
    """The application: all paths begin with the token, and only pages of this machine may ask."""
    base = f"/{serving.token}"
    routes = [
        Route(f"{base}/", page_of("live.html")),
        Route(f"{base}/page/{{name}}", page_of("live.html")),
        Route(f"{base}/state", bound(_state, serving)),
        Route(f"{base}/do", bound(_do, serving), methods=["POST"]),
        Route(f"{base}/recorded/{{suffix}}", bound(_recorded, serving)),
        WebSocketRoute(f"{base}/live", bound(_tell_page, serving)),
    ]
    return OwnPagesOnly(Starlette(routes=routes), base)


def state(serving: LiveServing) -> dict[str, Any]:
    """What seldom changes: the camera, the targets, whether it is recording."""
    session = serving.session
    known = session.trackers
    return {
        "name": session.name,
        "phase": session.phase,
        "problem": session.problem,
        "size": session.size,
        "channels": [] if session.source is None else list(session.source.channels),
        "fps": 0 if session.source is None else session.source.fps,
        "trackers": known,
        "tracker": serving.tracker or default_tracker(known),
        "folder": str(session.folder),
        "recording": session.recorder is not None,
        "recorded": [path.name for path in session.recorded],
        "targets": [
            {
                "id": each.target.id,
                "name": each.target.name,
                "tracker": each.target.tracker,
                "stopped": each.stopped,
                "drawn": [],
            }
            for each in session.targets
        ],
    }


async def _state(serving: LiveServing, _: Request) -> Response:
    return as_json(state(serving))


async def _do(serving: LiveServing, request: Request) -> Response:
    def do(command: dict[str, Any]) -> dict[str, Any] | None:
        name = command.pop("do", None)
        if name not in COMMANDS:
            raise ValueError(f"do: expected one of {', '.join(COMMANDS)}, got {name!r:.40}")
        return COMMANDS[name](serving.session, **command)

    return await answer(request, do, serving.word)


def _add(session: LiveSession, frame: Any, box: Any, tracker: Any) -> dict[str, Any]:
    return {"id": session.add(frame, box, tracker)}


COMMANDS: dict[str, Callable[..., dict[str, Any] | None]] = {
    "add": _add,
    "draw": LiveSession.draw,
    "delete": LiveSession.delete,
    "rename": LiveSession.rename,
    "tracker": LiveSession.choose_tracker,
    "pause": LiveSession.pause,
    "go-on": LiveSession.go_on,
    "record": LiveSession.record,
    "stop-recording": LiveSession.stop_recording,
    "again": LiveSession.start,
}
"""Functions by command; the values of a command are the function's arguments."""


async def _recorded(serving: LiveServing, request: Request) -> Response:
    suffix = request.path_params["suffix"]
    for path in serving.session.recorded:
        if path.suffix == f".{suffix}" and path.exists():
            return FileResponse(path, headers=attached(path.name))
    return as_json({"error": f"no {suffix} is recorded"}, 404)


async def _tell_page(serving: LiveServing, socket: WebSocket) -> None:
    """Send a page the news until it is closed."""
    page = _Page(serving, socket)
    await socket.accept()
    try:
        await talk(page, socket)
    finally:
        serving.session.hold(page, None)


class _Page:
    """What one page has been sent, so that only news is sent."""

    def __init__(self, serving: LiveServing, socket: WebSocket) -> None:
        self.serving, self.socket = serving, socket
        self.state: dict[str, Any] | None = None
        self.news: Any = None  # the last frame whose tracks were sent
        self.errors = len(serving.session.errors)
        self.health: Any = None
        self.shown, self.sent = True, -1  # whether the last picture was shown, and its frame

    def hear(self, message: Any) -> None:
        """Handle a message: the page has shown a picture, or holds the one in which the user draws."""
        self.shown = self.shown or "shown" in message
        if "hold" in message:
            self.serving.session.hold(self, message["hold"])

    async def tell(self) -> None:
        """Send the news repeatedly."""
        while True:
            await self._tell_state()
            await self._tell_tracks()
            await self._tell_picture()
            await asyncio.sleep(INTERVAL)

    async def _tell_state(self) -> None:
        session = self.serving.session
        now = await run_in_threadpool(state, self.serving)
        if now != self.state:
            self.state = now
            await tell(self.socket, {"type": "state", **now})
        errors, self.errors = session.errors[self.errors :], len(session.errors)
        for error in errors:
            await tell(self.socket, {"type": "error", "error": self.serving.word(error)})
        recorder = session.recorder
        health = {
            **session.health._asdict(),
            "rate": round(session.rate, 1),
            "recorded": None if recorder is None else int(recorder.seconds),
        }
        if health != self.health:
            self.health = health
            await tell(self.socket, {"type": "health", **health})

    async def _tell_tracks(self) -> None:
        recent = list(self.serving.session.recent)
        at = next((at for at, each in enumerate(recent) if each is self.news), -1)
        news = recent[at + 1 :]
        if news:
            self.news = news[-1]
            frames = [(each.number, round(each.seconds, 3), _rows(each)) for each in news]
            await tell(self.socket, {"type": "tracks", "frames": frames})

    async def _tell_picture(self) -> None:
        latest = self.serving.session.latest
        if latest is None or not self.shown or latest[0] == self.sent:
            return
        number, frame = latest
        self.shown, self.sent = False, number
        data = await run_in_threadpool(lambda: jpeg(picture(frame), "live"))
        await self.socket.send_bytes(np.uint32(number).tobytes() + data)


def _rows(shown: Shown) -> dict[int, list[Any]]:
    """The tracks of a frame by target, see :func:`tricue.app.feed.as_row`."""
    return {target: as_row(shown.number, track) for target, track in shown.tracks.items()}
