# SPDX-License-Identifier: MIT
"""Runs one or several trackers over a source, frame by frame, and measures times."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import perf_counter

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.cli.outputs import Step
from tricue.data.source import Source
from tricue.data.streams import Video, mean_rate
from tricue.errors import TargetNotFoundError
from tricue.track.base import adapter
from tricue.track.base.track import Status, Track, Tracker
from tricue.track.multi.tracker import MultiTracker

Start = Callable[[Frame], Box | None]
"""Gives the box to start on, or None; called for each frame until there is one."""


@dataclass
class RunClock:
    """Seconds spent on decoding and on tracking, and counts of the tracker's statuses.

    begin, end: the times of the first and of the last decoded frame. start_size, last_size: width and
    height of the image in which tracking started, and of the last one. not_found_reason: why a tracker that
    detects its target found none in the last frame so far.
    """

    decoding: float = 0.0
    tracking: float = 0.0
    decoded: int = 0
    updates: int = 0
    begin: float = 0.0
    end: float = 0.0
    start_size: tuple[int, int] = (0, 0)
    last_size: tuple[int, int] = (0, 0)
    not_found_reason: str = ""
    statuses: dict[Status, int] = field(default_factory=lambda: dict.fromkeys(Status, 0))

    @property
    def speeds(self) -> str:
        """Both speeds in frames/s; tracking excludes the first frame, in which the tracker starts."""
        tracking = f"tracking {self.updates / self.tracking:,.0f} frames/s, " if self.tracking else ""
        return f"{tracking}decoding {self.decoded / max(self.decoding, 1e-9):,.0f} frames/s"

    def rate(self, source: Source) -> float:
        """Frames per second of the recording; the mean rate of a video, of the frames decoded so far."""
        if not isinstance(source.clock, Video):
            return source.fps
        return mean_rate(source.fps, self.decoded, self.end - self.begin)


def steps(
    tracker: Tracker, frames: Iterable[Frame], start: Start | None, clock: RunClock, first: int = 0
) -> Iterator[Step]:
    """Start the tracker on the first box that ``start`` gives, and track.

    Without ``start`` the tracker starts in the first frame in which it detects a target. first: the first
    frame's number.
    """
    started = False
    for index, frame in enumerate(_decoded(frames, clock), first):
        box = start(frame) if start and not started else None
        if start and not started and box is None:
            continue
        before = perf_counter()
        if started:
            with _naming_frame(index):
                track: Track | None = tracker.update(frame)
        else:
            track = _started(tracker, frame, box, clock)
        seconds = perf_counter() - before
        if track is None:
            continue
        clock.statuses[track.status] += 1
        if started:
            clock.tracking, clock.updates = clock.tracking + seconds, clock.updates + 1
        started = True
        yield Step(
            index, frame, track, seconds, **{name: getattr(tracker, name) for name in tracker.traits.shows}
        )


def steps_of_targets(
    targets: MultiTracker,
    frames: Iterable[Frame],
    boxes: Sequence[tuple[int, Box]],
    clock: RunClock,
    first: int = 0,
) -> Iterator[Step]:
    """Start a target on each box in its frame, and track all of them from the first start on."""
    for index, frame in enumerate(_decoded(frames, clock), first):
        starting = [box for number, box in boxes if number == index]
        before = perf_counter()
        with _naming_frame(index):
            tracks = targets.update(frame)
        if starting:
            for box in starting:
                with _naming_frame(index, box):
                    targets.add(frame, box)
            tracks = targets.tracks
        seconds = perf_counter() - before
        for track in tracks.values():
            clock.statuses[track.status] += 1
        if not starting:
            clock.tracking, clock.updates = clock.tracking + seconds, clock.updates + 1
        if tracks:
            yield Step(index, frame, next(iter(tracks.values())), seconds, tracks=tracks)


def with_known_tracks(found: Iterable[Step]) -> Iterator[Step]:
    """The steps, with third parties' tracks made fit for files and pictures: see
    :func:`tricue.track.base.adapter.with_known_numbers`.
    """
    last: dict[int, Box] = {}
    for step in found:
        tracks = {
            target: adapter.with_known_numbers(track, last.get(target, track.box))
            for target, track in step.targets.items()
        }
        last |= {target: track.box for target, track in tracks.items()}
        several = None if step.tracks is None else tracks
        yield step._replace(track=next(iter(tracks.values())), tracks=several)


@contextmanager
def _naming_frame(number: int, box: Box | None = None) -> Iterator[None]:
    """Put the frame's number, one of thousands, before an error's message. box: one that starts there."""
    try:
        yield
    except ValueError as error:
        where = "" if box is None else f", --box {','.join(f'{value:g}' for value in box)}"
        raise ValueError(f"frame {number}{where}: {error}") from error


def _started(tracker: Tracker, frame: Frame, box: Box | None, clock: RunClock) -> Track | None:
    """The first track, or None if the tracker hasn't detected its target yet."""
    try:
        return tracker.init(frame, box)
    except TargetNotFoundError as error:
        clock.not_found_reason = str(error)
        return None


def _decoded(frames: Iterable[Frame], clock: RunClock) -> Iterator[Frame]:
    iterator = iter(frames)
    while True:
        before = perf_counter()
        frame = next(iterator, None)
        clock.decoding += perf_counter() - before
        if frame is None:
            return
        clock.end = clock.end if frame.timestamp is None else frame.timestamp
        clock.begin = clock.begin if clock.decoded else clock.end
        clock.last_size = _size_of(frame)
        clock.start_size = clock.start_size if any(clock.statuses.values()) else clock.last_size
        clock.decoded += 1
        yield frame


def _size_of(frame: Frame) -> tuple[int, int]:
    """Width and height of the color image, or of depth if there is none."""
    image = frame.depth if frame.color is None else frame.color
    assert image is not None  # a frame has one of the two
    return image.shape[1], image.shape[0]
