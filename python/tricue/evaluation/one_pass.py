# SPDX-License-Identifier: MIT
"""One-pass evaluation: a tracker starts on the first true box and runs to the end without restarts."""

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

_NO_BOX, _NO_POSITION, _NO_COVARIANCE = np.full(4, np.nan), np.full(3, np.nan), np.full((3, 3), np.nan)
_NO_TRACK = Track(Box(0, 0, 1, 1), 0.0, Status.LOST)


class AnyTracker(Protocol):
    """A tracker that can be evaluated: one of tricue's, of the baselines, or of others.

    A tracker in another process has an attribute ``update_seconds``, the time of its last update, measured
    there. A tracker that may fail has an attribute ``error``, "" until it does.
    """

    def init(self, frame: Frame, box: Box) -> Track: ...

    def update(self, frame: Frame) -> Track: ...


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Run:
    """A tracker's output in each of M frames, the first included, and its update times."""

    boxes: NDArray[np.float64]
    """(M, 4) x, y, width, height in pixels; NaN where the tracker wasn't run or failed."""
    scores: NDArray[np.float64]
    """(M,) confidences."""
    statuses: tuple[Status, ...]
    positions: NDArray[np.float64]
    """(M, 3) meters in the camera frame; NaN where the tracker gave none."""
    covariances: NDArray[np.float64]
    """(M, 3, 3) of the positions, square meters; NaN where the tracker gave none."""
    seconds: NDArray[np.float64]
    """(U,) one per update, M - 1 in one pass, without init and decoding; fewer if the tracker failed, none if
    no time is known.
    """

    @property
    def frames_per_second(self) -> float:
        """Updates per second of update time; NaN if no time is known."""
        return self.seconds.size / float(self.seconds.sum()) if self.seconds.any() else float("nan")

    @property
    def lost(self) -> float:
        """Share of the frames with status LOST."""
        return self.statuses.count(Status.LOST) / len(self.statuses)

    def __repr__(self) -> str:
        return f"Run(<{len(self.statuses)} frames>, lost={self.lost:.3g})"

    def _repr_html_(self) -> str:
        from tricue.notebook.results import run_html

        return run_html(self)


def run(tracker: AnyTracker, frames: Iterable[Frame], box: Box, start: int = 0) -> Run:
    """Track through ``frames``, from ``box`` in frame ``start``, with OpenCV limited to one thread.

    Frames are read one at a time and not kept; those before the start have no box. ValueError if no frame
    follows the start.
    """
    log = RunLog()
    with one_thread():
        for index, frame in enumerate(frames):
            if index < start:
                log.skip()
            elif index == start:
                log.init(tracker, frame, box)
            else:
                log.update(tracker, frame)
    if len(log.tracks) < start + 2:
        raise ValueError(f"frames: expected {start + 2} or more, got {len(log.tracks)}")
    return log.run


class RunLog:
    """A tracker's output, frame by frame; None for a frame in which it wasn't run."""

    def __init__(self) -> None:
        self.tracks: list[Track | None] = []
        self.seconds: list[float] = []

    def init(self, tracker: AnyTracker, frame: Frame, box: Box) -> Track:
        """Start the tracker; the time isn't measured."""
        track = tracker.init(frame, box)
        self.tracks.append(track)
        return track

    def update(self, tracker: AnyTracker, frame: Frame) -> Track:
        """Update the tracker and measure the time, which isn't counted once the tracker has failed."""
        start = perf_counter()
        track = tracker.update(frame)
        seconds = perf_counter() - start
        if not getattr(tracker, "error", ""):
            there = getattr(tracker, "update_seconds", None)
            self.seconds.append(seconds if there is None else there)
        self.tracks.append(track)
        return track

    def skip(self) -> None:
        """Record a frame in which the tracker doesn't run."""
        self.tracks.append(None)

    @property
    def run(self) -> Run:
        """The run over all frames so far."""
        tracks = self.tracks
        known = [track or _NO_TRACK for track in tracks]
        return Run(
            boxes=_stack([_NO_BOX if track is None else track.box for track in tracks]),
            scores=_stack([track.score for track in known]),
            statuses=tuple(track.status for track in known),
            positions=_stack([_NO_POSITION if t.position is None else t.position for t in known]),
            covariances=_stack([_NO_COVARIANCE if t.covariance is None else t.covariance for t in known]),
            seconds=_stack(self.seconds),
        )


def _stack(rows: Sequence[ArrayLike]) -> NDArray[np.float64]:
    return np.array(rows, dtype=np.float64)


@contextmanager
def one_thread() -> Iterator[None]:
    """Limit OpenCV to one thread, because tricue's kernels use one."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        yield
    finally:
        cv2.setNumThreads(threads)
