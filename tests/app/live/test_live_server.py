# SPDX-License-Identifier: MIT
"""The server of a camera: its own page alone, commands in one line, pictures and tracks as they come."""

import json
from collections.abc import Iterator
from typing import Any

import cv2
import numpy as np
import pytest
from starlette.testclient import TestClient
from tricue.app.live.server import LiveServing, make_live_app

from tests.app.conftest import HOST, START, do, live
from tests.app.live.conftest import IMAGES, Studio, level, wait


@pytest.fixture
def client(studio: Studio) -> Iterator[TestClient]:
    """A browser that knows the token."""
    serving = LiveServing(studio.session)
    with TestClient(make_live_app(serving), f"{HOST}/{serving.token}/") as client:
        yield client


def test_only_its_own_page_is_served(client: TestClient, studio: Studio) -> None:
    """Without the token nothing is served; with it the page of a camera is."""
    assert "live.js" in client.get("").text
    assert client.get("page/live.js").status_code == 200
    assert TestClient(client.app, HOST).get("/state").status_code == 403
    assert client.get("state", headers={"Origin": "http://evil.example"}).status_code == 403
    assert client.get("state").json()["phase"] == studio.session.phase == "connecting"


def test_pictures_and_tracks_come(client: TestClient, studio: Studio) -> None:
    """A page is told the state, each frame's tracks, and a picture once it has shown the one before."""
    studio.begin()
    do(client, "add", frame=0, box=list(START), tracker="fused")
    numbers, pictures = [], {}
    with live(client) as socket:
        while len(pictures) < 3 or max(pictures) not in numbers:
            message = socket.receive()
            if data := message.get("bytes"):
                number = int(np.frombuffer(data[:4], np.uint32)[0])
                pictures[number] = cv2.imdecode(np.frombuffer(data[4:], np.uint8), cv2.IMREAD_COLOR)
                socket.send_json({"shown": number})
                studio.shows(2)
                continue
            content = json.loads(message["text"])
            if content["type"] == "state" and content["targets"]:
                assert content["targets"][0]["name"] == "Target 1"
            if content["type"] == "tracks":
                numbers += [number for number, _, rows in content["frames"] if "1" in rows]
    assert numbers == sorted(set(numbers))
    for number, picture in pictures.items():
        off = [np.abs(picture.astype(int) - IMAGES[at]).mean() for at in range(30)]
        assert int(np.argmin(off)) == level(number)


def test_a_page_holds_the_frame_in_which_someone_draws(client: TestClient, studio: Studio) -> None:
    """The frame stays until the box is there, or the page is closed."""
    studio.begin()
    number = studio.shows()
    with live(client) as socket:
        socket.send_json({"hold": number})
        wait(lambda: number in studio.session._backlog._held.values())
        socket.send_json({"hold": None})
        wait(lambda: not studio.session._backlog._held)
        socket.send_json({"hold": number})
        wait(lambda: studio.session._backlog._held)
    wait(lambda: not studio.session._backlog._held)


def test_commands(client: TestClient, studio: Studio) -> None:
    """All that a page can have done, and what was recorded as downloads."""
    studio.begin()
    assert do(client, "add", frame=0, box=list(START), tracker="fused") == {"id": 1}
    assert do(client, "rename", target=1, name="Anna") == {}
    assert do(client, "record") == {}
    studio.shows(3)
    assert client.get("recorded/csv").status_code == 404
    assert do(client, "stop-recording") == {}
    assert client.get("state").json()["recorded"][0].startswith("a-camera-")
    assert len(client.get("recorded/csv").text.splitlines()) == 4
    assert client.get("recorded/json").json()["targets"][0]["name"] == "Anna"
    assert client.get("recorded/mp4").content[4:8] == b"ftyp"
    assert client.get("recorded/exe").status_code == 404
    assert do(client, "pause") == {}
    assert client.get("state").json()["phase"] == "paused"
    assert do(client, "go-on") == {}
    assert do(client, "delete", target=1) == {}
    assert client.get("state").json()["targets"] == []


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ({}, "do: expected one of add"),
        ({"do": "select"}, "do: expected one of add"),
        ({"do": "add"}, "missing 3 required positional arguments"),
        ({"do": "add", "frame": 0, "box": [1], "tracker": "fused"}, "box: expected four numbers"),
        ({"do": "delete", "target": [1]}, "target: expected one of"),
        ({"do": "delete", "target": 7}, "target: expected one of"),
    ],
)
def test_bad_command_is_one_line(
    client: TestClient, studio: Studio, command: dict[str, Any], message: str
) -> None:
    """400 with one line, and the camera goes on."""
    studio.begin()
    answer = client.post("do", content=json.dumps(command))
    assert answer.status_code == 400
    assert message in answer.json()["error"]
    studio.shows()


def test_errors_and_outages_are_told(studio: Studio) -> None:
    """What goes wrong in a tracker, and how the camera does, reach the page, in its user's words."""
    serving = LiveServing(studio.session, word="in words: {}".format)
    studio.begin()
    client = TestClient(make_live_app(serving), f"{HOST}/{serving.token}/")
    assert do(client, "delete", target=7)["error"].startswith("in words: target: expected")
    with live(client) as socket:
        studio.session.errors.append("something broke")
        seen: dict[str, Any] = {}
        while not {"error", "health", "state"} <= seen.keys():
            message = socket.receive()
            if message.get("text"):
                content = json.loads(message["text"])
                seen[content["type"]] = content
        assert seen["error"]["error"] == "in words: something broke"
        assert (seen["health"]["dropped"], seen["health"]["trouble"]) == (0, "")
