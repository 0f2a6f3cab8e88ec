# SPDX-License-Identifier: MIT
"""The page in Chromium: draw, track, correct, undo, export, reload, kill and reopen; keys, touch, labels."""

import csv
import io
import re
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import cv2
import pytest
from tricue.app import select_boxes

from tests.app.conftest import FRAMES, HEIGHT, START, WIDTH, moving
from tests.app.test_serve import Server, saved

playwright = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install playwright")
LAPTOP, PHONE = {"width": 1366, "height": 768}, {"width": 390, "height": 844}
PATIENCE = 60_000  # milliseconds that a busy machine may take


class Tab:
    """A page of the server, and what a user does in it."""

    def __init__(self, browser: Any, url: str, size: dict[str, int], touch: bool = False) -> None:
        self.context = browser.new_context(viewport=size, has_touch=touch, is_mobile=touch)
        self.page = self.context.new_page()
        self.page.set_default_timeout(PATIENCE)
        self.troubles: list[str] = []
        self.expected = ["status of 400"]  # in what the browser complains of rightly
        self.page.on("pageerror", lambda error: self.troubles.append(str(error)))
        self.page.on("console", self._console)
        self.url = url
        self.page.goto(url)
        self.shows(0)

    def _console(self, message: Any) -> None:
        if message.type == "error" and not any(each in message.text for each in self.expected):
            self.troubles.append(message.text)

    def shows(self, frame: int) -> None:
        """Wait until the page shows a frame."""
        self.page.locator(f"html[data-page='shown {frame}']").wait_for(state="attached")

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a pixel of the frame is in the page."""
        left, top, width, height = self.page.locator("#picture").bounding_box().values()
        scale = min(width / WIDTH, height / HEIGHT)
        return (
            left + (width - WIDTH * scale) / 2 + x * scale,
            top + (height - HEIGHT * scale) / 2 + y * scale,
        )

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        mouse = self.page.mouse
        mouse.move(*self.place(*start))
        mouse.down()
        mouse.move(*self.place((start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
        mouse.move(*self.place(*end))
        mouse.up()

    def draw(self, x: float, y: float, width: float, height: float, command: str = "add") -> None:
        """Draw a box: of a new target, or with the command "draw" of the one that is chosen."""
        with self.done(command):
            self.drag((x, y), (x + width, y + height))
        self.page.locator("#targets button[aria-pressed=true]").wait_for()

    def key(self, name: str) -> None:
        self.page.keyboard.press(name)

    def track(self, button: str = "#track") -> None:
        """Press the button, and wait until the run has ended."""
        with self.done("track"):
            self.page.click(button)

    @contextmanager
    def done(self, command: str) -> Iterator[None]:
        """What the page is made to send in it is answered, done and known to the page when it ends."""
        asked = f'"do":"{command}"'
        with self.page.expect_response(lambda answer: asked in (answer.request.post_data or "")):
            yield
        self.settled()

    def settled(self) -> None:
        """Wait until no run is on, all is saved, and the page knows."""
        until = time.monotonic() + PATIENCE / 1000
        while (state := self.page.request.get(self.url + "state").json())["run"] or not state["saved"]:
            assert time.monotonic() < until
            time.sleep(0.02)
        self.page.locator(f"html[data-version='{state['version']}']").wait_for(state="attached")

    def rows(self) -> list[dict[str, str]]:
        """The exported CSV."""
        with self.page.expect_download() as download:
            self.page.click("#export")
            self.page.click("text=CSV")
        self.key("Escape")
        text = Path(download.value.path()).read_text()
        return list(csv.DictReader(io.StringIO(text)))


@pytest.fixture
def server(video: Path) -> Iterator[Server]:
    """The video, opened."""
    server = Server(str(video), "--port", "0")
    yield server
    if server.process.poll() is None:
        server.end()


@pytest.fixture
def open_tab(chromium: Any) -> Iterator[Callable[..., Tab]]:
    """``open_tab(url)``: a tab, in which nothing may go wrong unseen."""
    made: list[Tab] = []

    def make(url: str, size: dict[str, int] = LAPTOP, touch: bool = False) -> Tab:
        made.append(Tab(chromium, url, size, touch))
        return made[-1]

    yield make
    for tab in made:
        tab.context.close()
    assert [tab.troubles for tab in made if tab.troubles] == []


@pytest.fixture
def followed(server: Server, open_tab: Callable[..., Tab]) -> Tab:
    """A tab in which the square was drawn and tracked."""
    tab = open_tab(server.url)
    assert tab.page.locator("#hint").inner_text() == "Drag a box around what to follow"
    tab.draw(*START)
    tab.track()
    tab.shows(FRAMES - 1)
    return tab


def test_from_a_video_to_a_csv(followed: Tab) -> None:
    """Draw, track, export: the square is where it is."""
    rows = followed.rows()
    assert [int(row["frame"]) for row in rows] == list(range(FRAMES))
    assert abs(float(rows[0]["x"]) - START.x) < 2
    assert abs(float(rows[20]["x"]) - START.x - 20) < 5


def test_lost_target_is_corrected(server: Server, followed: Tab) -> None:
    """A key goes to what is lost; a box drawn later is tracked back to the first; a reload has it all."""
    tab, rows = followed, followed.rows()
    tab.key("l")
    tab.shows(next(int(row["frame"]) for row in rows if row["status"] != "tracked"))
    tab.page.locator("#lost-ranges button").first.wait_for()
    tab.key("End")
    for _ in range(10):
        tab.key("ArrowLeft")
    tab.shows(FRAMES - 11)
    tab.draw(START.x + 45, START.y - 4, 46, 46, "draw")  # beside its box, which a drag would move
    assert server.state()["targets"][0]["drawn"] == [0, FRAMES - 11]
    tab.track("#track-back")
    tab.shows(1)
    corrected = tab.rows()
    assert abs(float(corrected[FRAMES - 11]["x"]) - START.x - 45) < 2
    assert corrected != rows
    tab.page.reload()
    tab.shows(0)
    tab.page.locator("#targets button", has_text="Target 1").wait_for()
    assert tab.rows() == corrected


def test_undo_and_redo(followed: Tab) -> None:
    """Two undos take back the run and the box, two redos bring them again."""
    rows = followed.rows()
    target = followed.page.locator("#targets button")
    followed.key("Control+z")
    followed.page.locator("#redo:enabled").wait_for()
    followed.key("Control+z")
    target.wait_for(state="detached")
    assert followed.page.locator("#undo").is_disabled()
    followed.key("Control+Shift+z")
    target.wait_for()
    followed.key("Control+Shift+z")
    followed.page.locator("#redo:disabled").wait_for(state="attached")
    followed.settled()
    assert followed.rows() == rows


def test_killed_and_opened_again(video: Path, open_tab: Callable[..., Tab]) -> None:
    """A page says that its server has ended and where the work is; a new one has all of it."""
    server = Server(str(video), "--port", "0")
    tab = open_tab(server.url)
    tab.draw(*START)
    tab.track()
    rows = tab.rows()
    saved(server)
    tab.expected += ["net::ERR_", "WebSocket connection to"]
    server.end(signal.SIGKILL)
    tab.page.locator("#gone").wait_for()
    assert "video.mp4.tricue.json" in tab.page.locator("#gone").inner_text()
    tab.context.close()
    again = Server(str(video), "--port", "0")
    try:
        opened = open_tab(again.url)
        assert opened.rows() == rows
        opened.context.close()  # or it complains that this server ends, too
    finally:
        again.end()


def test_several_targets(server: Server, open_tab: Callable[..., Tab]) -> None:
    """A second target, another tracker, a name, all followed together, one deleted."""
    tab = open_tab(server.url)
    page = tab.page
    tab.draw(*START)
    tab.key("n")
    page.select_option("#target-tracker", "color-particle")
    tab.draw(100, 10, 30, 25)
    page.fill("#target-name", "Corner")
    page.keyboard.press("Enter")
    page.locator("#targets button", has_text="Corner").wait_for()
    page.select_option("#who", "all")
    tab.track()
    state = server.state()
    assert [(each["name"], each["tracker"]) for each in state["targets"]] == [
        ("Target 1", "fused"),
        ("Corner", "color-particle"),
    ]
    assert {row["id"] for row in tab.rows() if row["frame"] == "59"} == {"1", "2"}
    page.locator("#picture").focus()
    tab.key("1")
    tab.key("Delete")
    page.locator("#targets button", has_text="Target 1").wait_for(state="detached")
    assert {row["id"] for row in tab.rows()} == {"2"}


def test_box_is_moved_and_resized(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Dragging inside the chosen box moves it, dragging a corner changes its size."""
    tab = open_tab(server.url)
    tab.draw(*START)
    with tab.done("draw"):
        tab.drag((40, 60), (50, 65))
    with tab.done("draw"):
        tab.drag((70, 85), (80, 95))
    (row,) = tab.rows()
    assert [float(row[name]) for name in ("x", "y", "width", "height")] == pytest.approx(
        [30, 45, 50, 50], abs=2
    )


def test_keyboard_alone(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Without a pointer: a box by numbers, tracking, steps, playing; focus is always seen."""
    tab = open_tab(server.url)
    page = tab.page
    page.locator("#box summary").focus()
    tab.key("Enter")
    for name, value in zip("xywh", START, strict=True):
        page.locator(f"#box-{name}").focus()
        page.keyboard.type(f"{value:g}")
    tab.key("Enter")
    page.locator("#targets button", has_text="Target 1").wait_for()
    with tab.done("track"):
        tab.key("t")
    tab.shows(FRAMES - 1)
    for key, frame in (
        ("Home", 0),
        ("Shift+ArrowRight", 10),
        ("ArrowRight", 11),
        ("ArrowLeft", 10),
        ("d", 0),
    ):
        tab.key(key)
        tab.shows(frame)
    tab.key("Space")
    page.locator("#play[aria-label=Pause]").wait_for()
    page.wait_for_timeout(400)
    tab.key("Space")
    page.locator("#play[aria-label=Play]").wait_for()
    assert int(page.input_value("#frame")) > 3
    tab.key("?")
    page.locator("#help-dialog[open]").wait_for()
    tab.key("Escape")
    unseen = page.evaluate(
        """() => [...document.querySelectorAll("button, input, select, canvas[tabindex], summary, a")]
          .filter((each) => each.checkVisibility() && !each.disabled).filter((each) => {
            each.focus({focusVisible: true});
            return document.activeElement !== each || getComputedStyle(each).outlineStyle === "none";
          }).map((each) => each.outerHTML)"""
    )
    assert unseen == []


def test_keyboard_keeps_its_place(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Who presses Track by a key is at Pause while it runs, and at Track again when it has ended."""
    for at in range(40):  # so that it takes a while
        server.do("add", frame=0, box=[20 + at, 40, 40, 40], tracker="fused")
    tab = open_tab(server.url)
    tab.key("Escape")  # all of them
    tab.page.focus("#timeline")
    tab.key("Shift+Tab")
    focused = "document.activeElement.id"
    assert tab.page.evaluate(focused) == "track"
    with tab.done("track"):
        tab.key("Enter")
        tab.page.locator("#pause:focus").wait_for()
    assert tab.page.evaluate(focused) == "track"


def test_box_belongs_to_the_picture_pressed_on(server: Server, open_tab: Callable[..., Tab]) -> None:
    """A picture that comes during a drag is shown after it."""
    tab = open_tab(server.url)
    page, coming = tab.page, list[Any]()

    def keep(route: Any) -> None:
        coming.append(route)

    page.route("**/frame/1.jpg", keep)
    page.locator("#picture").focus()
    tab.key("ArrowRight")
    while not coming:
        page.wait_for_timeout(20)
    mouse = page.mouse
    mouse.move(*tab.place(20, 40))
    mouse.down()
    mouse.move(*tab.place(40, 60))
    coming[0].continue_()
    page.wait_for_timeout(300)
    with tab.done("add"):
        mouse.move(*tab.place(60, 80))
        mouse.up()
    assert server.state()["targets"][0]["drawn"] == [0]
    tab.shows(1)


def test_a_press_ends_playing(server: Server, open_tab: Callable[..., Tab]) -> None:
    """The box belongs to the picture that was shown then."""
    tab = open_tab(server.url)
    mouse = tab.page.mouse
    mouse.move(*tab.place(100, 10))
    tab.key("Space")
    tab.page.locator("html:not([data-page='shown 0'])").wait_for(state="attached")
    mouse.down()
    frame = int(tab.page.evaluate("document.documentElement.dataset.page").split()[1])
    tab.page.wait_for_timeout(300)
    with tab.done("add"):
        mouse.move(*tab.place(130, 35))
        mouse.up()
    assert server.state()["targets"][0]["drawn"] == [frame]


def test_what_is_written_is_of_its_target(server: Server, open_tab: Callable[..., Tab]) -> None:
    """A name goes to the target that was chosen when it was typed; the numbers are of the one chosen now."""
    tab = open_tab(server.url)
    page = tab.page
    tab.draw(*START)
    tab.key("n")
    tab.draw(100, 10, 30, 25)
    first = page.locator("#targets button").first.element_handle()
    first.click()
    page.fill("#target-name", "Anna")
    with tab.done("rename"):
        page.locator("#timeline").click(position={"x": 5, "y": 18 + 25 + 8})  # the other one's lane
    assert [each["name"] for each in server.state()["targets"]] == ["Anna", "Target 2"]
    assert page.locator("#targets button[aria-pressed=true]").inner_text().startswith("Target 2")
    assert first.evaluate("(button) => button.isConnected && button.innerText.startsWith('Anna')")
    page.locator("#box summary").focus()
    tab.key("Enter")
    assert float(page.input_value("#box-x")) == pytest.approx(100, abs=1)
    tab.key("1")
    assert float(page.input_value("#box-x")) == pytest.approx(START.x, abs=1)
    with tab.done("erase"):
        page.click("#box-erase")
    assert page.input_value("#box-x") == ""


def test_frame_that_cannot_be_shown(open_tab: Callable[..., Tab], tmp_path: Path) -> None:
    """The page says so and shows no other frame's picture; playing goes on after it."""
    folder = tmp_path / "images"
    folder.mkdir()
    for at, image in enumerate(moving(6)):
        cv2.imwrite(str(folder / f"{at}.png"), image)
    (folder / "3.png").write_bytes((folder / "2.png").read_bytes()[:99])
    server = Server(str(folder), "--port", "0")
    tab = open_tab(server.url)
    tab.expected.append("status of 404")
    page = tab.page
    page.fill("#frame", "99")
    tab.key("Enter")
    tab.shows(5)
    assert page.input_value("#frame") == "5"
    page.fill("#frame", "3")
    tab.key("Enter")
    page.locator("#hint", has_text="Frame 3 can't be shown").wait_for()
    assert "expected an image" in page.locator(".toast").inner_text()
    tab.key("Home")
    tab.shows(0)
    tab.key("Space")
    tab.shows(5)
    tab.context.close()  # before the server, whose end it would complain of
    server.end()


def test_work_that_is_not_saved_is_said(server: Server, open_tab: Callable[..., Tab], video: Path) -> None:
    """As long as it isn't, with the reason."""
    tab = open_tab(server.url)
    tab.draw(*START)
    path = video.with_name("video.mp4.tricue.json")
    path.write_text(path.read_text() + " ")
    tab.key("n")
    tab.drag((100, 10), (130, 35))
    said = tab.page.locator("#saved", has_text="another program changed it")
    said.wait_for()
    assert said.inner_text().startswith(f"not saved: {path}: ")
    path.unlink()
    tab.page.locator("#saved", has_text=re.compile("^saved")).wait_for()


def test_keys_are_the_pages(server: Server, open_tab: Callable[..., Tab]) -> None:
    """After a choice in a list with the pointer they are again; one that acts does so once a press."""
    tab = open_tab(server.url)
    page, asked = tab.page, list[str]()
    page.on("request", lambda request: asked.append(request.post_data or ""))
    tab.draw(*START)
    with tab.done("tracker"):
        page.click("#target-tracker")
        tab.key("Home")
        tab.key("Enter")
    with tab.done("track"):
        for _ in range(3):
            page.keyboard.down("t")
        page.keyboard.up("t")
    assert sum('"do":"track"' in each for each in asked) == 1
    tab.key("Home")
    tab.shows(0)
    for _ in range(3):
        page.keyboard.down("ArrowRight")
    tab.shows(3)


def test_frames_by_time(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Where frames don't come at a constant rate, a time's frame is the last up to it."""
    found = open_tab(server.url).page.evaluate(
        """async () => {
          const model = new (await import("./page/model.js")).Model();
          Object.assign(model, { state: { frames: 4, fps: 30 }, times: [0, 0.1, 5, 5.1] });
          return [-1, 0, 0.09, 0.1, 4.9, 5, 9].map((time) => model.frameAt(time));
        }"""
    )
    assert found == [0, 0, 0, 1, 1, 2, 3]


def test_pictures_are_kept_within_bounds(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Of large ones few are kept; the others give their memory back, but for the one that is shown."""
    found = open_tab(server.url).page.evaluate(
        """async () => {
          const closed = [];
          let count = 0;
          window.createImageBitmap = async () => {
            const number = count++;
            return { number, width: 8192, height: 2048, close: () => closed.push(number) }; // 64 MB
          };
          const { Pictures } = await import("./page/link.js");
          const pictures = new Pictures(({ number }) => number === 1);
          for (const frame of [0, 1, 2, 3, 0, 4, 5, 6, 7, 0]) await pictures.get(frame);
          return [count, closed];
        }"""
    )
    assert found == [9, [2, 3, 0, 4]]


def test_done_ends_it(video: Path, open_tab: Callable[..., Tab], capsys: pytest.CaptureFixture[str]) -> None:
    """Of a page that asks for boxes alone, and tracks nothing; the server's end then is no alarm."""
    found: list[Any] = []
    waiting = threading.Thread(
        target=lambda: found.append(select_boxes(video, port=0, browser=False)), daemon=True
    )
    waiting.start()
    until, text = time.monotonic() + PATIENCE / 1000, ""
    while not (url := re.search(r"http://\S+", text)):
        assert time.monotonic() < until
        time.sleep(0.05)
        text += capsys.readouterr().err
    tab = open_tab(url[0])
    tab.expected += ["net::ERR_", "WebSocket connection to"]
    tab.draw(*START)
    tab.key("t")
    tab.page.wait_for_timeout(500)
    state = tab.page.request.get(url[0] + "state").json()
    assert (state["run"], state["ended"]) == (None, None)
    tab.page.click("#done")
    tab.page.locator("text=Done. This page can be closed.").wait_for()
    waiting.join(PATIENCE / 1000)
    tab.page.wait_for_timeout(500)
    assert tab.page.locator("#gone").is_hidden()
    assert found == [[(0, pytest.approx(START, abs=1))]]


def test_timeline_is_a_slider(server: Server, open_tab: Callable[..., Tab]) -> None:
    """A click on the timeline goes there; a screen reader hears frame, time and status."""
    tab = open_tab(server.url)
    tab.draw(*START)
    tab.track()
    line = tab.page.locator("#timeline")
    width = line.bounding_box()["width"]
    line.click(position={"x": width * 0.5, "y": 25})
    tab.shows(FRAMES // 2)
    assert line.get_attribute("aria-valuenow") == str(FRAMES // 2)
    assert re.match(r"frame 30 of 59, 0:01\.00, Target 1: \w+", line.get_attribute("aria-valuetext"))


@pytest.mark.parametrize("size", [LAPTOP, PHONE], ids=["laptop", "phone"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_fits_and_reads(
    server: Server, open_tab: Callable[..., Tab], size: dict[str, int], scheme: str
) -> None:
    """Nothing is wider than the screen, every control has a name, and text stands out by 4.5 to 1."""
    tab = open_tab(server.url, size, touch=size is PHONE)
    tab.page.emulate_media(color_scheme=scheme)
    tab.draw(*START)
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= size["width"]
    picture = tab.page.locator("#picture").bounding_box()
    assert picture["width"] >= 0.75 * size["width"]
    assert tab.page.evaluate(NAMELESS) == []
    assert tab.page.evaluate(CONTRASTS) == []


@pytest.mark.parametrize("size", [LAPTOP, PHONE], ids=["laptop", "phone"])
def test_many_targets_leave_room_for_the_picture(
    server: Server, open_tab: Callable[..., Tab], size: dict[str, int]
) -> None:
    """The lanes of 50 targets are as thin as it takes, and each can still be chosen."""
    for at in range(50):
        server.do("add", frame=0, box=[at, at, 20, 20], tracker="fused")
    tab = open_tab(server.url, size, touch=size is PHONE)
    line = tab.page.locator("#timeline")
    tab.page.wait_for_function("document.getElementById('timeline').clientHeight > 100")
    height = line.bounding_box()["height"]
    assert height <= 200
    line.click(position={"x": 20, "y": height - 1.5})
    assert "Target 50" in tab.page.locator("#targets button[aria-pressed=true]").inner_text()


NAMELESS = """() => [...document.querySelectorAll("button, input, select, canvas, a, img")]
  .filter((each) => each.checkVisibility())
  .filter((each) => !(each.ariaLabel || each.textContent.trim() || each.alt || each.labels?.length))
  .map((each) => each.outerHTML)"""

CONTRASTS = """() => {
  const parse = (color) => color.match(/[\\d.]+/g).map(Number);
  const light = ([r, g, b]) => [r, g, b].map((v) => v / 255)
    .map((v) => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, index) => sum + v * [0.2126, 0.7152, 0.0722][index], 0);
  const ground = (each) => {
    for (let at = each; at; at = at.parentElement) {
      const color = parse(getComputedStyle(at).backgroundColor);
      if (color.length === 3 || color[3] > 0.7) return color;
    }
    return [255, 255, 255];
  };
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), weak = [];
  while (walker.nextNode()) {
    const node = walker.currentNode, each = node.parentElement;
    if (!node.data.trim() || !each.checkVisibility() || each.closest(":disabled, .unseen, script")) continue;
    const [a, b] = [light(parse(getComputedStyle(each).color)), light(ground(each))].sort((x, y) => y - x);
    if ((a + 0.05) / (b + 0.05) < 4.5) weak.push(node.data.trim());
  }
  return weak;
}"""


def test_touch_draws(server: Server, open_tab: Callable[..., Tab]) -> None:
    """A finger draws a box, and the page doesn't scroll away under it."""
    tab = open_tab(server.url, PHONE, touch=True)
    start, end = tab.place(20, 40), tab.place(60, 80)
    finger = tab.context.new_cdp_session(tab.page)

    def touch(kind: str, *points: tuple[float, float]) -> None:
        places = [{"x": x, "y": y} for x, y in points]
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": places})

    touch("touchStart", start)
    touch("touchMove", ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    touch("touchMove", end)
    touch("touchEnd")
    tab.page.locator("#targets button", has_text="Target 1").wait_for()
    tab.settled()
    (row,) = tab.rows()
    assert [float(row[name]) for name in ("x", "y", "width", "height")] == pytest.approx(list(START), abs=3)
    assert tab.page.evaluate("scrollY") == 0


def test_zoom_draws_where_it_looks(server: Server, open_tab: Callable[..., Tab]) -> None:
    """In an enlarged picture a box is where it is drawn."""
    tab = open_tab(server.url)
    page = tab.page
    x, y = tab.place(40, 60)
    page.mouse.move(x, y)
    page.mouse.wheel(0, -400)  # by e
    page.wait_for_timeout(100)
    page.mouse.move(x - 60, y - 60)
    page.mouse.down()
    page.mouse.move(x, y)
    page.mouse.move(x + 60, y + 60)
    page.mouse.up()
    page.locator("#targets button", has_text="Target 1").wait_for()
    tab.settled()
    (row,) = tab.rows()
    half = 60 / ((tab.place(1, 0)[0] - tab.place(0, 0)[0]) * 2.71828)
    expected = [40 - half, 60 - half, 2 * half, 2 * half]
    assert [float(row[name]) for name in ("x", "y", "width", "height")] == pytest.approx(expected, abs=0.5)


def test_errors_are_said(server: Server, open_tab: Callable[..., Tab], video: Path) -> None:
    """What can't be done is said in the page, in one line."""
    tab = open_tab(server.url)
    tab.draw(*START)
    video.unlink()
    tab.key("t")
    said = tab.page.locator(".toast")
    said.wait_for()
    assert said.inner_text().strip() == f"{video}: there is no such file or folder any more"
    said.get_by_role("button").click()
    said.wait_for(state="detached")


def test_a_refused_name_is_not_shown(server: Server, open_tab: Callable[..., Tab]) -> None:
    """The field has the target's name again."""
    tab = open_tab(server.url)
    tab.draw(*START)
    tab.page.fill("#target-name", "   ")
    tab.key("Enter")
    tab.page.locator("#toasts >> text=name: expected 1 to 80 characters").wait_for()
    tab.page.wait_for_timeout(200)
    assert tab.page.input_value("#target-name") == "Target 1"


def test_two_tabs_show_the_same(server: Server, open_tab: Callable[..., Tab]) -> None:
    """What is done in one tab is seen in the other."""
    one, other = open_tab(server.url), open_tab(server.url)
    one.draw(*START)
    one.track()
    other.page.locator("#targets button", has_text="Target 1").wait_for()
    other.page.locator("#saved", has_text=re.compile("^saved")).wait_for()
    assert other.rows() == one.rows()


def test_overlay_video_is_downloaded(server: Server, open_tab: Callable[..., Tab], tmp_path: Path) -> None:
    """The button writes the video and the browser gets it when it is whole."""
    tab = open_tab(server.url)
    tab.draw(*START)
    tab.page.click("#export")
    with tab.page.expect_download() as download:
        tab.page.click("#video")
    assert download.value.suggested_filename == "video.overlay.mp4"
    assert Path(download.value.path()).read_bytes()[4:8] == b"ftyp"
    tab.page.reload()
    tab.shows(0)
    tab.page.click("#export")
    with tab.page.expect_download() as download:
        tab.page.click("#video-file")  # as it may be written while nobody looks
    assert Path(download.value.path()).read_bytes()[4:8] == b"ftyp"
