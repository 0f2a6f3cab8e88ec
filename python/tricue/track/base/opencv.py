# SPDX-License-Identifier: MIT
"""tricue's trackers with OpenCV's interface, for code written for ``cv2.Tracker``."""

from tricue.camera.box import BoxLike
from tricue.camera.frame import FrameLike
from tricue.track.base.adapter import check_is_tracker, with_known_numbers
from tricue.track.base.track import Status, Track, Tracker


class OpenCVTracker:
    """Wraps a tracker with ``init``, ``update`` and ``getTrackingScore`` as in ``cv2.Tracker``."""

    def __init__(self, tracker: Tracker) -> None:
        self.tracker = tracker
        self._track: Track | None = None

    def init(self, image: FrameLike, boundingBox: BoxLike) -> None:  # noqa: N803 (as cv2 names it)
        """Start, or start again, on the box (x, y, width, height)."""
        self._track = self.tracker.init(image, boundingBox)

    def update(self, image: FrameLike) -> tuple[bool, tuple[int, int, int, int]]:
        """Whether the target is still tracked (False if lost), and its box in whole pixels."""
        track = self.tracker.update(image)
        self._track = track if self._track is None else with_known_numbers(track, self._track.box)
        return self._track.status is not Status.LOST, self._track.box.as_int()

    def getTrackingScore(self) -> float:  # noqa: N802 (as cv2 names it)
        """The last track's score in [0, 1]; RuntimeError before ``init``."""
        if self._track is None:
            raise RuntimeError("getTrackingScore: expected init first")
        return self._track.score


def as_opencv(tracker: Tracker) -> OpenCVTracker:
    """The tracker with the interface of ``cv2.Tracker``.

    ``update`` returns whether the target isn't LOST, and its box in whole pixels. TypeError for anything but
    a tracker.
    """
    check_is_tracker(tracker)
    return OpenCVTracker(tracker)
