# SPDX-License-Identifier: MIT
"""The local server of a session: its page, its frames as JPEG, commands, and what is new over a WebSocket."""

import asyncio
import hmac
import json
import math
import secrets
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlsplit

import cv2
import numpy as np
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from tricue.app import project as edits
from tricue.app.exports import EXPORTS, picture
from tricue.app.frames import Recording
from tricue.app.project import Target
from tricue.app.session import Run, Session
from tricue.camera.box import Box, as_box
from tricue.draw.depth_pictures import depth_range
from tricue.errors import one_line
from tricue.track.base.track import Status, Track

PAGE = Path(__file__).parent / "page"
PAGE_TYPES = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}
LIVE_INTERVAL = 0.08  # seconds between what a page is told of a run
LIVE_WIDTH = 1280  # pixels of the pictures of a run; a frame that one stays on is shown whole
JPEG_QUALITY = {"live": 75, "still": 92}
MAX_COMMAND = 1 << 16  # bytes
STATUSES = tuple(Status)
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'self'; img-src 'self' blob: data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


@dataclass
class Serving:
    """What the routes share. boxes: those drawn where only boxes are asked for; finish ends the serving."""

    session: Session
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    tracker: str = ""
    selecting: bool = False
    boxes: list[tuple[int, Box]] = field(default_factory=list)
    notes: tuple[str, ...] = ()
    finish: Callable[[], None] = lambda: None
    folder: Path = field(default_factory=lambda: Path(tempfile.gettempdir()))

    def __post_init__(self) -> None:
        self.frame_lock = threading.Lock()
        known = self.session.trackers
        self.tracker = self.tracker or ("fused" if "fused" in known else next(iter(known), ""))

    @contextmanager
    def recording(self) -> Iterator[Recording]:
        """The recording, for one thread at a time."""
        with self.frame_lock:
            yield self.session.recording

    @cached_property
    def depth_span(self) -> tuple[float, float] | None:
        """The range of depth in five frames of the recording: one for all, so that colors don't flicker."""
        if "depth" not in self.session.recording.source.channels:
            return None
        with self.recording() as recording:
            numbers = sorted({part * (recording.length - 1) // 4 for part in range(5)})
            depths = [recording.frame(number).depth for number in numbers]
        ranges = [span for depth in depths if depth is not None and (span := depth_range(depth))]
        near = min((low for low, _ in ranges), default=0.0)
        return near, max([near + 0.01, *(high for _, high in ranges)])


def make_app(serving: Serving) -> ASGIApp:
    """The application: all of it is below the token, and only for pages of this machine."""
    base = f"/{serving.token}"
    routes = [
        Route(f"{base}/", _page),
        Route(f"{base}/page/{{name}}", _page),
        Route(f"{base}/state", _bound(_state, serving)),
        Route(f"{base}/frame/{{number:int}}.jpg", _bound(_frame, serving)),
        Route(f"{base}/do", _bound(_do, serving), methods=["POST"]),
        Route(f"{base}/export/{{kind}}", _bound(_export, serving)),
        WebSocketRoute(f"{base}/live", _bound(_live, serving)),
    ]
    return OwnPagesOnly(Starlette(routes=routes), base)


class OwnPagesOnly:
    """Refuses, with 403, requests without the token, and those that other sites' pages make."""

    def __init__(self, app: ASGIApp, base: str) -> None:
        self.app, self.base = app, base

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] in ("http", "websocket") and (reason := self._refusal(scope)):
            if scope["type"] == "websocket":
                await receive()
                await send({"type": "websocket.close", "code": 4403, "reason": reason})
                return
            await PlainTextResponse(f"tricue open: {reason}\n", 403, HEADERS)(scope, receive, send)
            return
        await self.app(scope, receive, send)

    def _refusal(self, scope: Scope) -> str:
        headers = {name.decode("latin-1"): value.decode("latin-1") for name, value in scope["headers"]}
        host = headers.get("host", "")
        if urlsplit(f"//{host}").hostname not in ("127.0.0.1", "localhost"):
            return "expected to be asked as 127.0.0.1"
        origin = headers.get("origin")
        if origin is not None and urlsplit(origin).netloc != host:
            return "expected its own page, this is another site's"
        given = "/" + scope["path"].split("/")[1]
        if not hmac.compare_digest(given.encode(), self.base.encode()):
            return "the address lacks its token; open the whole address that tricue open printed last"
        return ""


def _bound(handler: Callable[..., Any], serving: Serving) -> Callable[..., Any]:
    async def handle(request: Any) -> Any:
        return await handler(serving, request)

    return handle


async def _page(request: Request) -> Response:
    path = PAGE / request.path_params.get("name", "index.html")
    if path.suffix not in PAGE_TYPES or path.parent != PAGE or not path.is_file():
        return PlainTextResponse("there is no such page\n", 404, HEADERS)
    return FileResponse(path, media_type=PAGE_TYPES[path.suffix], headers=HEADERS)


async def _state(serving: Serving, _: Request) -> Response:
    return JSONResponse(state(serving), headers=HEADERS)


async def _frame(serving: Serving, request: Request) -> Response:
    number = request.path_params["number"]
    channel = request.query_params.get("channel")
    try:
        jpeg = await run_in_threadpool(_still, serving, number, channel)
    except (OSError, ValueError, RuntimeError) as error:
        return JSONResponse({"error": one_line(error)}, 404, HEADERS)
    return Response(jpeg, media_type="image/jpeg", headers=HEADERS)


def _still(serving: Serving, number: int, channel: str | None) -> bytes:
    serving.session.check_frame(number)
    with serving.recording() as recording:
        frame = recording.frame(number)
    return _jpeg(picture(frame, channel, serving.depth_span), "still")


def _jpeg(image: Any, use: str) -> bytes:
    if use == "live" and image.shape[1] > LIVE_WIDTH:
        height = round(image.shape[0] * LIVE_WIDTH / image.shape[1])
        image = cv2.resize(image, (LIVE_WIDTH, height), interpolation=cv2.INTER_AREA)
    done, data = cv2.imencode(".jpg", image, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY[use]))
    if not done:
        raise RuntimeError("the frame can't be encoded as JPEG")
    return data.tobytes()


async def _do(serving: Serving, request: Request) -> Response:
    try:
        body = await request.body()
        if len(body) > MAX_COMMAND:
            raise ValueError("expected a command, got too much")
        command = json.loads(body)
        if not isinstance(command, dict):
            raise ValueError("expected a command, an object")
        answer = await run_in_threadpool(_command, serving, command)
    except (OSError, ValueError, TypeError, RuntimeError, ImportError) as error:
        return JSONResponse({"error": one_line(error)}, 400, HEADERS)
    return JSONResponse(answer or {}, headers=HEADERS)


def _command(serving: Serving, command: dict[str, Any]) -> dict[str, Any]:
    name = command.pop("do", None)
    if name not in COMMANDS:
        raise ValueError(f"do: expected one of {', '.join(COMMANDS)}, got {name!r:.40}")
    return COMMANDS[name](serving.session if name in OF_SESSION else serving, **command) or {}


def _add(session: Session, frame: Any, box: Any, tracker: Any) -> dict[str, Any]:
    return {"id": session.add(frame, box, tracker)}


def _erase(session: Session, target: Any, frame: Any) -> None:
    session.edit(lambda project: edits.erase_box(project, target, frame))


def _delete(session: Session, target: Any) -> None:
    session.edit(lambda project: edits.delete_target(project, target))


def _rename(session: Session, target: Any, name: Any) -> None:
    session.edit(lambda project: edits.rename_target(project, target, name))


def _track(session: Session, frame: Any, step: Any = 1, targets: Any = None) -> None:
    if step not in (1, -1):
        raise ValueError(f"step: expected 1 or -1, got {step!r:.40}")
    if targets is not None and not isinstance(targets, list):
        raise ValueError(f"targets: expected a list of ids, got {targets!r:.40}")
    session.track(frame, step, targets)


def _keep(session: Session, keep: Any) -> None:
    session.keep_project(bool(keep))


def _video(serving: Serving) -> None:
    serving.session.make_video(serving.folder / f"{serving.session.place.stem}.overlay.mp4")


def _select(serving: Serving) -> None:
    """End the serving with the boxes that were drawn."""
    if not serving.selecting:
        raise ValueError("do: this page isn't asked for boxes alone")
    targets = serving.session.project.targets
    serving.boxes = [(at, as_box(each.drawn[at])) for each in targets for at in sorted(each.drawn)]
    serving.finish()


OF_SESSION: dict[str, Callable[..., dict[str, Any] | None]] = {
    "add": _add,
    "draw": Session.draw,
    "erase": _erase,
    "delete": _delete,
    "rename": _rename,
    "tracker": Session.choose_tracker,
    "track": _track,
    "pause": Session.pause,
    "undo": Session.undo,
    "redo": Session.redo,
    "keep": _keep,
    "cancel-video": Session.cancel_video,
}
COMMANDS = {**OF_SESSION, "video": _video, "select": _select}
"""What a page can have done; the values of a command are the function's arguments."""


async def _export(serving: Serving, request: Request) -> Response:
    kind, name = request.path_params["kind"], serving.session.place.stem
    if kind == "video":
        job = serving.session.job
        if job is None or job.path is None:
            return JSONResponse({"error": "the overlay video isn't written yet"}, 404, HEADERS)
        path = job.path if job.path.exists() else job.path.with_suffix(".webm")
        return FileResponse(path, headers={**HEADERS, **_attached(name + ".overlay" + path.suffix)})
    if kind not in EXPORTS:
        return JSONResponse({"error": f"expected one of {', '.join(EXPORTS)}, got {kind}"}, 404, HEADERS)
    export = EXPORTS[kind]
    text = await run_in_threadpool(lambda: export.write(serving.session.tracked()))
    headers = {**HEADERS, **_attached(name + export.suffix)}
    return Response(text.encode(), media_type=export.media_type, headers=headers)


def _attached(name: str) -> dict[str, str]:
    return {"Content-Disposition": f"attachment; filename*=UTF-8''{quote(name, errors='replace')}"}


async def _live(serving: Serving, socket: WebSocket) -> None:
    await socket.accept()
    page = _Page(serving, socket)
    serving_changes = asyncio.create_task(page.tell())
    try:
        while True:
            page.hear(await socket.receive_json())
    except (WebSocketDisconnect, RuntimeError, ValueError, KeyError, TypeError):
        pass
    finally:
        serving_changes.cancel()


class _Page:
    """What one page has been told, so that it is told only what is new."""

    def __init__(self, serving: Serving, socket: WebSocket) -> None:
        self.serving, self.socket = serving, socket
        self.known: dict[int, Any] = {}  # the tracks of each target
        self.state: dict[str, Any] | None = None
        self.run: Run | None = None
        self.found = 0  # tracks of the run
        self.errors = 0
        self.shown, self.sent = True, -1  # whether the last picture has arrived, and its frame

    def hear(self, message: Any) -> None:
        """The page has shown a picture."""
        self.shown = self.shown or "shown" in message

    async def tell(self) -> None:
        """Tell what is new, again and again."""
        recording = self.serving.session.recording
        times = [round(recording.seconds(number), 4) for number in range(recording.length)]
        await self.socket.send_json({"type": "times", "times": times})
        while True:
            run = self.serving.session.run
            await self._tell_run(run)
            await self._tell_state()
            await asyncio.sleep(LIVE_INTERVAL)

    async def _tell_run(self, run: Run | None) -> None:
        if run is not self.run:
            self.run, self.found, self.sent = run, 0, -1
        if run is None:
            return
        latest = run.latest  # before the tracks, so that its own are among them
        count = len(run.found)
        tracks, self.found = run.tracks(self.found, count), count
        message = {
            "type": "run",
            "frame": run.start if latest is None else latest[0],
            "speed": run.updates / run.seconds if run.seconds else 0,
            "tracks": {number: _rows(found) for number, found in tracks.items()},
        }
        await self.socket.send_json(message)
        if latest is not None and self.shown and latest[0] != self.sent:
            number, frame = latest
            self.shown, self.sent = False, number
            jpeg = await run_in_threadpool(
                lambda: _jpeg(picture(frame, None, self.serving.depth_span), "live")
            )
            await self.socket.send_bytes(np.uint32(number).tobytes() + jpeg)

    async def _tell_state(self) -> None:
        session = self.serving.session
        now = await run_in_threadpool(state, self.serving)
        if now != self.state:
            self.state = now
            await self.socket.send_json({"type": "state", **now})
        present = session.history.present.targets if session.run is None else ()
        for target in present:
            if self.known.get(target.id) is not target.tracks:
                self.known[target.id] = target.tracks
                rows = _rows(target.tracks)
                await self.socket.send_json({"type": "tracks", "target": target.id, "tracks": rows})
        errors = session.errors[self.errors :]
        self.errors += len(errors)
        for error in errors:
            await self.socket.send_json({"type": "error", "error": error})


def state(serving: Serving) -> dict[str, Any]:
    """All that a page shows but tracks: the recording, the targets, the run, what can be done."""
    session = serving.session
    recording, history, run, job = session.recording, session.history, session.run, session.job
    source, last = recording.source, session.last_run
    return {
        "name": session.place.name,
        "frames": recording.length,
        "fps": source.fps,
        "size": recording.size,
        "channels": list(source.channels),
        "trackers": session.trackers,
        "tracker": serving.tracker,
        "selecting": serving.selecting,
        "notes": list(serving.notes),
        "file": None if session.path is None else str(session.path),
        "beside": session.path is not None and session.path.parent == session.place.parent,
        "saved": session.saved,
        "changed_video": session.changed_video,
        "undo": bool(history.past),
        "redo": bool(history.future),
        "run": None if run is None else {"step": run.step, "targets": list(run.followed)},
        "ended": None
        if last is None
        else {"run": session.runs, "frame": last.reached, "targets": list(last.followed)},
        "version": session.version,
        "video": None
        if job is None
        else {"written": job.written, "total": job.total, "done": job.path is not None, "error": job.error},
        "targets": [_told(target) for target in history.present.targets],
    }


def _told(target: Target) -> dict[str, Any]:
    drawn = sorted(target.drawn)
    return {"id": target.id, "name": target.name, "tracker": target.tracker, "drawn": drawn}


def _rows(tracks: Mapping[int, Track]) -> list[list[Any]]:
    """Frame, number of the status, score, box, and, where known, position in meters or depth."""
    return [_row(at, track) for at, track in tracks.items()]


def _row(at: int, track: Track) -> list[Any]:
    values: list[Any] = [at, STATUSES.index(track.status), round(track.score, 3)]
    values += [round(number, 2) for number in track.box]
    if track.position is not None:
        values += [round(number, 3) for number in track.position.tolist()]
    elif track.depth is not None and math.isfinite(track.depth):
        values += [None, None, round(track.depth, 3)]
    return values
