# SPDX-License-Identifier: MIT
"""Videos whose frames tell their numbers, a tracker for sessions, and the server as a page uses it."""

import json
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import av
import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from starlette.testclient import TestClient
from tricue import Box
from tricue.app.frames import RecordedFrames
from tricue.app.server import make_app
from tricue.app.serving import Serving
from tricue.app.session import Session
from tricue.data.open_source import open_source
from tricue.track.base import registry

from tests.app.session_runs import Counting

FRAMES, WIDTH, HEIGHT = 60, 160, 120
START = Box(20, 40, 40, 40)
BOX = list(START)  # as a page sends it
HOST = "http://127.0.0.1:8765"
CHROMIUMS = ("chromium", "chromium-browser", "google-chrome")
HIDDEN = range(30, 40)  # frames in which the square of moving() isn't there


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """A headless Chromium; TRICUE_CHROMIUM names another than that on the path."""
    playwright = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install playwright")
    found = os.environ.get("TRICUE_CHROMIUM") or next(filter(None, map(shutil.which, CHROMIUMS)), None)
    if found is None:
        pytest.skip("needs chromium: apt-get install chromium")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield browser
        browser.close()


def moving(count: int = FRAMES) -> list[NDArray[np.uint8]]:
    """A textured square that goes 1 px to the right a frame over dim noise, and is hidden for ten frames."""
    rng = np.random.default_rng(1)
    ground = cv2.resize(rng.integers(20, 60, (30, 40, 3), np.uint8), (WIDTH, HEIGHT))
    square = cv2.resize(rng.integers(90, 255, (6, 6, 3), np.uint8), (40, 40)) // [4, 4, 1]
    frames = []
    for index in range(count):
        image = ground.copy()
        if index not in HIDDEN:
            image[40:80, 20 + index : 60 + index] = square[:, : WIDTH - 20 - index]
        frames.append(image)
    return frames


def write_video(
    path: Path, images: list[NDArray[np.uint8]], codec: str = "libx264", fps: int = 30, **options: str
) -> Path:
    """A video by PyAV; by default H.264 with B-frames and a key frame every 12."""
    with av.open(str(path), "w") as file:
        stream: Any = file.add_stream(codec, rate=fps)
        stream.height, stream.width = images[0].shape[:2]
        stream.pix_fmt = "yuvj420p" if codec == "mjpeg" else "yuv420p"
        stream.options = options or {"g": "12", "bf": "2", "crf": "18", "preset": "veryfast"}
        for image in images:
            file.mux(stream.encode(av.VideoFrame.from_ndarray(image, format="bgr24")))
        file.mux(stream.encode())
    return path


@pytest.fixture(autouse=True)
def data_home(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A data folder of the test's own."""
    folder = tmp_path_factory.mktemp("home")
    monkeypatch.setenv("XDG_DATA_HOME", str(folder))
    return folder


@pytest.fixture(scope="session")
def made_video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The video of moving(), to be copied."""
    return write_video(tmp_path_factory.mktemp("made") / "video.mp4", moving())


@pytest.fixture
def video(made_video: Path, tmp_path: Path) -> Path:
    """A copy of the video, beside which a project may be written."""
    path = tmp_path / "video.mp4"
    path.write_bytes(made_video.read_bytes())
    return path


@pytest.fixture
def session_of() -> Iterator[Callable[..., Session]]:
    """``session_of(video)``: a session, its project beside the video; it ends with the test."""
    made: list[Session] = []

    def make(place: Path, path: Path | None = None, **keywords: Any) -> Session:
        beside = place.with_name(place.name + ".tricue.json")
        made.append(Session(RecordedFrames(open_source(place)), place, path or beside, **keywords))
        return made[-1]

    yield make
    for session in made:
        session.close()


@pytest.fixture
def counting(monkeypatch: pytest.MonkeyPatch) -> type[Counting]:
    """That tracker under the name "counting"."""
    monkeypatch.setitem(registry._BUILT_IN, "counting", f"{Counting.__module__}:Counting")
    for name, value in {"bad": set(), "gate": None, "times": []}.items():
        monkeypatch.setattr(Counting, name, value)
    return Counting


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
