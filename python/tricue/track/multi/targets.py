# SPDX-License-Identifier: MIT
"""The targets followed by one process."""

import copy
from typing import Any

from tricue.camera.box import BoxLike
from tricue.camera.shared_frame import SharedFrame
from tricue.track.base.track import Track, Tracker
from tricue.track.base.tracker import TrackerBase
from tricue.track.multi.target_group import FollowedTargets


def keeps_images(tracker: Tracker) -> bool:
    """Whether a tracker may read a frame's images later; tricue's keep only results computed from them."""
    return not isinstance(tracker, TrackerBase)


class Targets(FollowedTargets):
    """Targets of this process, with their trackers."""

    def __init__(self) -> None:
        self._trackers: dict[int, Tracker] = {}
        self._before: tuple[int, dict[int, dict[str, Any]]] = 0, {}  # an update, attributes before it

    @property
    def ids(self) -> set[int]:
        return set(self._trackers)

    @property
    def keep_images(self) -> bool:
        """Whether a tracker may read a frame's images later."""
        return any(map(keeps_images, self._trackers.values()))

    def add(self, target: int, tracker: Tracker, frame: SharedFrame, box: BoxLike | None) -> Track:
        track = tracker.init(frame, box)
        self._trackers[target] = tracker
        return track

    def put(self, target: int, tracker: Tracker) -> None:
        self._trackers[target] = tracker

    def remove(self, target: int) -> None:
        self._trackers.pop(target, None)  # a worker may be asked for one that it didn't keep

    def update(self, number: int, frame: SharedFrame) -> dict[int, Track]:
        self._before = (
            number,
            {
                target: vars(tracker).copy()
                for target, tracker in self._trackers.items()
                if hasattr(tracker, "__dict__")  # some third-party trackers have none and aren't reverted
            },
        )
        return {target: _update(target, tracker, frame) for target, tracker in self._trackers.items()}

    def undo(self, number: int, hurried: bool = False) -> None:
        last, before = self._before
        for target, values in before.items() if last == number else ():
            vars(self._trackers[target]).update(values)

    def copies(self) -> dict[int, Tracker]:
        return {target: copy.copy(tracker) for target, tracker in self._trackers.items()}

    def close(self) -> None:
        self._trackers, self._before = {}, (0, {})


def _update(target: int, tracker: Tracker, frame: SharedFrame) -> Track:
    """The target's track; an error with a message names the target."""
    try:
        return tracker.update(frame)
    except Exception as error:
        if error.args and isinstance(error.args[0], str):
            error.args = f"target {target}: {error.args[0]}", *error.args[1:]
        raise
