# SPDX-License-Identifier: MIT
"""One-pass evaluation: a tracker starts on the first true box and runs to the end, without help."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from time import perf_counter
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.track.base.track import Status, Track

_NOWHERE, _UNKNOWN, _UNSURE = np.full(4, np.nan), np.full(3, np.nan), np.full((3, 3), np.nan)
_NOTHING = Track(Box(0, 0, 1, 1), 0.0, Status.LOST)


class AnyTracker(Protocol):
    """What can be evaluated: every tricue tracker, and the baselines."""

    def init(self, frame: Frame, box: Box) -> Track: ...

    def update(self, frame: Frame) -> Track: ...


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What a tracker said in each of M frames, the first included, and how long it took."""

    boxes: NDArray[np.float64]
    """(M, 4) x, y, width, height in pixels; NaN where the tracker wasn't asked or failed."""
    scores: NDArray[np.float64]
    """(M,) confidences."""
    statuses: tuple[Status, ...]
    positions: NDArray[np.float64]
    """(M, 3) meters in the camera frame; NaN where the tracker gave none."""
    covariances: NDArray[np.float64]
    """(M, 3, 3) of the positions, square meters; NaN where the tracker gave none."""
    seconds: NDArray[np.float64]
    """(U,) one per update, M - 1 in one pass; neither init nor decoding is in it."""

    @property
    def frames_per_second(self) -> float:
        """Updates over the time in them."""
        return self.seconds.size / float(self.seconds.sum())

    @property
    def lost(self) -> float:
        """Share of the frames with status LOST."""
        return self.statuses.count(Status.LOST) / len(self.statuses)


def run(tracker: AnyTracker, frames: Iterable[Frame], box: Box, start: int = 0) -> Run:
    """Track through ``frames``, from ``box`` in frame ``start``, with OpenCV held to one thread.

    Frames are taken one by one and not kept; those before the start have no box. ValueError where fewer than
    one frame follows the start.
    """
    log = Log()
    with one_thread():
        for index, frame in enumerate(frames):
            if index < start:
                log.skip()
            elif index == start:
                log.init(tracker, frame, box)
            else:
                log.update(tracker, frame)
    if not log.seconds:
        raise ValueError(f"frames: expected {start + 2} or more, got {len(log.tracks)}")
    return log.run


class Log:
    """What a tracker says, frame by frame; None for a frame in which it wasn't asked or failed."""

    def __init__(self) -> None:
        self.tracks: list[Track | None] = []
        self.seconds: list[float] = []

    def init(self, tracker: AnyTracker, frame: Frame, box: Box) -> Track:
        """Start the tracker, off the clock."""
        track = tracker.init(frame, box)
        self.tracks.append(track)
        return track

    def update(self, tracker: AnyTracker, frame: Frame) -> Track:
        """Let the tracker follow, on the clock."""
        start = perf_counter()
        track = tracker.update(frame)
        self.seconds.append(perf_counter() - start)
        self.tracks.append(track)
        return track

    def skip(self) -> None:
        """A frame without the tracker."""
        self.tracks.append(None)

    @property
    def run(self) -> Run:
        """All frames so far."""
        tracks = self.tracks
        said = [track or _NOTHING for track in tracks]
        return Run(
            boxes=_stacked([_NOWHERE if track is None else track.box for track in tracks]),
            scores=_stacked([track.score for track in said]),
            statuses=tuple(track.status for track in said),
            positions=_stacked([_UNKNOWN if t.position is None else t.position for t in said]),
            covariances=_stacked([_UNSURE if t.covariance is None else t.covariance for t in said]),
            seconds=_stacked(self.seconds),
        )


def _stacked(rows: Sequence[ArrayLike]) -> NDArray[np.float64]:
    return np.array(rows, dtype=np.float64)


@contextmanager
def one_thread() -> Iterator[None]:
    """Hold OpenCV to one thread, as tricue's kernels have one."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        yield
    finally:
        cv2.setNumThreads(threads)
