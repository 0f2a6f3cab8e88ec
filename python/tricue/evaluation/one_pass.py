# SPDX-License-Identifier: MIT
"""One-pass evaluation: a tracker starts on the first true box and runs to the end, without help."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from time import perf_counter
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.track.track import Status, Track

_UNKNOWN, _UNSURE = np.full(3, np.nan), np.full((3, 3), np.nan)


class Contender(Protocol):
    """What can be evaluated: every tricue tracker, and the peers."""

    def init(self, frame: Frame, box: Box) -> Track: ...

    def update(self, frame: Frame) -> Track: ...


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What a tracker said in each of M frames, the first included, and how long it took."""

    boxes: NDArray[np.float64]
    """(M, 4) x, y, width, height in pixels."""
    scores: NDArray[np.float64]
    """(M,) confidences."""
    statuses: tuple[Status, ...]
    positions: NDArray[np.float64]
    """(M, 3) metres in the camera frame; NaN where the tracker gave none."""
    covariances: NDArray[np.float64]
    """(M, 3, 3) of the positions, square metres; NaN where the tracker gave none."""
    seconds: NDArray[np.float64]
    """(M - 1,) one per update; neither init nor decoding is in it."""

    @property
    def frames_per_second(self) -> float:
        """Updates over the time in them."""
        return self.seconds.size / float(self.seconds.sum())

    @property
    def lost(self) -> float:
        """Share of the frames with status LOST."""
        return self.statuses.count(Status.LOST) / len(self.statuses)


def run(tracker: Contender, frames: Sequence[Frame], box: Box) -> Run:
    """Track through decoded ``frames``, from ``box`` in the first, with OpenCV held to one thread."""
    if len(frames) < 2:
        raise ValueError(f"frames: expected two or more, got {len(frames)}")
    with one_thread():
        tracks, seconds = [tracker.init(frames[0], box)], []
        for frame in frames[1:]:
            start = perf_counter()
            track = tracker.update(frame)
            seconds.append(perf_counter() - start)
            tracks.append(track)
    return Run(
        boxes=np.array([track.box for track in tracks], dtype=np.float64),
        scores=np.array([track.score for track in tracks], dtype=np.float64),
        statuses=tuple(track.status for track in tracks),
        positions=np.array([_UNKNOWN if track.position is None else track.position for track in tracks]),
        covariances=np.array([_UNSURE if t.covariance is None else t.covariance for t in tracks]),
        seconds=np.array(seconds),
    )


@contextmanager
def one_thread() -> Iterator[None]:
    """Hold OpenCV to one thread, as tricue's kernels have one."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        yield
    finally:
        cv2.setNumThreads(threads)
