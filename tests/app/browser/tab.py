# SPDX-License-Identifier: MIT
"""A page of ``tricue open`` in Chromium, and what a user does in it."""

import csv
import io
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.app.conftest import HEIGHT, WIDTH

LAPTOP, PHONE = {"width": 1366, "height": 768}, {"width": 390, "height": 844}
PATIENCE = 60_000  # milliseconds that a busy machine may take

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


def place_in_page(page: Any, x: float, y: float) -> tuple[float, float]:
    """Where a pixel of the picture is in the page."""
    left, top, width, height = page.locator("#picture").bounding_box().values()
    scale = min(width / WIDTH, height / HEIGHT)
    return (
        left + (width - WIDTH * scale) / 2 + x * scale,
        top + (height - HEIGHT * scale) / 2 + y * scale,
    )


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
        self.sent: list[str] = []
        self.page.on("request", lambda request: self.sent.append(f"{request.url} {request.post_data}"))
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
        return place_in_page(self.page, x, y)

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
        from playwright.sync_api import TimeoutError as NoAnswerError  # not everybody has it

        asked = f'"do":"{command}"'
        try:
            with self.page.expect_response(lambda answer: asked in (answer.request.post_data or "")):
                yield
        except NoAnswerError as error:
            about = self.page.evaluate("({...document.documentElement.dataset})")
            raise AssertionError(f"{command}: sent {self.sent}, page {about}, {self.troubles}") from error
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
