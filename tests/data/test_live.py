# SPDX-License-Identifier: MIT
import re
import subprocess
import sys
import threading
import time
from itertools import takewhile
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tricue
from numpy.typing import NDArray
from tricue.cli.program import main
from tricue.data import open_source as opening
from tricue.data.capture import Capture, is_capture, is_file_url
from tricue.data.joint import Moment
from tricue.data.live import Live, Patience
from tricue.data.source import Source
from tricue.doctor.install import install_extra

from tests.data.mjpeg_server import SIZE, MjpegServer, mjpeg_server

BRIEF = Patience(start=5.0, first_wait=0.05, longest_wait=0.2, silence=3.0)


@pytest.fixture
def brief(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sources that lose patience soon."""
    monkeypatch.setattr(opening, "Live", lambda device: Live(device, BRIEF))


class Counter:
    """A device whose images count; it stops after some, stays away a few times, and then never stops.

    permits: how many images it may give, for tests that say when; None for all.
    """

    remote = True
    fps: float | None = 100.0
    camera = None

    def __init__(
        self,
        count: int = 10**6,
        period: float = 0.0,
        refusals: int = 0,
        permits: threading.Semaphore | None = None,
    ) -> None:
        self.name, self.count, self.period, self.refusals = "counter", count, period, refusals
        self.permits = permits
        self.opened: list[float] = []
        self.number = self.left = 0

    def open(self) -> None:
        self.opened.append(time.monotonic())
        if len(self.opened) == 1:
            self.left = self.count
        elif self.refusals:
            self.refusals -= 1
            raise OSError("it isn't there")
        else:
            self.left = 10**6

    def read(self) -> dict[str, NDArray[Any]] | None:
        time.sleep(self.period)
        if self.left == 0 or (self.permits is not None and not self.permits.acquire(timeout=5)):
            return None
        self.left -= 1
        self.number += 1
        image = np.zeros((4, 6, 3), np.uint8)
        image[..., 0], image[..., 1] = self.number % 256, self.number // 256
        return {"color": image}

    def close(self) -> None:
        self.left = 0


def number_of(moment: Moment) -> int:
    """The number of the image that a counter gave."""
    low, high, _ = moment["color"][1][0, 0].tolist()
    return int(low + 256 * high)


def test_the_newest_frame_is_given() -> None:
    """It proves that a slow reader gets no image older than when it asks, and that the others are counted."""
    device = Counter(period=0.002)
    live = Live(device, BRIEF)
    assert live.size("color") == (6, 4)
    moments, numbers = live.moments(["color"]), []
    for _ in range(8):
        before = device.number
        moment = next(moments)
        numbers.append(number_of(moment))
        assert numbers[-1] >= before - 1  # the last one may not be handed over yet
        assert 0 <= moment["color"][0] <= time.monotonic() - live._begin
        time.sleep(0.05)
    moments.close()  # type: ignore[attr-defined]
    assert numbers == sorted(set(numbers))
    (remark,) = live.remarks
    dropped = int(remark.split("dropped ")[1].split()[0])
    assert dropped >= numbers[-1] - numbers[0] - 8
    assert dropped > 30


def test_a_fast_reader_gets_every_frame_once() -> None:
    """It proves that no image is given twice, and that nothing is dropped while the reader waits for each."""
    permits = threading.Semaphore(1)
    live = Live(Counter(permits=permits), BRIEF)
    found = []
    for moment in live.moments(["color"]):
        found.append(number_of(moment))
        if len(found) == 20:
            break
        permits.release()
    assert found == list(range(1, 21))
    assert live.remarks == ()


def test_waits_grow() -> None:
    """It proves that a lost stream is tried again after growing waits, which is told once, and counted."""
    device = Counter(count=3, period=0.005, refusals=3)
    live = Live(device, BRIEF)
    frames = live.moments(["color"])
    with pytest.warns(UserWarning, match="counter: it stopped giving frames; connecting again") as told:
        list(takewhile(lambda _: device.number < 5, frames))
    assert len(told) == 1
    frames.close()  # type: ignore[attr-defined]
    waits = np.diff(device.opened)[:4]
    assert (waits >= [0.05, 0.1, 0.2, 0.2]).all()
    (remark,) = [each for each in live.remarks if "connected" in each]
    connected = re.fullmatch(r"counter: connected again once, after (.+) s without images", remark)
    assert connected
    assert 0.5 <= float(connected[1]) < BRIEF.silence


def test_a_stream_that_stays_away() -> None:
    """It proves that after a long silence the reading ends, with an error of one line."""
    live = Live(Counter(count=1, refusals=10**6), BRIEF._replace(silence=0.4))
    with (
        pytest.warns(UserWarning, match="connecting again"),
        pytest.raises(OSError, match=r"^counter: no image for 0\.4 s; the stream has ended$"),
    ):
        list(live.moments(["color"]))


def test_the_thread_ends_with_its_reader() -> None:
    """It proves that leaving the loop ends the thread, and that another loop begins anew."""
    device = Counter(period=0.001)
    live = Live(device, BRIEF)
    for _ in range(2):
        frames = live.moments(["color"])
        next(frames)
        frames.close()  # type: ignore[attr-defined]
        assert live._thread is not None
        live._thread.join(2)
        assert not live._thread.is_alive()
    assert len(device.opened) == 2


def read_over_an_outage(source: Source, server: MjpegServer) -> tuple[list[float], int]:
    """The times of the frames up to the first one after an outage, and that one's level."""
    times: list[float] = []
    for frame in source:
        assert frame.timestamp is not None
        assert frame.color is not None
        times.append(frame.timestamp)
        if len(times) == 5:
            server.stop()
            threading.Timer(0.3, server.start).start()
        if any("connected again" in remark for remark in source.remarks):
            return times, int(frame.color.mean())
    raise AssertionError("the stream ended")


def test_http_that_stops_and_comes_back(brief: None) -> None:
    """It proves that a camera in the network is read by its newest images, and read again after an outage."""
    with mjpeg_server() as server:
        source = tricue.open_source(server.url)
        assert (source.size, source.format, source.length) == (SIZE, "stream", None)
        with pytest.warns(UserWarning, match="connecting again"):
            times, level = read_over_an_outage(source, server)
        assert abs(level - server.level()) <= 20  # at most a second old
        assert times == sorted(times)
    assert any("connected again once" in remark for remark in source.remarks)
    health = source.channels["color"].joint.health
    assert (health.reopened, health.trouble) == (1, "")
    assert health.silence > 0.2


def test_closing_ends_the_iteration(brief: None) -> None:
    """It proves that a reader that waits for a frame is let go when another thread closes the stream."""
    with mjpeg_server() as server:
        source = tricue.open_source(server.url)
        frames = iter(source)
        next(frames)
        live = source.channels["color"].joint
        threading.Timer(0.2, live.close).start()
        for _ in frames:  # which would raise an error after three seconds of silence
            pass
        assert live.health.trouble == ""


def test_a_with_statement_releases_the_camera(brief: None) -> None:
    """It proves that health is known while it reads, that nothing is read after the with statement, and that
    another loop opens the camera again.
    """
    with mjpeg_server() as server:
        with tricue.open_source(server.url) as source:
            live = source.channels["color"].joint
            frames = iter(source)
            next(frames)
            time.sleep(0.2)
            assert source.health is not None
            assert source.health.dropped > 0
            assert source.health[1:] == (0, 0.0, "")
        assert not live._thread.is_alive()
        assert len(list(frames)) <= 1  # what had been read before
        assert next(iter(source)).color is not None


@pytest.mark.parametrize("wrong", [{"right": "97"}, {"fps": 20}])
def test_a_camera_is_released_after_an_error(wrong: dict[str, Any]) -> None:
    """It proves that no thread reads on if opening fails after the camera was opened."""
    with mjpeg_server() as server:
        with pytest.raises((OSError, ValueError), match=r"97|fps"):
            tricue.open_source(server.url, **wrong)
        assert server.url not in [thread.name for thread in threading.enumerate()]


def test_a_limit_of_waiting() -> None:
    """It proves that a loop ends soon after the images do, and that the next one waits for them."""
    with mjpeg_server() as server, tricue.open_source(server.url, timeout=0.3) as source:
        frames = iter(source)
        next(frames)
        server.stop()
        stopped = time.monotonic()
        with (
            pytest.warns(UserWarning, match="connecting again"),
            pytest.raises(TimeoutError, match=r"no image for 0\.3 s"),
        ):
            list(frames)
        assert 0.3 < time.monotonic() - stopped < 3
        threading.Timer(1.0, server.start).start()
        with pytest.warns(UserWarning, match="connecting again"):
            assert next(iter(source)).color is not None


def test_a_limit_where_none_belongs(tmp_path: Path) -> None:
    """It proves that a recording, which is never waited for, takes no limit and has no health."""
    cv2.imwrite(str(tmp_path / "0.png"), np.zeros((4, 6, 3), np.uint8))
    with tricue.open_source(tmp_path) as source:
        assert source.health is None
    assert len(list(source)) == 1
    with pytest.raises(ValueError, match="timeout: expected with a live camera, got"):
        tricue.open_source(tmp_path, timeout=1)
    with pytest.raises(ValueError, match="timeout: expected seconds above 0, got 0"):
        tricue.open_source("97", timeout=0)


def test_a_process_that_ends_while_it_reads() -> None:
    """It proves that Python ends in order while a thread is reading, even in the middle of a frame."""
    code = "import sys, tricue; frames = iter(tricue.open_source(sys.argv[1])); next(frames); next(frames)"
    with mjpeg_server() as server:
        for _ in range(3):
            done = subprocess.run(
                [sys.executable, "-c", code, server.url],
                capture_output=True,
                text=True,
                timeout=60,
                check=False,
            )
            assert (done.returncode, "FATAL" in done.stderr) == (0, False)


def test_http_tracked_from_the_command_line(
    brief: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that tricue track takes a URL, and tells at the end how many frames it dropped."""
    import tricue.cli.track as command

    def ended_soon(source: Any) -> Any:
        """The first frames, slowly read."""
        for number, frame in enumerate(source):
            if number == 6:
                return
            time.sleep(0.1)
            yield frame

    monkeypatch.setattr(command, "islice", lambda source, *_: ended_soon(source))
    with mjpeg_server() as server:
        assert main(["track", server.url, "--tracker", "color-particle", "--box", "9,9,20,20"]) == 0
    said = capsys.readouterr().out
    assert "6 frames" in said
    assert f"{server.url}: dropped " in said


def test_an_address_without_a_stream(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a stream that never starts is an error of one line after the time limit."""
    with mjpeg_server() as server:
        url = server.url.replace("//", "//user:secret@")
    begin = time.monotonic()
    with pytest.raises(
        OSError, match=r"^http://127[^@]*: no image within 0.6 s \(it can't be opened\); is it on"
    ):
        Live(Capture(url), BRIEF._replace(start=0.6))
    assert 0.5 < time.monotonic() - begin < 5


@pytest.mark.parametrize(
    ("place", "live", "file"),
    [
        ("0", True, False),
        ("/dev/video2", True, False),
        ("rtsp://camera/stream", True, False),
        ("http://camera:8080/video.cgi?x=1", True, False),
        ("https://host/clip.mp4?token=1", False, True),
        ("udp://@:1234", True, False),
        ("tcp://host:9", True, False),
        ("clip.mp4", False, False),
        ("ftp://host/clip.mp4", False, False),
    ],
)
def test_what_is_live(place: str, live: bool, file: bool) -> None:
    """It proves which places are cameras, and which URLs are files that are read from start to end."""
    assert (is_capture(place), is_file_url(place)) == (live, file)


@pytest.mark.parametrize(
    ("url", "shown"),
    [
        ("rtsp://host/x", "rtsp://host/x"),
        ("rtsp://user:secret@host:554/x?a=1", "rtsp://host:554/x?a=1"),
        ("rtsp://user:se@cr@et@host/x", "rtsp://host/x"),
        ("http://user:secret@host?at=@9", "http://host?at=@9"),
        ("http://host/@me//a@b/video.cgi", "http://host/@me//a@b/video.cgi"),
        ("udp://@:1234", "udp://:1234"),
    ],
)
def test_passwords_are_hidden(url: str, shown: str) -> None:
    """It proves that a URL's name lacks user and password, whatever these hold, and nothing else."""
    assert Capture(url).name == shown


class Unplugged:
    """A cv2.VideoCapture that gives two images once, and then can't be opened any more."""

    opened = 0

    def __init__(self, _number: int) -> None:
        Unplugged.opened += 1
        self.left = 2 if Unplugged.opened == 1 else 0

    def isOpened(self) -> bool:  # noqa: N802 (as cv2 names it)
        return self.left > 0

    def get(self, _property: int) -> float:
        return 0.0

    def read(self) -> tuple[bool, object]:
        time.sleep(0.05)
        self.left -= 1
        return (True, np.zeros((4, 6, 3), np.uint8)) if self.left >= 0 else (False, None)

    def release(self) -> None:
        self.left = 0


def test_an_unplugged_camera(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a camera that is unplugged is tried again, and then an error with its number."""
    monkeypatch.setattr(cv2, "VideoCapture", Unplugged)
    monkeypatch.setattr(Unplugged, "opened", 0)
    live = Live(Capture("3"), BRIEF._replace(silence=0.5))
    with (
        pytest.warns(UserWarning, match="camera 3: it stopped giving frames; connecting again"),
        pytest.raises(OSError, match="camera 3: no image for"),
    ):
        list(live.moments(["color"]))
    assert Unplugged.opened > 2


def test_an_absent_camera_is_named() -> None:
    """It proves that a camera that can't be opened is an error with its number, at once."""
    with pytest.raises(OSError, match="camera 97: can't be opened; is it plugged in"):
        tricue.open_source("97")


@pytest.mark.parametrize(
    ("place", "package", "extra"), [("realsense:", "pyrealsense2", "realsense"), ("oak:", "depthai", "oak")]
)
def test_a_missing_package_is_named(
    monkeypatch: pytest.MonkeyPatch, place: str, package: str, extra: str
) -> None:
    """It proves that without the camera's library the error says what to install."""
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=re.escape(f"the package {package}: {install_extra(extra)}")):
        tricue.open_source(place)


def test_a_device_that_fails_in_its_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an error that isn't a matter of connection reaches the reader at once."""
    device = Counter()
    monkeypatch.setattr(device, "read", lambda: {}["color"])
    with pytest.raises(KeyError, match="color"):
        Live(device, BRIEF)


def stuck() -> None:
    """A device that can't be closed."""
    raise RuntimeError("it can't be closed")


def test_a_device_that_fails_when_it_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an error of closing the device reaches the reader at once, not as a long silence."""
    device = Counter(count=2, period=0.01)
    monkeypatch.setattr(device, "close", stuck)
    live = Live(device, BRIEF)
    with pytest.raises(RuntimeError, match="it can't be closed"):
        list(live.moments(["color"]))


def test_the_first_error_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a device that fails, and then can't be closed, is told by what failed first."""
    device = Counter()
    monkeypatch.setattr(device, "read", lambda: {}["color"])
    monkeypatch.setattr(device, "close", stuck)
    with pytest.raises(KeyError, match="color"):
        Live(device, BRIEF)
