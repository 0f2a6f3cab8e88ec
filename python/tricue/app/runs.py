# SPDX-License-Identifier: MIT
"""Runs of trackers over a recording, forward or backward, which can be paused and resumed."""

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from typing import Any, Literal

from tricue.app.frames import RecordedFrames
from tricue.app.project import ProjectTarget
from tricue.app.trackers import make_tracker
from tricue.camera.frame import Frame
from tricue.camera.shared_frame import SharedFrame
from tricue.data.prefetch import prefetch
from tricue.track.base.adapter import with_known_numbers
from tricue.track.base.track import Status, Track, Tracker

Direction = Literal[1, -1]
Report = Callable[[Exception, str], None]


@dataclass
class TrackingRun:
    """A tracking run; ``found`` grows frame by frame while it runs. step: 1, or -1 backward. stopped: the
    targets that it has followed up to a drawn box, and that box's frame.
    """

    start: int
    step: Direction
    followed: tuple[int, ...]
    found: list[tuple[int, int, Track]] = field(default_factory=list)  # target, frame, track
    stopped: dict[int, int] = field(default_factory=dict)
    latest: tuple[int, Frame] | None = None
    stop: threading.Event = field(default_factory=threading.Event)
    began: float = field(default_factory=time.perf_counter)
    updates: int = 0
    seconds: float = 0.0  # spent in trackers

    @property
    def reached(self) -> int:
        """The last frame in which it has a track."""
        return self.found[-1][1] if self.found else self.start

    def tracks(self, first: int = 0, end: int | None = None) -> dict[int, dict[int, Track]]:
        """The tracks found, from index ``first`` to before ``end``, by target and frame."""
        by_target: dict[int, dict[int, Track]] = {}
        for number, at, track in self.found[first:end]:
            by_target.setdefault(number, {})[at] = track
        return by_target


@dataclass(frozen=True)
class Paused:
    """A tracker that can resume where it stopped, as long as its last track is still the shown one."""

    tracker: Tracker
    frame: int
    step: Direction
    last: Track
    name: str


class Follower:
    """Creates the trackers, and runs them until each target's next drawn box.

    cameras: the trackers' keywords intrinsics or rig, if known. report: gets a tracker's error and its place,
    or a warning about a frame, once a run.
    """

    def __init__(
        self, recording: RecordedFrames, cameras: Mapping[str, Any], seed: int, report: Report
    ) -> None:
        self.recording, self.cameras, self.seed, self.report = recording, cameras, seed, report
        self._paused: dict[int, Paused] = {}

    def can_start(self, target: ProjectTarget, frame: int, step: Direction) -> bool:
        """Whether the target has a box in this frame, or a tracker that paused there."""
        return has_box(target, frame) or self._resumed(target, frame, step) is not None

    def end(self, target: ProjectTarget, frame: int, step: Direction) -> int:
        """The frame before which a target's run ends: its next drawn box, or the end of the recording."""
        last = self.recording.length if step > 0 else -1
        drawn = target.next_drawn(frame, step)
        return last if drawn is None else drawn

    def follow(self, run: TrackingRun, targets: Sequence[ProjectTarget]) -> None:
        """Follow the targets, adding tracks to the run as they are found."""
        ends = {each.id: self.end(each, run.start, run.step) for each in targets}
        stop = max(end * run.step for end in ends.values()) * run.step
        resumed = {each.id: self._resumed(each, run.start, run.step) for each in targets}
        following = {each.id: resumed[each.id] or self._new(each) for each in targets}
        by_id = {each.id: each for each in targets}
        recording, warned = self.recording.again(), set[str]()
        with closing(prefetch(recording.frames(run.start, stop))) as frames:
            for number, frame in frames:
                shared = SharedFrame.of(frame)
                for one in list(following):
                    if number * run.step >= ends[one] * run.step:
                        del following[one]
                    elif number != run.start or resumed[one] is None:
                        self._step(run, by_id[one], following, number, shared)
                for message in shared.messages:
                    if message not in warned:
                        warned.add(message)
                        self.report(UserWarning(message), "warning: ")
                run.latest = number, frame
                if run.stop.is_set() or not following:
                    return
        if run.latest is not None and run.latest[0] != stop - run.step:
            recording.frame(stop - run.step)  # raises the reason why the run ended early

    def _step(
        self,
        run: TrackingRun,
        target: ProjectTarget,
        following: dict[int, Tracker],
        number: int,
        frame: Frame,
    ) -> None:
        """Follow one target into one frame; an error ends the run only for this target."""
        tracker, before = following[target.id], time.perf_counter()
        try:
            if number == run.start:
                last = target.tracks[number].box
                track = tracker.init(frame, last)
            else:
                last = self._paused[target.id].last.box
                track = tracker.update(frame)
            track = with_known_numbers(track, last)
        except Exception as error:  # whatever a third party's tracker raises
            del following[target.id]
            self._paused.pop(target.id, None)
            self.report(error, f"{target.name}, {target.tracker}, frame {number}: ")
            return
        if not self.cameras:
            track = track.in_image()  # with a default camera, positions wouldn't be in meters
        run.seconds += time.perf_counter() - before
        run.updates += 1
        run.found.append((target.id, number, track))
        if number + run.step in target.drawn:
            run.stopped[target.id] = number + run.step
        self._paused[target.id] = Paused(tracker, number, run.step, track, target.tracker)

    def _new(self, target: ProjectTarget) -> Tracker:
        return make_tracker(target.tracker, self.recording.source, self.cameras, self.seed)

    def _resumed(self, target: ProjectTarget, frame: int, step: Direction) -> Tracker | None:
        """The tracker that paused in this frame, if nothing has changed there since."""
        paused = self._paused.get(target.id)
        if paused is None or (paused.frame, paused.step, paused.name) != (frame, step, target.tracker):
            return None
        return paused.tracker if target.tracks.get(frame) is paused.last else None


def has_box(target: ProjectTarget, frame: int) -> bool:
    """Whether a run of a target can start in this frame: it has a box there and isn't lost."""
    track = target.tracks.get(frame)
    return track is not None and track.status is not Status.LOST
