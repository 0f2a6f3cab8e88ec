# SPDX-License-Identifier: MIT
"""Runs of a session, and a tracker that counts its updates."""

import threading
import time
from collections.abc import Callable
from typing import Any, ClassVar

from tricue import Box, Frame, Status, Track
from tricue.app.session import Session
from tricue.track.base.traits import Channels, Traits

SessionOf = Callable[..., Session]
PATIENCE = 60.0  # seconds that a busy machine may take


def wait(condition: Callable[[], Any]) -> None:
    """Wait until something holds."""
    until = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < until, "it never came about"
        time.sleep(0.005)


def run(session: Session, *arguments: Any) -> None:
    """Track, and wait until the run has ended."""
    session.track(*arguments)
    wait(lambda: session.run is None)


class Gate:
    """Where a tracker waits inside an update until it is let through."""

    def __init__(self) -> None:
        self.reached, self.open = threading.Event(), threading.Event()

    def wait(self) -> None:
        self.reached.set()
        self.open.wait(PATIENCE)


class Counting:
    """Says by its score how often it was updated since init; raises in the frames named in ``bad``,
    and waits at the gate in its fifth update.
    """

    traits = Traits(channels=(Channels.of("color"),), follows="nothing")
    Params = None
    bad: ClassVar[set[int]] = set()
    gate: ClassVar[Gate | None] = None
    times: ClassVar[list[float]] = []

    def __init__(self, seed: int = 0, kernels: str = "native") -> None:
        self.params: dict[str, Any] = {}
        self.count = 0

    def init(self, frame: Frame, box: Any = None) -> Track:
        self.box, self.count = Box(*box), 0
        return self._track(frame)

    def update(self, frame: Frame) -> Track:
        self.count += 1
        if self.count in self.bad:
            raise RuntimeError(f"bad\nframe {self.count}")
        if self.gate is not None and self.count == 5:
            self.gate.wait()
        return self._track(frame)

    def _track(self, frame: Frame) -> Track:
        self.times.append(frame.timestamp or 0.0)
        return Track(self.box, self.count / 1000, Status.TRACKED)


def counts(session: Session, target: int = 1) -> dict[int, int]:
    """How often the tracker had been updated, by frame; the drawn boxes' 1000 are left out."""
    tracks = session.project.target(target).tracks
    return {at: round(1000 * each.score) for at, each in sorted(tracks.items()) if each.score < 1}
