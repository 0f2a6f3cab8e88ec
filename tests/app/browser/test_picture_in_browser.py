# SPDX-License-Identifier: MIT
"""The picture in the page: boxes by mouse and touch, zoom, the frames that are shown."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import pytest

from tests.app.browser.tab import PHONE, Tab
from tests.app.conftest import START, moving
from tests.app.test_serve import Server


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


def test_box_belongs_to_the_target_of_the_press(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Keys that choose another target, or none, during a drag change nothing about whose box it is."""
    tab = open_tab(server.url)
    mouse = tab.page.mouse
    tab.draw(*START)
    tab.key("n")
    tab.draw(100, 10, 30, 25)
    for chosen, pressed, start in (("1", "2", (10, 90)), ("2", "n", (90, 80)), ("n", "1", (65, 10))):
        tab.key(chosen)
        with tab.done("add" if chosen == "n" else "draw"):
            mouse.move(*tab.place(*start))
            mouse.down()
            mouse.move(*tab.place(start[0] + 10, start[1] + 10))
            tab.key(pressed)
            mouse.move(*tab.place(start[0] + 20, start[1] + 20))
            mouse.up()
    drawn = [[float(row[name]) for name in ("x", "y", "width", "height")] for row in tab.rows()]
    assert drawn == [pytest.approx([*start, 20, 20], abs=1) for start in ((10, 90), (90, 80), (65, 10))]


def test_blank_plays_after_a_click_on_trail(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Who ticked the box by mouse has the keys of the page; who came to it by keys ticks it with them."""
    tab = open_tab(server.url)
    trail = tab.page.locator("#trail")
    for clicked in (trail, tab.page.get_by_text("trail", exact=True)):
        before = trail.is_checked()
        clicked.click()
        tab.key("Space")
        tab.page.locator("#play[aria-label=Pause]").wait_for()
        tab.key("Space")
        tab.page.locator("#play[aria-label=Play]").wait_for()
        assert trail.is_checked() != before
    trail.focus()
    tab.key("Space")
    assert trail.is_checked()
    assert trail.evaluate("(box) => box === document.activeElement")


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


def test_the_clock_has_hours(server: Server, open_tab: Callable[..., Tab]) -> None:
    """As in tricue track's report, and only where there are any; the ruler's marks have fewer decimals."""
    found = open_tab(server.url).page.evaluate(
        """async () => {
          const { clock } = await import("./page/model.js");
          const times = [0, 59.999, 62.35, 3599.99, 3599.999, 3661.5, 36000];
          const others = [clock(3725, 0), clock(0.7, 1), clock(-1), clock(59.96, 1)];
          return [times.map((time) => clock(time)), ...others];
        }"""
    )
    times = ["0:00.00", "1:00.00", "1:02.35", "59:59.99", "1:00:00.00", "1:01:01.50", "10:00:00.00"]
    assert found == [times, "1:02:05", "0:00.7", "0:00.00", "1:00.0"]


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
