# SPDX-License-Identifier: MIT
"""Code shared by the local servers: page files, access checks, commands, JPEG pictures, downloads."""

import asyncio
import hmac
import json
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol
from urllib.parse import quote, urlsplit

import cv2
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from tricue.errors import one_line

PAGE = Path(__file__).parent / "page"
PAGE_TYPES = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}
LIVE_WIDTH = 1280  # pixels of pictures during a run; a frame on which the user stays has full resolution
JPEG_QUALITY = {"live": 75, "still": 92}
MAX_COMMAND = 1 << 16  # bytes
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'self'; img-src 'self' blob: data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class Page(Protocol):
    """A page that gets news and reports what it has shown."""

    async def tell(self) -> None: ...

    def hear(self, message: Any) -> None: ...


async def talk(page: Page, socket: WebSocket) -> None:
    """Send a page the news and handle its messages until it is closed; also send an error that ends this."""
    tasks = [asyncio.create_task(page.tell()), asyncio.create_task(_hear(page, socket))]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        error = next((found for task in done if (found := task.exception())), None)
        if isinstance(error, Exception) and not isinstance(error, WebSocketDisconnect):
            with suppress(RuntimeError, WebSocketDisconnect):  # the page was closed meanwhile
                await tell(socket, {"type": "error", "error": one_line(error)})
                await socket.close(1011)
    finally:
        for task in tasks:
            task.cancel()


async def tell(socket: WebSocket, message: Any) -> None:
    """Send a message to a page."""
    await socket.send_text(json.dumps(message))


async def _hear(page: Page, socket: WebSocket) -> None:
    with suppress(WebSocketDisconnect, RuntimeError, ValueError, KeyError, TypeError):
        while True:
            page.hear(await socket.receive_json())


class OwnPagesOnly:
    """Rejects, with status 403, requests without the token and those from other sites' pages."""

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
        origin = headers.get("origin")
        try:
            asked_as, asker = urlsplit(f"//{host}").hostname, urlsplit(origin or "").netloc
        except ValueError:  # one of them is malformed
            asked_as = asker = None
        if asked_as not in ("127.0.0.1", "localhost"):
            return "expected the host 127.0.0.1"
        if origin is not None and asker != host:
            return "expected a request of its own page, this is another site's"
        given = "/" + scope["path"].split("/")[1]
        if not hmac.compare_digest(given.encode(), self.base.encode()):
            return "the address lacks its token; open the whole address that tricue open printed last"
        return ""


def page_of(start: str) -> Callable[[Request], Any]:
    """A route for the page's files. start: the one served at the root."""

    async def page(request: Request) -> Response:
        path = PAGE / request.path_params.get("name", start)
        if path.suffix not in PAGE_TYPES or path.parent != PAGE or not path.is_file():
            return PlainTextResponse("there is no such page\n", 404, HEADERS)
        return FileResponse(path, media_type=PAGE_TYPES[path.suffix], headers=HEADERS)

    return page


def bound(handler: Callable[..., Any], serving: Any) -> Callable[..., Any]:
    """A route for a handler that takes the served state and the request."""

    async def handle(request: Any) -> Any:
        return await handler(serving, request)

    return handle


async def answer(
    request: Request,
    do: Callable[[dict[str, Any]], dict[str, Any] | None],
    word: Callable[[str], str],
) -> Response:
    """A command's result as a JSON object; status 400 with one line of text, put into words, if it fails."""
    try:
        body = await request.body()
        if len(body) > MAX_COMMAND:
            raise ValueError("expected a command, got too many bytes")
        command = json.loads(body)
        if not isinstance(command, dict):
            raise ValueError("expected a command as a JSON object")
        found = await run_in_threadpool(do, command)
    except (OSError, ValueError, TypeError, RuntimeError, ImportError) as error:
        return as_json({"error": word(one_line(error))}, 400)
    return as_json(found or {})


def as_json(content: Any, status: int = 200) -> Response:
    """An answer as ASCII JSON, which file names that aren't UTF-8 can't break."""
    return Response(json.dumps(content, allow_nan=False), status, HEADERS, "application/json")


def jpeg(image: Any, use: str) -> bytes:
    """A BGR image as JPEG. use: "live", smaller and coarser, or "still"."""
    if use == "live" and image.shape[1] > LIVE_WIDTH:
        height = round(image.shape[0] * LIVE_WIDTH / image.shape[1])
        image = cv2.resize(image, (LIVE_WIDTH, height), interpolation=cv2.INTER_AREA)
    done, data = cv2.imencode(".jpg", image, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY[use]))
    if not done:
        raise RuntimeError("the frame can't be encoded as JPEG")
    return data.tobytes()


def attached(name: str) -> dict[str, str]:
    """The headers of a download with this name."""
    return {**HEADERS, "Content-Disposition": f"attachment; filename*=UTF-8''{quote(name, errors='replace')}"}
