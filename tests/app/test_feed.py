# SPDX-License-Identifier: MIT
"""What a page is told over its WebSocket: the state, and a run's pictures and tracks."""

import json

import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect
from tricue import Status, Track
from tricue.app.feed import state
from tricue.app.runs import TrackingRun
from tricue.app.serving import Serving
from tricue.app.session import Session

from tests.app.conftest import BOX, FRAMES, START, do, live


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
