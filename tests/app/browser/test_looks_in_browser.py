# SPDX-License-Identifier: MIT
"""The page by keyboard alone, on screens of any size, and read aloud."""

import re
from collections.abc import Callable

import pytest

from tests.app.browser.tab import CONTRASTS, LAPTOP, NAMELESS, PHONE, Tab
from tests.app.conftest import FRAMES, START
from tests.app.test_serve import Server


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


def test_long_name_fits_a_phone(server: Server, open_tab: Callable[..., Tab]) -> None:
    """The longest name that a target may have is cut off in the list, and doesn't widen the page."""
    tab = open_tab(server.url, PHONE, touch=True)
    tab.draw(*START)
    with tab.done("rename"):
        tab.page.fill("#target-name", "W" * 80)
        tab.key("Enter")
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


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
