# SPDX-License-Identifier: MIT
"""The server: only its own pages are served, commands do what they say, and pages are told what is new."""

import json
import os
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect
from tricue import Status, Track
from tricue.app.commands import COMMANDS
from tricue.app.feed import state
from tricue.app.frames import RecordedFrames
from tricue.app.runs import TrackingRun
from tricue.app.server import make_app
from tricue.app.serving import Serving
from tricue.app.session import Session
from tricue.app.web import PAGE
from tricue.data.open_source import open_source

from tests.app.conftest import FRAMES, HEIGHT, START, WIDTH, moving

HOST = "http://127.0.0.1:8765"
BOX = list(START)
PATIENCE = 60.0  # seconds that a busy machine may take


@pytest.fixture
def serving(video: Path, session_of: Callable[..., Session], tmp_path: Path) -> Serving:
    """A session on the video, to be served."""
    return Serving(session_of(video), folder=tmp_path)


@pytest.fixture
def client(serving: Serving) -> Iterator[TestClient]:
    """A browser that knows the token: addresses are relative to the page."""
    with TestClient(make_app(serving), f"{HOST}/{serving.token}/") as client:
        yield client


def do(client: TestClient, command: str, **values: Any) -> Any:
    """Have the server do something; its answer."""
    return client.post("do", content=json.dumps({"do": command, **values})).json()


def live(client: TestClient, **keywords: Any) -> Any:
    """The page's WebSocket."""
    return client.websocket_connect(str(client.base_url).replace("http:", "ws:") + "live", **keywords)


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


def test_page_is_told_all_of_a_run(client: TestClient) -> None:
    """Over the WebSocket come the state, a run's pictures and tracks, and all tracks in the end."""
    with live(client) as socket:
        first = [socket.receive_json(), socket.receive_json()]
        assert [each["type"] for each in first] == ["times", "state"]
        assert first[0]["times"][30] == pytest.approx(1.0)
        do(client, "add", frame=0, box=BOX, tracker="fused")
        do(client, "track", frame=0)
        pictures, whole, ended = 0, {}, False
        while not ended:
            message = socket.receive()
            if message.get("bytes"):
                assert message["bytes"][4:6] == b"\xff\xd8"
                pictures += 1
                socket.send_json({"shown": 0})
            else:
                content = json.loads(message["text"])
                if content["type"] == "tracks":
                    whole = {row[0]: row for row in content["tracks"]}
                ended = content["type"] == "state" and bool(content["ended"])
        assert len(whole) == FRAMES  # before the page is told that the run has ended
        assert whole[0][1:7] == [0, 1.0, *BOX]
        assert pictures <= FRAMES


def test_a_target_that_comes_back_is_told_with_its_tracks(client: TestClient) -> None:
    """A page forgets the tracks of a target that was deleted; undo brings them back with it."""
    do(client, "add", frame=3, box=BOX, tracker="fused")
    with live(client) as socket:
        assert [socket.receive_json()["type"] for _ in range(3)] == ["times", "state", "tracks"]
        do(client, "delete", target=1)
        while socket.receive_json().get("targets") != []:
            pass  # of what is saved meanwhile
        do(client, "undo")
        told = [socket.receive_json()]
        while not told[-1].get("targets"):
            told.append(socket.receive_json())
        assert [[row[0] for row in each["tracks"]] for each in told if each["type"] == "tracks"] == [[3]]


def test_a_run_that_is_undone_while_it_lasts(client: TestClient, serving: Serving) -> None:
    """A page that was told some of its tracks is told those of before again."""
    do(client, "add", frame=3, box=BOX, tracker="fused")
    with live(client) as socket:
        serving.session.run = TrackingRun(3, 1, (1,), [(1, 4, Track(START, 0.5, Status.TRACKED))])
        while not socket.receive_json().get("run"):
            pass  # what is told before the state with the run, that with its tracks, too
        serving.session.run = None  # as undo does, which ends it first
        told = [socket.receive_json()]
        while told[-1]["type"] != "state" or told[-1]["run"]:
            told.append(socket.receive_json())
        assert [[row[0] for row in each["tracks"]] for each in told if each["type"] == "tracks"] == [[3]]


def test_page_opened_during_a_run(client: TestClient, serving: Serving) -> None:
    """It is told the state, what was tracked before, and then what the run finds; errors of before aren't."""
    do(client, "add", frame=3, box=BOX, tracker="fused")
    serving.session.errors.append("an old one")
    serving.session.run = TrackingRun(10, 1, (1,), [(1, 10, Track(START, 0.5, Status.TRACKED))])
    with live(client) as socket:
        messages = [socket.receive_json() for _ in range(4)]
    serving.session.run = None
    assert [each["type"] for each in messages] == ["times", "state", "tracks", "run"]
    assert [row[0] for row in messages[2]["tracks"]] == [3]
    assert [row[0] for row in messages[3]["tracks"]["1"]] == [10]


def test_a_run_that_ends_while_the_state_is_read(serving: Serving, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is told as on or as ended, never as both: the page would miss its end."""

    class Ending(Session):
        """Its run ends just after it was looked at."""

        @property
        def run(self) -> TrackingRun | None:  # type: ignore[override]
            run, self.__dict__["run"] = self.__dict__["run"], None
            if run is not None:
                self.last_run, self.runs = run, self.runs + 1
            return run

    serving.session.run = TrackingRun(10, 1, (), [])
    monkeypatch.setattr(serving.session, "__class__", Ending)
    first, then = state(serving), state(serving)
    assert first["run"] is not None
    assert first["ended"] is None
    assert then["run"] is None
    assert then["ended"]["run"] == 1


def test_error_in_telling_is_told(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    """A page isn't left waiting for what doesn't come: it hears why, and the connection ends."""

    def broken(_: Serving) -> None:
        raise OSError("no\nstate")

    monkeypatch.setattr("tricue.app.feed.state", broken)
    with live(client) as socket:
        assert socket.receive_json()["type"] == "times"
        assert socket.receive_json() == {"type": "error", "error": "no state"}
        with pytest.raises(WebSocketDisconnect):
            socket.receive_json()


def test_errors_reach_the_page(client: TestClient, serving: Serving) -> None:
    """What goes wrong in a thread is told to the page, once, and in its user's words, as is a bad command."""
    serving.word = "in words: {}".format
    assert do(client, "delete", target=7)["error"].startswith("in words: target: expected")
    with live(client) as socket:
        serving.session.errors.append("something broke")
        seen = []
        while not seen or seen[-1]["type"] != "error":
            seen.append(socket.receive_json())
        assert seen[-1]["error"] == "in words: something broke"


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
