# SPDX-License-Identifier: MIT
"""A tracker whose errors become part of its run."""

from typing import Any

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.errors import one_line
from tricue.evaluation.one_pass import AnyTracker
from tricue.track.base.track import Status, Track


class SafeTracker:
    """A tracker that never raises: after its first error, kept in ``error``, it returns tracks without a box.
    error: of an earlier failure, such as in creating it.
    """

    def __init__(self, tracker: AnyTracker | None, error: str = "") -> None:
        self.error = error
        self.updates = 0
        """Number of updates before the error: 0 if ``init`` failed."""
        self._tracker = tracker

    @property
    def update_seconds(self) -> float | None:
        """The last update's seconds, if the tracker measures them itself."""
        return getattr(self._tracker, "update_seconds", None)

    def init(self, frame: Frame, box: Box) -> Track:
        """The tracker's, or a track without a box."""
        return self._try("init", frame, box)

    def update(self, frame: Frame) -> Track:
        """The tracker's, or a track without a box."""
        if not self.error:
            self.updates += 1
        return self._try("update", frame)

    def _try(self, method: str, *arguments: Any) -> Track:
        if not self.error:
            try:
                track: Track = getattr(self._tracker, method)(*arguments)
                return track
            except Exception as error:
                self.error = one_line(error)
        return Track(Box(*[float("nan")] * 4), 0.0, Status.LOST)
