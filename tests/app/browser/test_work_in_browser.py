# SPDX-License-Identifier: MIT
"""The work in the page: draw, track, correct, undo, export, reload, kill and reopen, the end."""

import re
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tricue.app import select_boxes

from tests.app.browser.tab import PATIENCE, Tab
from tests.app.conftest import FRAMES, START
from tests.app.test_serve import Server, saved


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
    hint = tab.page.locator("#hint")
    assert hint.inner_text() == "Press Track or Back to track from this box"
    tab.key("ArrowRight")
    tab.shows(FRAMES - 10)
    assert hint.inner_text() == ""
    tab.key("ArrowLeft")
    tab.shows(FRAMES - 11)
    tab.track("#track-back")
    tab.shows(0)
    corrected = tab.rows()
    tab.key("d")
    tab.shows(FRAMES - 11)
    assert hint.inner_text() == ""
    assert abs(float(corrected[FRAMES - 11]["x"]) - START.x - 45) < 2
    assert corrected != rows
    tab.page.reload()
    tab.shows(0)
    tab.page.locator("#targets button", has_text="Target 1").wait_for()
    assert tab.rows() == corrected


def test_run_leads_to_the_drawn_box_that_ends_it(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Forward and backward; the page says so, and Track goes on from there."""
    tab = open_tab(server.url)
    tab.draw(*START)
    for _ in range(2):
        tab.key("Shift+ArrowRight")
    tab.shows(20)
    tab.draw(START.x + 20, START.y - 4, 46, 46, "draw")
    tab.key("Home")
    tab.shows(0)
    tab.track()
    tab.shows(20)
    tab.page.locator(".toast", has_text="Tracking stopped at the box drawn in frame 20").wait_for()
    assert {row["frame"] for row in tab.rows()} == {str(at) for at in range(21)}
    tab.track()
    tab.shows(FRAMES - 1)
    tab.key("d")
    tab.shows(0)
    tab.key("d")
    tab.shows(20)
    tab.track("#track-back")
    tab.shows(0)
    tab.page.locator(".toast", has_text="Tracking stopped at the box drawn in frame 0").wait_for()


def test_target_that_stops_at_its_box_while_another_goes_on_is_told(
    server: Server, open_tab: Callable[..., Tab]
) -> None:
    """The run of both ends at the video's end, where nothing else would say why one has no box."""
    for _ in range(2):
        server.do("add", frame=0, box=[*START], tracker="color-particle")
    server.do("draw", target=1, frame=20, box=[START.x + 20, START.y - 4, 46, 46])
    tab = open_tab(server.url)
    tab.page.select_option("#who", "all")
    tab.track()
    tab.shows(FRAMES - 1)
    tab.page.locator(".toast", has_text="Target 1 stopped at the box drawn in frame 20").wait_for()
    assert tab.page.locator(".toast").count() == 1


def test_target_without_a_box_is_told_when_all_are_tracked(
    server: Server, open_tab: Callable[..., Tab]
) -> None:
    """It stays where it is, and nothing else would say why."""
    server.do("add", frame=0, box=[*START], tracker="color-particle")
    server.do("add", frame=20, box=[START.x + 20, *START[1:]], tracker="color-particle")
    tab = open_tab(server.url)
    tab.page.select_option("#who", "all")
    tab.track()
    tab.shows(FRAMES - 1)
    tab.page.locator(".toast", has_text="Not followed, without a box in frame 0: Target 2").wait_for()
    assert tab.page.locator(".toast").count() == 1


def test_press_in_the_picture_during_a_run_says_to_pause(
    server: Server, open_tab: Callable[..., Tab]
) -> None:
    """No box is drawn then, and the page says how to."""
    for at in range(40):  # so that it takes a while
        server.do("add", frame=0, box=[20 + at, 40, 40, 40], tracker="fused")
    tab = open_tab(server.url)
    tab.page.select_option("#who", "all")
    tab.page.click("#track")
    tab.page.locator("#pause").wait_for()
    tab.drag((100, 10), (130, 35))
    tab.page.locator(".toast", has_text="Press Pause to draw a box").wait_for()
    assert all(each["drawn"] == [0] for each in server.state()["targets"])


def test_key_that_finds_nothing_says_so(server: Server, open_tab: Callable[..., Tab]) -> None:
    """Of frames that are lost or occluded, of the chosen target or of all; and of drawn boxes."""
    tab = open_tab(server.url)
    tab.key("d")
    tab.page.locator(".toast", has_text="No box is drawn").wait_for()
    tab.draw(*START)
    tab.key("l")
    tab.page.locator(".toast", has_text="Target 1 is nowhere lost or occluded").wait_for()
    tab.key("Escape")
    tab.key("l")
    tab.page.locator(".toast", has_text="No target is lost or occluded").wait_for()


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


def test_what_undo_brings_back_is_chosen(server: Server, followed: Tab) -> None:
    """A box drawn once a deleted target is back is that target's, unless none was chosen meanwhile."""
    chosen = followed.page.locator("#targets button[aria-pressed=true]")
    followed.page.locator("#picture").focus()
    for others in ([], ["Escape"]):
        followed.key("Delete")
        chosen.wait_for(state="detached")
        for key in others:
            followed.key(key)
        with followed.done("undo"):
            followed.key("Control+z")
        followed.page.locator("#targets button", has_text="Target 1").wait_for()
        assert chosen.count() == 1 - len(others)
        followed.key("1")
    with followed.done("draw"):
        followed.drag((100, 10), (130, 35))
    assert [each["name"] for each in server.state()["targets"]] == ["Target 1"]


def test_killed_and_opened_again(video: Path, open_tab: Callable[..., Tab]) -> None:
    """A page says that its server doesn't answer and where the work is; a new one has all of it."""
    server = Server(str(video), "--port", "0")
    tab = open_tab(server.url)
    tab.draw(*START)
    tab.track()
    rows = tab.rows()
    saved(server)
    tab.expected += ["net::ERR_", "WebSocket connection to"]
    server.end(signal.SIGKILL)
    tab.page.locator("#gone").wait_for()
    assert re.match(
        r"The server doesn.t answer. .*video.mp4.tricue.json", tab.page.locator("#gone").inner_text()
    )
    tab.context.close()
    again = Server(str(video), "--port", "0")
    try:
        opened = open_tab(again.url)
        assert opened.rows() == rows
        opened.context.close()  # or it complains that this server ends, too
    finally:
        again.end()


def test_picture_comes_back_with_the_connection(server: Server, open_tab: Callable[..., Tab]) -> None:
    """A frame that was gone to while a tunnel to the server was down is shown once it is up again."""
    tab = open_tab(server.url)
    page = tab.page
    tab.expected += ["net::ERR_"]
    page.add_init_script(
        "window.sockets = [];"
        "window.WebSocket = class extends WebSocket { constructor(url) { super(url); sockets.push(this); } }"
    )
    page.reload()
    tab.shows(0)
    page.route("**/frame/1.jpg", lambda route: route.abort())
    tab.key("ArrowRight")
    page.locator("#hint", has_text="Frame 1 can't be shown").wait_for()
    page.unroute("**/frame/1.jpg")
    page.evaluate("sockets[0].close()")
    page.locator("#hint", has_text="Drag a box around the target").wait_for()


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
