# SPDX-License-Identifier: MIT
"""What the routes of a project's server share."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property

from tricue.app.frames import Recording
from tricue.app.local_server import Served
from tricue.app.session import Session
from tricue.camera.box import Box
from tricue.draw.depth_pictures import depth_range


@dataclass
class Serving(Served):
    """What the routes share. boxes: those drawn where only boxes are asked for."""

    session: Session
    tracker: str = ""
    selecting: bool = False
    boxes: list[tuple[int, Box]] = field(default_factory=list)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self.frame_lock = threading.Lock()
        known = self.session.trackers
        self.tracker = self.tracker or ("fused" if "fused" in known else next(iter(known), ""))

    @contextmanager
    def recording(self) -> Iterator[Recording]:
        """The recording, for one thread at a time."""
        with self.frame_lock:
            yield self.session.recording

    @cached_property
    def depth_span(self) -> tuple[float, float] | None:
        """The range of depth in five frames of the recording: one for all, so that colors don't flicker."""
        if "depth" not in self.session.recording.source.channels:
            return None
        with self.recording() as recording:
            numbers = sorted({part * (recording.length - 1) // 4 for part in range(5)})
            depths = [recording.frame(number).depth for number in numbers]
        ranges = [span for depth in depths if depth is not None and (span := depth_range(depth))]
        near = min((low for low, _ in ranges), default=0.0)
        return near, max([near + 0.01, *(high for _, high in ranges)])
