# SPDX-License-Identifier: MIT
"""The local server of a session: its page, its frames as JPEG, commands, exports, and news."""

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp

from tricue.app.commands import do
from tricue.app.exports import EXPORTS
from tricue.app.feed import state, tell_page
from tricue.app.serving import Serving
from tricue.app.web import HEADERS, OwnPagesOnly, answer, as_json, attached, bound, jpeg, page_of
from tricue.draw.video import written_path
from tricue.errors import one_line


def make_app(serving: Serving) -> ASGIApp:
    """The application: all paths begin with the token, and only pages of this machine may ask."""
    base = f"/{serving.token}"
    routes = [
        Route(f"{base}/", page_of("index.html")),
        Route(f"{base}/page/{{name}}", page_of("index.html")),
        Route(f"{base}/state", bound(_state, serving)),
        Route(f"{base}/frame/{{number:int}}.jpg", bound(_frame, serving)),
        Route(f"{base}/do", bound(_do, serving), methods=["POST"]),
        Route(f"{base}/export/{{kind}}", bound(_export, serving)),
        WebSocketRoute(f"{base}/live", bound(tell_page, serving)),
    ]
    return OwnPagesOnly(Starlette(routes=routes), base)


async def _state(serving: Serving, _: Request) -> Response:
    return as_json(state(serving))


async def _frame(serving: Serving, request: Request) -> Response:
    number = request.path_params["number"]
    channel = request.query_params.get("channel")
    try:
        data = await run_in_threadpool(_still, serving, number, channel)
    except (OSError, ValueError, RuntimeError) as error:
        return as_json({"error": one_line(error)}, 404)
    return Response(data, media_type="image/jpeg", headers=HEADERS)


def _still(serving: Serving, number: int, channel: str | None) -> bytes:
    serving.session.check_frame(number)
    with serving.recording() as recording:
        frame = recording.frame(number)
    return jpeg(serving.picture(frame, channel), "still")


async def _do(serving: Serving, request: Request) -> Response:
    return await answer(request, lambda command: do(serving, command), serving.word)


async def _export(serving: Serving, request: Request) -> Response:
    kind, place = request.path_params["kind"], serving.session.place
    name = place.name if place.is_dir() else place.stem
    if kind == "video":
        job = serving.session.job
        if job is None or job.path is None:
            return as_json({"error": "the overlay video isn't written yet"}, 404)
        path = written_path(job.path)
        return FileResponse(path, headers=attached(name + ".overlay" + path.suffix))
    if kind not in EXPORTS:
        return as_json({"error": f"expected one of {', '.join(EXPORTS)}, got {kind}"}, 404)
    export = EXPORTS[kind]
    try:
        text = await run_in_threadpool(lambda: export.write(serving.session.tracked()))
    except (OSError, ValueError, RuntimeError) as error:
        return as_json({"error": one_line(error)}, 500)
    content = text.encode(errors="replace")
    return Response(content, media_type=export.media_type, headers=attached(name + export.suffix))
