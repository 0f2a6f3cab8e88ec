# SPDX-License-Identifier: MIT
"""Serving on 127.0.0.1: ports, one server a project, and what a killed one leaves."""

import asyncio
import errno
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
import urllib.request
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
import tricue.app
from tricue.app import local_server, project_file, serve
from tricue.app.frames import RecordedFrames
from tricue.cli import program
from tricue.data.live import LiveStream
from tricue.data.source import Source
from tricue.doctor.install import install_extra

from tests.app.conftest import START
from tests.data.recordings.written import walk, write_bag1

PATIENCE = 60.0  # seconds that a busy machine may take

HEARING = (
    "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
    "from tricue.cli import main; sys.exit(main())"
)
"""``tricue``, which hears Ctrl-C where these tests run in the background, too."""


class Server:
    """``tricue open`` in a process of its own."""

    def __init__(self, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-c", HEARING, "open", *arguments, "--no-browser"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
        )
        self.lines: list[str] = []
        self.url = ""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.append(line.strip())
            if found := re.search(r"http://\S+", line):
                self.url = found[0]
                break

    def get(self, path: str) -> bytes:
        with urllib.request.urlopen(self.url + path, timeout=PATIENCE) as answer:
            return bytes(answer.read())

    def state(self) -> dict[str, Any]:
        return dict(json.loads(self.get("state")))

    def do(self, name: str, **values: Any) -> None:
        body = json.dumps({"do": name, **values}).encode()
        urllib.request.urlopen(urllib.request.Request(self.url + "do", body), timeout=PATIENCE).close()

    def end(self, number: int = signal.SIGTERM) -> tuple[int, str]:
        """The exit code and what it wrote to stderr."""
        self.process.send_signal(number)
        _, errors = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, errors


@pytest.fixture
def server_of() -> Iterator[Any]:
    """``server_of(video)``: a server, which ends with the test."""
    made: list[Server] = []

    def make(*arguments: str) -> Server:
        made.append(Server(*arguments))
        return made[-1]

    yield make
    for server in made:
        if server.process.poll() is None:
            server.end()
        for stream in (server.process.stdout, server.process.stderr):
            if stream is not None:
                stream.close()


def saved(server: Server) -> None:
    """Wait until the work is in the file."""
    until = time.monotonic() + PATIENCE
    while not server.state()["saved"]:
        assert time.monotonic() < until
        time.sleep(0.02)


def test_killed_server_loses_nothing(video: Path, server_of: Any) -> None:
    """After kill -9 what the page called saved is there, and nothing else is left beside the video."""
    server = server_of(str(video), "--port", "0")
    server.do("add", frame=2, box=list(START), tracker="fused")
    saved(server)
    assert server.end(signal.SIGKILL)[0] == -signal.SIGKILL
    again = server_of(str(video), "--port", "0")
    assert again.state()["targets"] == [
        {"id": 1, "name": "Target 1", "tracker": "fused", "drawn": [2], "untracked": [2]}
    ]
    assert sorted(each.name for each in video.parent.iterdir()) == ["video.mp4", "video.mp4.tricue.json"]


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_ended_server_saves_and_says_little(video: Path, server_of: Any, number: int, code: int) -> None:
    """Ctrl-C and kill end it at once, with the exit codes of other commands and no traceback."""
    server = server_of(str(video), "--port", "0")
    server.do("add", frame=2, box=list(START), tracker="fused")
    found, errors = server.end(number)
    assert found == code
    assert "Traceback" not in errors
    assert '"drawn": {"2"' in video.with_name("video.mp4.tricue.json").read_text()


def test_work_that_is_not_saved_is_told_at_the_end(video: Path, server_of: Any) -> None:
    """Ctrl-C says so, and why, where the project's file isn't its own any more."""
    server = server_of(str(video), "--port", "0")
    server.do("add", frame=2, box=list(START), tracker="fused")
    saved(server)
    with video.with_name("video.mp4.tricue.json").open("a") as file:
        file.write(" ")
    server.do("add", frame=3, box=list(START), tracker="fused")
    _, errors = server.end(signal.SIGINT)
    assert "warning: the last changes are not saved: " in errors
    assert "another program changed it" in errors


def test_project_that_cannot_be_written_is_begun_from(
    video: Path, data_home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The one in the data folder begins with what is beside the recording, once, and that is said."""
    beside = project_file.path_beside(video)
    beside.write_text("the work")
    monkeypatch.setattr(os, "access", lambda _, mode: mode == os.R_OK)
    path = project_file.project_path(video)
    assert path.parent == data_home / "tricue"
    said = serve._begun(path, beside)
    assert said.endswith(f", as it can't be written beside the recording; it starts from {beside}")
    assert path.read_text() == "the work"
    path.write_text("more work")
    assert serve._begun(path, beside).endswith(", as it can't be written beside the recording")
    assert path.read_text() == "more work"


def test_a_home_without_locks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file system that knows no locks is no reason not to open a recording."""
    fcntl = pytest.importorskip("fcntl")

    def no_locks(*_: Any) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", no_locks)
    with (tmp_path / "lock").open("w") as file:
        assert serve._lock(file)


def test_second_server_joins_the_first(video: Path, server_of: Any) -> None:
    """A second tricue open on one project says where it is open, and ends."""
    first = server_of(str(video), "--port", "0")
    second = server_of(str(video), "--port", "0")
    assert second.lines == [f"video.mp4 is open already at {first.url}"]
    assert second.process.wait(PATIENCE) == 0
    other = server_of(shutil.copy(video, video.with_name("other.mp4")), "--port", "0")
    assert other.url != first.url


def test_address_is_for_this_user_alone(video: Path, server_of: Any, data_home: Path) -> None:
    """The file that tells the address, and so the token, can be read by nobody else."""
    server_of(str(video), "--port", "0")
    (lock,) = (data_home / "tricue").glob("*.lock")
    assert lock.stat().st_mode & 0o077 == 0


def test_server_listens_to_this_machine_alone(video: Path, server_of: Any) -> None:
    """The address is 127.0.0.1, and so is the socket's."""
    server = server_of(str(video), "--port", "0")
    assert server.url.startswith("http://127.0.0.1:")
    with local_server.listening(0) as listener:
        assert listener.getsockname()[0] == "127.0.0.1"


def test_port_in_use_is_one_line(video: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A port that was asked for and is in use is an error that says what to do, and all that is said."""
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert program.main(["open", str(video), "--no-browser", "--port", str(port)]) == 2
    told = f"tricue open: --port {port}: the port is in use; give another, or leave it out\n"
    assert capsys.readouterr() == ("", told)


def test_default_port_in_use_is_no_matter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a wish, another page that is open takes another port."""
    with socket.create_server(("127.0.0.1", 0)) as taken:
        monkeypatch.setattr(local_server, "DEFAULT_PORT", taken.getsockname()[1])
        with local_server.listening(None) as listener:
            assert listener.getsockname()[1] != local_server.DEFAULT_PORT


def test_requests_that_last_are_ended_silently(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A command that waits for a slow tracker at the end makes no traceback."""
    monkeypatch.setattr(local_server, "CLOSING_TIME", 0)
    served, asked = local_server.Served(), threading.Event()

    async def endless(scope: Any, receive: Any, send: Any) -> None:
        asked.set()
        await asyncio.sleep(PATIENCE)

    def ask(url: str) -> None:
        with suppress(OSError):
            urllib.request.urlopen(url, timeout=PATIENCE)

    def end() -> None:
        asked.wait(PATIENCE)
        served.finish()

    threads = [threading.Thread(target=end)]

    def announce(url: str) -> None:
        threads.append(threading.Thread(target=ask, args=(url,)))
        for thread in threads:
            thread.start()

    local_server.serve_until_ended(served, endless, 0, False, lambda _: None, announce)
    for thread in threads:
        thread.join()
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("port", ["70000", "-5"])
def test_impossible_port_is_one_line(video: Path, port: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Numbers that are no ports are named, and nothing else is said."""
    assert program.main(["open", str(video), "--no-browser", f"--port={port}"]) == 2
    told = f"tricue open: --port {port}: expected a port from 0 to 65535\n"
    assert capsys.readouterr() == ("", told)


@pytest.mark.parametrize("missing", tricue.app.NEEDED)
def test_missing_extra_is_named(
    missing: str, video: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without a package of the extra, one line says how to get it."""
    monkeypatch.setattr("tricue.app.NEEDED", ("json", f"no_{missing}"))
    assert program.main(["open", str(video)]) == 2
    expected = f"tricue open: tricue open needs no_{missing}: {install_extra('app')}\n"
    assert capsys.readouterr().err == expected


class StandIn(LiveStream):
    """A live channel without a camera."""

    fps, length, timed = 30.0, None, True

    def __init__(self) -> None:
        pass


def test_camera_is_no_recording() -> None:
    """One can't go back in a live camera; what to do instead is said."""
    with pytest.raises(ValueError, match="expected a recording, got a live camera"):
        RecordedFrames(Source("camera 0", {"color": StandIn()}))


def test_a_robots_recording_is_served(tmp_path: Path, server_of: Any) -> None:
    """A bag is opened like a video: its frames, its depth, and a target tracked in it."""
    bag = write_bag1(tmp_path / "a.bag", walk(20, size=(160, 120)))
    server = server_of(str(bag))
    state = server.state()
    assert (state["frames"], state["channels"]) == (20, ["color", "depth"])


def test_select_boxes_returns_what_was_drawn(
    video: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The function behind ``--select`` waits for Done, not for the browser, and leaves no project behind."""
    monkeypatch.setattr("webbrowser.open", lambda _: time.sleep(PATIENCE))
    found: list[Any] = []
    waiting = threading.Thread(
        target=lambda: found.append(tricue.app.select_boxes(video, port=0)), daemon=True
    )
    waiting.start()
    until, text = time.monotonic() + PATIENCE, ""
    while not (url := re.search(r"http://\S+", text)):
        assert time.monotonic() < until
        time.sleep(0.05)
        text += capsys.readouterr().err
    server = object.__new__(Server)
    server.url = url[0]
    server.do("add", frame=4, box=list(START), tracker="fused")
    server.do("select")
    waiting.join(PATIENCE)
    assert found == [[(4, START)]]
    assert [each.name for each in video.parent.iterdir()] == ["video.mp4"]
