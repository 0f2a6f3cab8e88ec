# SPDX-License-Identifier: MIT
"""Robustness by restarts: a tracker that loses its target is restarted, and failures are counted.

The supervised experiment of VOT (Kristan et al. 2016, "A novel performance evaluation methodology for single-
target trackers"): a failure is a frame with no overlap; the next start is some frames later.
"""

from collections.abc import Callable, Iterable
from itertools import chain, repeat
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import AnyTracker, RunLog, one_thread
from tricue.evaluation.record import Record

RESTART_DELAY = 5  # frames from a failure to the next start
BURN_IN = 10  # frames after a start that don't count for accuracy, because the true box still helps
_NO_BOX = np.full(4, np.nan)


class Robustness(NamedTuple):
    """failures: how often the target was lost. frames: the number of frames in which it could be lost.
    accuracy: the mean overlap without the BURN_IN frames after each start, NaN if none are left.
    """

    failures: int
    frames: int
    accuracy: float


def run(
    make: Callable[[], AnyTracker],
    frames: Iterable[Frame],
    truth: NDArray[np.float64],
    compared: NDArray[np.float64] | None = None,
) -> Record:
    """Track with restarts. truth: (M, 4), boxes on which trackers start. compared: (M, 4), boxes that they
    must overlap, such as the truth's part in the image; by default the truth. Where it is NaN, and after M
    frames, no tracker starts or fails. Boxes are NaN where no tracker runs.
    """
    compared = truth if compared is None else compared
    log, starts, resume = RunLog(), [], 0
    tracker: AnyTracker | None = None
    with one_thread():
        labels = chain(zip(truth, compared, strict=True), repeat((_NO_BOX, _NO_BOX)))
        for frame, (start, true) in zip(frames, labels, strict=False):
            index, known = len(log.tracks), not np.isnan(true).any()
            if tracker is not None:
                track = log.update(tracker, frame)
                if known and not metrics.overlaps([track.box], [true])[0] > 0:
                    tracker, resume = None, index + RESTART_DELAY
            elif known and index >= resume:
                tracker = make()
                log.init(tracker, frame, Box(*start.tolist()))
                starts.append(index)
            else:
                log.skip()
    return Record(log.run, tuple(starts))


def robustness(record: Record, overlaps: NDArray[np.float64]) -> Robustness:
    """The robustness of a run with restarts, from its overlaps (M,) with the truth, NaN where unknown."""
    frames = np.arange(len(overlaps))
    last = np.searchsorted(record.starts, frames, side="right") - 1
    since = frames - np.array([*record.starts, -1])[last]
    counted = ~np.isnan(overlaps) & (since > 0) & ~_idle_frames(record, overlaps)
    failed = counted & (overlaps == 0)
    after_burn_in = counted & ~failed & (since >= BURN_IN)
    accuracy = float(overlaps[after_burn_in].mean()) if after_burn_in.any() else float("nan")
    return Robustness(int(failed.sum()), int(counted.sum()), accuracy)


def _idle_frames(record: Record, overlaps: NDArray[np.float64]) -> NDArray[np.bool_]:
    """The frames from a failure to the next start."""
    idle = np.ones(len(overlaps), dtype=np.bool_)
    ends = [*record.starts[1:], len(overlaps)]
    for start, end in zip(record.starts, ends, strict=True):
        failures = np.flatnonzero(overlaps[start + 1 : end] == 0)
        idle[start : start + 2 + int(failures[0]) if failures.size else end] = False
    return idle
