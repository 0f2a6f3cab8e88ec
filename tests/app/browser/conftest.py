# SPDX-License-Identifier: MIT
"""A server of a video, and tabs on it."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.app.browser.tab import LAPTOP, Tab
from tests.app.conftest import FRAMES, START
from tests.app.test_serve import Server


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
    assert tab.page.locator("#hint").inner_text() == "Drag a box around the target"
    tab.draw(*START)
    tab.track()
    tab.shows(FRAMES - 1)
    return tab
