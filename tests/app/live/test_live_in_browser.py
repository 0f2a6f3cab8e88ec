# SPDX-License-Identifier: MIT
"""A camera in the network, in Chromium: draw while it runs, record, an outage, reload, the end."""

import csv
import io
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import cv2
import pytest

from tests.app.browser.tab import CONTRASTS, NAMELESS, place_in_page
from tests.app.conftest import START
from tests.app.live.conftest import IMAGES, level, wait
from tests.app.test_serve import Server
from tests.data.mjpeg_server import MjpegServer

playwright = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install playwright")
LAPTOP, PHONE = {"width": 1280, "height": 800}, {"width": 390, "height": 844}
PATIENCE = 60_000  # milliseconds that a busy machine may take


class SquareServer(MjpegServer):
    """A camera that sees the square go to the right and back again, slowly."""

    def images(self) -> Iterator[bytes]:
        number = 0
        while not self._stopped.wait(1 / self.fps):
            yield cv2.imencode(".jpg", IMAGES[level(number)], [cv2.IMWRITE_JPEG_QUALITY, 95])[1].tobytes()
            number += 1


@pytest.fixture
def camera() -> Iterator[SquareServer]:
    """The camera, on."""
    server = SquareServer(fps=10.0)
    server.start()
    yield server
    with suppress(OSError):
        server.stop()


@pytest.fixture
def opened(
    camera: SquareServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[..., Any]]:
    """``opened(url)``: ``tricue open`` on it in a folder of the test's own, which ends with the test."""
    monkeypatch.chdir(tmp_path)
    made: list[Server] = []

    def make(url: str = camera.url) -> Server:
        made.append(Server(url, "--port", "0"))
        return made[-1]

    yield make
    for server in made:
        if server.process.poll() is None:
            server.end()
        for stream in (server.process.stdout, server.process.stderr):
            if stream is not None:
                stream.close()


class Tab:
    """A page of a camera, and what a user does in it."""

    def __init__(self, browser: Any, url: str, size: dict[str, int] = LAPTOP) -> None:
        self.page = browser.new_context(viewport=size).new_page()
        self.page.set_default_timeout(PATIENCE)
        self.troubles: list[str] = []
        self.page.on("pageerror", lambda error: self.troubles.append(str(error)))
        self.page.goto(url)

    def ready(self) -> "Tab":
        """Wait for the first picture."""
        self.page.locator("html[data-page]").wait_for(state="attached")
        return self

    def shown(self) -> int:
        """The frame that is shown."""
        return int(self.page.evaluate("document.documentElement.dataset.page").split()[1])

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a pixel of the picture is in the page."""
        return place_in_page(self.page, x, y)

    def draw(self, x: float, y: float, width: float, height: float, pause: int = 0) -> None:
        """Drag a box. pause: milliseconds that it takes."""
        mouse = self.page.mouse
        mouse.move(*self.place(x, y))
        mouse.down()
        mouse.move(*self.place(x + width / 2, y + height / 2))
        self.page.wait_for_timeout(pause)
        mouse.move(*self.place(x + width, y + height))
        mouse.up()

    def follow(self) -> None:
        """Draw the square where it is shown, taking a second, in which it goes on."""
        self.page.keyboard.press("Space")
        self.page.locator("html[data-phase=paused]").wait_for(state="attached")
        self.page.wait_for_timeout(300)
        self.draw(START.x + level(self.shown()), START.y, START.width, START.height, 1000)
        self.page.locator("#targets button", has_text="Target 1").wait_for()
        self.page.keyboard.press("Space")
        self.page.locator("html[data-phase=live]").wait_for(state="attached")


def test_draw_record_and_save(chromium: Any, opened: Callable[..., Any], tmp_path: Path) -> None:
    """From the picture to a CSV of what was followed: the square's box goes to and fro with it."""
    tab = Tab(chromium, opened().url).ready()
    page = tab.page
    page.get_by_text("Drag a box around the target", exact=True).wait_for()
    tab.follow()
    page.keyboard.press("p")
    assert page.locator("#trail").is_checked()
    page.keyboard.press("r")
    page.locator("#recorded-for", has_text="0:02").wait_for()
    page.keyboard.press("r")
    page.locator("#recorded-csv").wait_for()
    with page.expect_download() as download:
        page.click("#recorded-csv")
    rows = list(csv.DictReader(io.StringIO(Path(download.value.path()).read_text())))
    assert len(rows) >= 8
    assert {row["status"] for row in rows} == {"tracked"}
    assert all(abs(float(row["y"]) - START.y) < 4 for row in rows)
    assert {path.suffix for path in tmp_path.iterdir()} == {".csv", ".json", ".mp4"}
    assert tab.troubles == []


def test_drawn_while_it_runs(chromium: Any, opened: Callable[..., Any]) -> None:
    """A press keeps the picture; the box belongs to it, and has caught up when the picture goes on."""
    server = opened()
    tab = Tab(chromium, server.url).ready()
    page = tab.page
    page.mouse.move(*tab.place(2, 2))
    page.mouse.down()  # which keeps the picture
    page.wait_for_timeout(300)
    number = tab.shown()
    page.wait_for_timeout(1200)
    assert tab.shown() == number
    page.mouse.up()
    page.locator("#box summary").click()
    page.locator("#box-x").focus()
    page.wait_for_timeout(300)
    number = tab.shown()
    for name, value in zip("xywh", START._replace(x=START.x + level(number)), strict=True):
        page.fill(f"#box-{name}", f"{value:g}")
    page.wait_for_timeout(800)
    assert tab.shown() == number
    page.route("**/do", lambda route: (time.sleep(2.5), route.continue_()))  # a slow network
    page.click("#box-set")
    page.locator("#targets button", has_text="Target 1").wait_for()
    wait(lambda: tab.shown() > number + 3)
    page.locator("#targets .tracked").wait_for()
    # It was chosen before or after its first tracks came.
    assert page.locator("#said").text_content() in ("Target 1 chosen", "Target 1 chosen, tracked")
    assert tab.troubles == []


def test_reload_and_two_pages(chromium: Any, opened: Callable[..., Any]) -> None:
    """A reloaded page and another one have the targets, by names that were not refused; one removed is gone
    in both.
    """
    server = opened()
    tab = Tab(chromium, server.url).ready()
    tab.follow()
    tab.page.reload()
    tab.ready()
    other = Tab(chromium, server.url, PHONE).ready()
    for page in (tab.page, other.page):
        page.locator("#targets button", has_text="Target 1").click()
    other.page.fill("#target-name", "   ")
    other.page.keyboard.press("Enter")
    other.page.locator("#toasts >> text=name: expected 1 to 80 characters").wait_for()
    other.page.wait_for_timeout(200)
    assert other.page.input_value("#target-name") == "Target 1"
    other.page.click("#delete")
    tab.page.locator("#targets button").wait_for(state="detached")
    assert (tab.troubles, other.troubles) == ([], [])


def test_recording_that_waits_says_so(chromium: Any, opened: Callable[..., Any]) -> None:
    """In a pause, as long as it lasts."""
    tab = Tab(chromium, opened().url).ready()
    tab.follow()
    tab.page.keyboard.press("r")
    tab.page.keyboard.press("Space")
    tab.page.locator("#hint", has_text="Nothing is recorded while paused").wait_for()
    tab.page.keyboard.press("Space")
    tab.page.locator("#hint:empty").wait_for(state="attached")
    assert tab.troubles == []


def test_a_refused_tracker_is_not_shown(chromium: Any, opened: Callable[..., Any]) -> None:
    """The list has the target's tracker again."""
    tab = Tab(chromium, opened().url).ready()
    page = tab.page
    tab.follow()
    page.route("**/do", lambda route: route.fulfill(status=400, json={"error": "no box"}))
    page.select_option("#target-tracker", "color-particle")
    page.locator(".toast", has_text="no box").wait_for()
    page.wait_for_function("document.getElementById('target-tracker').value === 'fused'")
    assert tab.troubles == []


def test_outage_and_end(chromium: Any, opened: Callable[..., Any], camera: SquareServer) -> None:
    """An outage is said while it lasts; the target is followed after it; Ctrl-C ends all in order."""
    server = opened()
    tab = Tab(chromium, server.url).ready()
    camera.stop()
    tab.page.locator("#trouble").wait_for()
    assert "Reconnecting" in tab.page.locator("#trouble").inner_text()
    camera.start()
    tab.page.locator("#trouble").wait_for(state="hidden")
    tab.page.locator("#rate", has_text="reconnected once").wait_for()
    code, errors = server.end(signal.SIGINT)
    assert code == 130
    assert "Traceback" not in errors
    assert "connecting again" in errors
    tab.page.locator("#gone").wait_for()


def test_a_stream_that_never_starts(chromium: Any, opened: Callable[..., Any], camera: SquareServer) -> None:
    """It is said on the page and the terminal; once the camera is on, trying again shows it."""
    camera.stop()
    server = opened()
    tab = Tab(chromium, server.url)
    tab.page.locator("#hint", has_text="Waiting for http://127").wait_for()
    tab.page.locator("#problem").wait_for()
    assert "no image within 10 s" in tab.page.locator("#problem").inner_text()
    assert "is the address right?" in server.process.stdout.readline()
    tab.page.keyboard.press("+")
    tab.page.mouse.move(200, 200)
    tab.page.mouse.wheel(0, -200)
    camera.start()
    tab.page.click("#again")
    tab.ready()
    tab.page.locator("#problem").wait_for(state="hidden")
    tab.draw(*START)  # in a picture that was zoomed before there was one
    tab.page.locator("#targets button", has_text="Target 1").wait_for()
    assert tab.troubles == []


@pytest.mark.parametrize("size", [LAPTOP, PHONE], ids=["laptop", "phone"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_fits_and_reads(
    chromium: Any, opened: Callable[..., Any], size: dict[str, int], scheme: str
) -> None:
    """Nothing is wider than the screen, every control has a name, and text stands out by 4.5 to 1."""
    tab = Tab(chromium, opened().url, size).ready()
    tab.page.emulate_media(color_scheme=scheme)
    tab.follow()
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= size["width"]
    assert tab.page.evaluate(NAMELESS) == []
    assert tab.page.evaluate(CONTRASTS) == []
