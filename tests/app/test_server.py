# SPDX-License-Identifier: MIT
"""The server: only its own pages are served, and commands do what they say."""

import json
import os
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect
from tricue.app.commands import COMMANDS
from tricue.app.frames import RecordedFrames
from tricue.app.server import make_app
from tricue.app.serving import Serving
from tricue.app.session import Session
from tricue.app.web import PAGE
from tricue.data.open_source import open_source

from tests.app.conftest import BOX, FRAMES, HEIGHT, HOST, START, WIDTH, do, live, moving

PATIENCE = 60.0  # seconds that a busy machine may take


def until_ended(client: TestClient) -> dict[str, Any]:
    """The state once no run is on."""
    until = time.monotonic() + PATIENCE
    while (state := client.get("state").json())["run"]:
        assert time.monotonic() < until
        time.sleep(0.01)
    return dict(state)


@pytest.mark.parametrize(
    "path", ["/", "/state", "/wrong/", "/wrong/state", "/page/app.js", "//state", "/%2e%2e/"]
)
def test_without_token_nothing_is_served(serving: Serving, path: str) -> None:
    """403, and one line that says what to do."""
    answer = TestClient(make_app(serving), HOST).get(path)
    assert answer.status_code == 403
    assert answer.text == (
        "tricue open: the address lacks its token; open the whole address that tricue open printed last\n"
    )


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "evil.example"},
        {"Host": "127.0.0.1.evil.example:8765"},
        {"Origin": "http://evil.example"},
        {"Origin": "http://127.0.0.1:9999"},
        {"Origin": "null"},
        {"Host": "[::1"},
    ],
)
def test_other_sites_are_refused_with_the_token(client: TestClient, headers: dict[str, str]) -> None:
    """Neither another name that leads here nor a page of another origin gets anything, token or not."""
    assert client.get("state", headers=headers).status_code == 403
    assert client.post("do", headers=headers, content='{"do": "undo"}').status_code == 403
    with pytest.raises(WebSocketDisconnect) as caught, live(client, headers=headers):
        pass
    assert caught.value.code == 4403


def test_own_page_is_served(client: TestClient) -> None:
    """With its origin, as browsers send it; nothing may be fetched from elsewhere."""
    answer = client.get("", headers={"Origin": HOST})
    assert answer.status_code == 200
    assert "<title>tricue</title>" in answer.text
    assert "default-src 'self'" in answer.headers["content-security-policy"]
    for path in PAGE.iterdir():
        assert client.get(f"page/{path.name}").content == path.read_bytes()


@pytest.mark.parametrize("name", ["missing.js", "..%2fserver.py", "%2e%2e%2fserver.py", "style.css%00"])
def test_only_the_pages_files_are_served(client: TestClient, name: str) -> None:
    """No other file, whatever the name."""
    assert client.get(f"page/{name}").status_code in (403, 404)


def test_page_fetches_nothing_from_elsewhere() -> None:
    """No address of another host is in the page's files, but that of SVG's names."""
    for path in PAGE.iterdir():
        text = path.read_text(encoding="utf-8").replace("http://www.w3.org/2000/svg", "")
        assert "http:" not in text
        assert "https:" not in text
        assert "@import" not in text


def test_state_tells_of_the_recording(client: TestClient) -> None:
    """What a page needs to begin."""
    state = client.get("state").json()
    assert (state["name"], state["frames"], state["size"]) == ("video.mp4", FRAMES, [WIDTH, HEIGHT])
    assert state["tracker"] == "fused" in state["trackers"]
    assert (state["targets"], state["run"], state["undo"]) == ([], None, False)


def test_frame_is_the_frame(client: TestClient, serving: Serving) -> None:
    """A JPEG of the very frame, near enough to tell it from its neighbors; out of range is 404."""
    picture = cv2.imdecode(np.frombuffer(client.get("frame/7.jpg").content, np.uint8), cv2.IMREAD_COLOR)
    assert picture is not None
    off = [np.abs(picture.astype(int) - serving.session.recording.frame(at).color).mean() for at in (6, 7, 8)]
    assert off[1] == min(off)
    assert off[1] < 3
    answer = client.get("frame/60.jpg")
    assert (answer.status_code, answer.json()) == (
        404,
        {"error": "frame: expected a number from 0 to 59, got 60"},
    )
    assert client.get("frame/7.jpg?channel=depth").json() == {
        "error": "channel: expected one of color, got depth"
    }


def test_draw_track_correct_undo_export(client: TestClient) -> None:
    """From a box to a corrected CSV."""
    assert do(client, "add", frame=0, box=BOX, tracker="fused") == {"id": 1}
    assert do(client, "track", frame=0) == {"left_out": []}
    state = until_ended(client)
    assert (state["ended"]["frame"], state["ended"]["step"], state["undo"]) == (FRAMES - 1, 1, True)
    assert do(client, "draw", target=1, frame=45, box=[65, 40, 40, 40]) == {}
    assert do(client, "track", frame=45, step=-1, targets=[1]) == {"left_out": []}
    ended = until_ended(client)["ended"]
    assert (ended["frame"], ended["stopped"]) == (1, {"1": 0})
    lines = client.get("export/csv").text.splitlines()
    assert len(lines) == 1 + FRAMES
    assert lines[46].startswith("45,1,1.5,tracked,1.0,65.0,40.0")
    do(client, "rename", target=1, name="Anna")
    for _ in range(5):
        do(client, "undo")
    assert client.get("state").json()["targets"] == []
    do(client, "redo")
    assert client.get("state").json()["targets"][0]["name"] == "Target 1"


@pytest.mark.parametrize("kind", ["csv", "json", "mot", "coco"])
def test_exports_are_downloads(client: TestClient, kind: str) -> None:
    """Each has the video's name and its own suffix."""
    do(client, "add", frame=0, box=BOX, tracker="fused")
    answer = client.get(f"export/{kind}")
    assert answer.status_code == 200
    assert answer.headers["content-disposition"].startswith("attachment; filename*=UTF-8''video.")
    assert answer.text


def test_overlay_video_is_a_download(client: TestClient) -> None:
    """It is written on request, and given out once it is whole."""
    do(client, "add", frame=0, box=BOX, tracker="fused")
    assert client.get("export/video").status_code == 404
    do(client, "video")
    until = time.monotonic() + PATIENCE
    while not (job := client.get("state").json()["video"])["done"]:
        assert time.monotonic() < until, job
        time.sleep(0.02)
    answer = client.get("export/video")
    assert answer.content[4:8] == b"ftyp"


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ({}, "do: expected one of add"),
        ({"do": "explode"}, "do: expected one of add"),
        ({"do": "add"}, "missing 3 required positional arguments"),
        ({"do": "add", "frame": 0, "box": [1, 2], "tracker": "fused"}, "box: expected four numbers"),
        ({"do": "add", "frame": -1, "box": BOX, "tracker": "fused"}, "frame: expected a number from 0 to 59"),
        (
            {"do": "add", "frame": True, "box": BOX, "tracker": "fused"},
            "frame: expected a number from 0 to 59",
        ),
        ({"do": "add", "frame": 0, "box": BOX, "tracker": "os:system"}, "tracker: expected one of"),
        ({"do": "draw", "target": 5, "frame": 0, "box": BOX}, "target: expected one of"),
        ({"do": "track", "frame": 0}, "draw one around a target"),
        ({"do": "track", "frame": 0, "step": 2}, "step: expected 1 or -1"),
        ({"do": "track", "frame": 0, "targets": 1}, "targets: expected a list"),
        ({"do": "delete", "target": None}, "target: expected one of"),
        ({"do": "select"}, "wasn't opened to select boxes"),
        ([], "expected a command"),
        ({"do": "rename", "target": "x" * 70000}, "expected a command, got too many bytes"),
    ],
)
def test_bad_command_is_one_line(client: TestClient, command: Any, message: str) -> None:
    """400 with one line, and the server goes on."""
    answer = client.post("do", content=json.dumps(command))
    assert answer.status_code == 400
    assert message in answer.json()["error"]
    assert "\n" not in answer.json()["error"]
    assert client.get("state").status_code == 200


def test_no_json_is_one_line(client: TestClient) -> None:
    """Neither is what can't be read at all."""
    assert client.post("do", content=b"\xff{").status_code == 400


def test_video_that_vanishes_is_told(client: TestClient, video: Path) -> None:
    """Frames not yet opened are 404 with one line; a run is refused."""
    do(client, "add", frame=0, box=BOX, tracker="fused")
    video.unlink()
    assert "there is no such file or folder any more" in do(client, "track", frame=0)["error"]


def test_boxes_alone(video: Path, session_of: Callable[..., Session]) -> None:
    """A page that is asked for boxes gives them by Done: those drawn, with their frames."""
    serving, finished = Serving(session_of(video), selecting=True), []
    serving.finish = lambda: finished.append(True)
    client = TestClient(make_app(serving), f"{HOST}/{serving.token}/")
    do(client, "add", frame=3, box=BOX, tracker="fused")
    do(client, "add", frame=0, box=[1, 2, 3, 4], tracker="fused")
    assert do(client, "select") == {}
    assert finished == [True]
    assert serving.boxes == [(3, START), (0, (1, 2, 3, 4))]


def test_depth_is_shown_in_one_range(tmp_path: Path, session_of: Callable[..., Session]) -> None:
    """Depth is a picture of its own; its colors are those of one range in all frames."""
    for at in range(6):
        depth = np.full((HEIGHT, WIDTH), 1000 + 500 * at, np.uint16)
        depth[:, WIDTH // 2 :] = 2000
        cv2.imwrite(str(tmp_path / f"{at}.png"), depth)
    session = Session(RecordedFrames(open_source(tmp_path, depth_scale=0.001)), tmp_path, None)
    serving = Serving(session)
    assert serving.depth_span == pytest.approx((1.0, 3.5), abs=0.01)
    client = TestClient(make_app(serving), f"{HOST}/{serving.token}/")
    pictures = [
        cv2.imdecode(np.frombuffer(client.get(f"frame/{at}.jpg").content, np.uint8), cv2.IMREAD_COLOR)
        for at in (0, 5)
    ]
    change = np.abs(pictures[0].astype(int) - pictures[1]).max(axis=2)[50]
    assert change[WIDTH - 20] < 6
    assert change[20] > 60
    session.close()


def test_depth_that_cannot_be_read(tmp_path: Path) -> None:
    """One damaged depth image of those that tell the range leaves all others as they are."""
    for at in range(5):
        cv2.imwrite(str(tmp_path / f"{at}.png"), np.full((HEIGHT, WIDTH), 1000 + 500 * at, np.uint16))
    (tmp_path / "4.png").write_bytes((tmp_path / "3.png").read_bytes()[:40])
    opened = RecordedFrames(open_source(tmp_path, depth_scale=0.001))
    serving = Serving(Session(opened, tmp_path, None))
    client = TestClient(make_app(serving), f"{HOST}/{serving.token}/")
    assert [client.get(f"frame/{at}.jpg").status_code for at in range(5)] == [200] * 4 + [404]
    serving.session.close()


def test_folder_of_any_name(tmp_path: Path, session_of: Callable[..., Session]) -> None:
    """A name that is no UTF-8 is told as well as can be; one with a dot is whole in those of exports."""
    folder = tmp_path / os.fsdecode(b"caf\xe9.1")
    folder.mkdir()
    for at, image in enumerate(moving(3)):
        cv2.imwrite(str(tmp_path / "image.png"), image)
        (tmp_path / "image.png").rename(folder / f"{at}.png")
    session = session_of(folder)
    serving = Serving(session)
    client = TestClient(make_app(serving), f"{HOST}/{serving.token}/")
    assert client.get("state").status_code == 200
    assert do(client, "add", frame=0, box=BOX, tracker="fused") == {"id": 1}
    for kind in ("csv", "json"):
        answer = client.get(f"export/{kind}")
        assert answer.headers["content-disposition"].endswith(f"caf%3F.1.{kind}")
    with live(client) as socket:
        assert [socket.receive_json()["type"] for _ in range(2)] == ["times", "state"]
    session.close()
    assert session.unsaved == ""


def test_every_command_is_asked_for_by_the_page() -> None:
    """No command is left of what the page doesn't do any more."""
    text = (PAGE / "app.js").read_text() + (PAGE / "panel.js").read_text()
    assert {name for name in COMMANDS if f'"{name}"' not in text} == set()


def test_a_long_recording_keeps_no_other_request_waiting(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The times of hours of frames take seconds, in which other requests are answered."""
    answered, late = threading.Event(), list[int]()

    def slow(_: RecordedFrames, number: int) -> float:
        if not late and not answered.wait(5):
            late.append(number)
        return number / 30

    monkeypatch.setattr(RecordedFrames, "seconds", slow)
    with live(client):
        assert client.get("state").status_code == 200
        answered.set()
    assert late == []
