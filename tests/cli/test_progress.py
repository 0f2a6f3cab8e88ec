# SPDX-License-Identifier: MIT
import io
import time

import pytest
from tricue.cli.progress import Progress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock that moves on by a minute whenever somebody looks."""
    minutes = iter(range(0, 10**6, 60))
    monkeypatch.setattr(time, "monotonic", lambda: float(next(minutes)))


@pytest.mark.usefixtures("clock")
def test_a_bar_on_a_terminal() -> None:
    """It proves that a terminal gets one line, written over and wiped out at the end."""
    stream = Terminal()
    with Progress(1000, stream) as progress:
        progress(250, "tracking 5,000 frames/s")
        progress(1000)
    first, second, wiped, last = stream.getvalue().split("\r")[1:]
    assert first == f"[{'#' * 6}{'.' * 18}] 250/1,000  tracking 5,000 frames/s"
    assert second.rstrip() == f"[{'#' * 24}] 1,000/1,000"
    assert (wiped.strip(), last) == ("", "")
    assert "\n" not in stream.getvalue()


@pytest.mark.usefixtures("clock")
def test_plain_lines_elsewhere() -> None:
    """It proves that a file or a pipe gets plain lines: no bar, no carriage return."""
    stream = io.StringIO()
    with Progress(1000, stream) as progress:
        progress(250, "tracking 5,000 frames/s")
        progress(500)
    assert stream.getvalue() == "250/1,000  tracking 5,000 frames/s\n500/1,000\n"


def test_it_stays_quiet_between() -> None:
    """It proves that nothing is written more often than it can be read, so that short runs show nothing."""
    stream = Terminal()
    with Progress(None, stream) as progress:
        for done in range(1000):
            progress(done)
    assert stream.getvalue().count("\r") < 20


@pytest.mark.usefixtures("clock")
def test_an_unknown_length_is_no_bar() -> None:
    """It proves that a camera shows the count alone."""
    stream = Terminal()
    with Progress(None, stream) as progress:
        progress(1234, "decoding")
    assert stream.getvalue().startswith("\r1,234  decoding")


@pytest.mark.usefixtures("clock")
def test_a_total_that_is_passed_was_wrong() -> None:
    """It proves that a video with more frames than its container states then shows the count alone."""
    stream = Terminal()
    with Progress(100, stream) as progress:
        progress(100)
        progress(101)
    first, second = stream.getvalue().split("\r")[1:3]
    assert first == f"[{'#' * 24}] 100/100"
    assert second.strip() == "101"
