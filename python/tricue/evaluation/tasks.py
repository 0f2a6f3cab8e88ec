# SPDX-License-Identifier: MIT
"""The unit of work: one tracker on one sequence from one seed, in one kind of run.

A task contains everything its result depends on, so that it can run in any process and be found again.
"""

import hashlib
from collections.abc import Iterable, Sequence
from contextlib import closing, nullcontext
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.data.prefetch import prefetch
from tricue.evaluation import one_pass, protocols, restarts
from tricue.evaluation.dataset import Entry, OpenedSequence
from tricue.evaluation.protocols import ONE_PASS, RESTARTS, Order
from tricue.evaluation.record import Record
from tricue.evaluation.safe_tracker import SafeTracker
from tricue.evaluation.tracker_spec import Make, TrackerSpec

_RESULT_SOURCES = (
    *("_core*.so", "_core*.pyd", "kernels.py", "reference/**/*.py", "track/**/*.py"),
    *("camera/**/*.py", "data/**/*.py", "imgproc.py", "errors.py", "arrays.py"),
    *("draw/canvas.py", "draw/depth_pictures.py"),  # depth as the baselines see it
    *(f"evaluation/{name}.py" for name in ("tasks", "dataset", "frame_views", "one_pass", "restarts")),
    *(f"evaluation/{name}.py" for name in ("tracker_spec", "safe_tracker", "baselines", "foreign/*")),
    *(f"evaluation/{name}.py" for name in ("metrics", "record")),
    *(f"evaluation/toolkits/{name}.py" for name in ("trax_client", "trax_server", "millimeters")),
)
"""Files on which a run depends: everything that this module and ``foreign`` import. They are listed so that
code that only scores runs may change. ``protocols`` counts only for its own runs (:meth:`Task.fingerprint`).
"""


@dataclass(frozen=True)
class Task:
    """A run to perform. kind: RESTARTS, restarted after each failure, or the name of a
    :class:`protocols.Order`, such as ONE_PASS, from the first true box to the end.
    """

    tracker: TrackerSpec
    entry: Entry
    seed: int = 0
    kind: str = ONE_PASS

    @property
    def name(self) -> str:
        """Unique among the tasks of an evaluation; a relative path."""
        return f"{self.kind}/{self.tracker.name}/{self.entry.name}/seed-{self.seed}"

    def fingerprint(self, digest: str, description: str) -> str:
        """A hash of everything the result depends on. digest: the opened entry's; description: the tracker
        spec's.
        """
        known = () if self.kind in (ONE_PASS, RESTARTS) else (_digest_of(Path(protocols.__file__)),)
        versions = cv2.__version__, np.__version__  # they decode images and draw random numbers
        parts = (self.name, digest, description, code_digest(), *versions, *known)
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def perform(task: Task, ahead: int = 0) -> Record:
    """Run the task. Errors of the tracker are part of the record; ValueError or OSError if the sequence can't
    be read.

    ahead: how many frames a second thread may read in advance. It doesn't change the results, only, slightly,
    the times.
    """
    opened = task.entry.open()
    ordered = task.kind not in (ONE_PASS, RESTARTS)
    source = protocols.read_frames(opened.source, _numbers(task, opened)) if ordered else opened.source
    frames = map(task.tracker.view(opened), source)
    with (
        closing(prefetch(frames, ahead)) if ahead else nullcontext(frames) as prefetched,
        task.tracker.session(opened) as make,
    ):
        run = _run_in_order if ordered else _run_with_restarts if task.kind == RESTARTS else _run_one_pass
        return run(make, task, opened, prefetched)


def _numbers(task: Task, opened: OpenedSequence) -> NDArray[np.intp]:
    return Order.named(task.kind).seen(opened)


def _run_one_pass(make: Make, task: Task, opened: OpenedSequence, frames: Iterable[Frame]) -> Record:
    """Start in the first frame with a true box, which may not be the first image."""
    tracker, start = make(task.seed), opened.start
    run = one_pass.run(tracker, frames, Box(*opened.boxes[start].tolist()), start)
    return Record(run, (start,), _error([tracker], (start,)))


def _run_in_order(make: Make, task: Task, opened: OpenedSequence, frames: Iterable[Frame]) -> Record:
    """Start in the first of the order's frames with a true box; those before it aren't read."""
    numbers, noise = _numbers(task, opened), Order.named(task.kind).noise
    box = Box(*opened.boxes[numbers[0]].tolist())
    if noise:
        box = protocols.jittered(box, task.entry.name, noise)
    tracker = make(task.seed)
    run = one_pass.run(tracker, frames, box)
    return Record(run, (0,), _error([tracker], (0,), numbers), tuple(numbers.tolist()))


def _run_with_restarts(make: Make, task: Task, opened: OpenedSequence, frames: Iterable[Frame]) -> Record:
    made: list[SafeTracker] = []

    def make_next() -> SafeTracker:
        made.append(make(task.seed + len(made)))
        return made[-1]

    record = restarts.run(make_next, frames, opened.boxes, opened.clip(opened.boxes))
    return Record(record.run, record.starts, _error(made, record.starts))


def _error(
    trackers: Sequence[SafeTracker], starts: Sequence[int], numbers: NDArray[np.intp] | None = None
) -> str:
    """The first error, with its frame; "" without any. starts: each tracker's first frame in the run.
    numbers: the frames of the run, None for all.
    """
    errors = (
        (start + tracker.updates, tracker.error)
        for tracker, start in zip(trackers, starts, strict=True)
        if tracker.error
    )
    for index, error in errors:
        return f"frame {index if numbers is None else numbers[index]}: {error}"
    return ""


@cache
def _digest_of(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


@cache
def code_digest() -> str:
    """A hash of the code that determines the results; after a change, old results aren't reused."""
    root, found = Path(tricue.__file__).parent, hashlib.sha256()
    for path in sorted({path for pattern in _RESULT_SOURCES for path in root.glob(pattern)}):
        found.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
    return found.hexdigest()
