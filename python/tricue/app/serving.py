# SPDX-License-Identifier: MIT
"""State shared by the routes of a project's server."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import cached_property

from tricue.app.exports import boxed_channel, picture
from tricue.app.frames import RecordedFrames
from tricue.app.local_server import Served
from tricue.app.session import Session
from tricue.app.trackers import default_tracker
from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.draw.depth_pictures import depth_range


@dataclass
class Serving(Served):
    """State shared by the routes. boxes: the drawn ones, if only boxes are requested."""

    session: Session
    tracker: str = ""
    selecting: bool = False
    boxes: list[tuple[int, Box]] = field(default_factory=list)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self.frame_lock = threading.Lock()
        self.tracker = self.tracker or default_tracker(self.session.trackers)

    @contextmanager
    def recording(self) -> Iterator[RecordedFrames]:
        """The recording, for one thread at a time."""
        with self.frame_lock:
            yield self.session.recording

    @cached_property
    def depth_span(self) -> tuple[float, float] | None:
        """The range of depth in five frames of the recording, used for all so that colors don't flicker.

        None if none of them has readable depth.
        """
        ranges = []
        with self.recording() as recording:
            for number in sorted({part * (recording.length - 1) // 4 for part in range(5)}):
                with suppress(OSError, ValueError, RuntimeError):  # skip unreadable ones
                    depth = recording.frame(number).depth
                    if depth is not None and (span := depth_range(depth)):
                        ranges.append(span)
        if not ranges:
            return None
        return min(low for low, _ in ranges), max(high for _, high in ranges)

    def picture(self, frame: Frame, channel: str | None = None) -> Image:
        """A channel of a frame as :func:`tricue.app.exports.picture` gives it, depth in one range for all."""
        name = channel or boxed_channel(frame)
        return picture(frame, name, self.depth_span if name == "depth" else None)
