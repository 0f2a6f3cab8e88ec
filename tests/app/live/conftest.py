# SPDX-License-Identifier: MIT
"""A camera that tests move by hand, and sessions on it."""

import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.app.live.session import LiveSession, Opened
from tricue.data.live import Live, Patience, live_channels
from tricue.data.source import Source

from tests.app.conftest import moving

PATIENCE = 60.0  # seconds that a busy machine may take
IMAGES = moving(30)  # a square that goes right, and is hidden from frame 30 on


def wait(condition: Callable[[], Any]) -> None:
    """Wait until something holds."""
    until = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < until, "it never came about"
        time.sleep(0.005)


class ByHand:
    """A device whose images come when a test says so: the square to the right, and back again."""

    name, remote, fps, camera = "a camera", False, 30.0, None

    def __init__(self) -> None:
        self.given = 0  # images
        self.opened = self.closed = 0
        self.broken = False
        self.refused = ""
        self._allowed = threading.Semaphore(1)

    def open(self) -> None:
        if self.refused:
            raise OSError(self.refused)
        self.opened += 1

    def read(self) -> dict[str, NDArray[Any]] | None:
        while not self._allowed.acquire(timeout=0.05):
            if self.broken:
                return None
            if self.closed >= self.opened + 1:
                return None
        self.given += 1
        return {"color": np.array(IMAGES[level(self.given - 1)])}

    def close(self) -> None:
        self.closed += 1

    def give(self, count: int = 1) -> None:
        """Let some images come."""
        for _ in range(count):
            self._allowed.release()


def level(number: int) -> int:
    """Which of IMAGES the device's image of a number is."""
    return number % 30 if number // 30 % 2 == 0 else 29 - number % 30


class Studio:
    """A session on a camera by hand. said: what it wrote to the terminal."""

    def __init__(self, folder: Path) -> None:
        self.device, self.said = ByHand(), list[str]()
        self.session = LiveSession(self._open, "a camera", folder, say=self.said.append)

    def _open(self) -> Opened:
        live = Live(self.device, Patience(0.5, 0.02, 0.1, 30.0))
        return Opened(Source("a camera", live_channels(live), format="camera"), {})

    def shows(self, count: int = 1) -> int:
        """Let images come one by one, each of which is shown; the number of the last."""
        for _ in range(count):
            before = self.session.latest
            self.device.give()
            wait(lambda before=before: self.session.latest is not before)
        assert self.session.latest is not None
        return self.session.latest[0]

    def begin(self) -> None:
        """Start, and wait for the first frame."""
        self.session.start()
        wait(lambda: self.session.latest is not None)


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    """A session, which ends with the test."""
    made = Studio(tmp_path)
    yield made
    made.device.give(3)
    made.session.close()
