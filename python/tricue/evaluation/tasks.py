# SPDX-License-Identifier: MIT
"""The unit of work: one tracker on one sequence from one seed, in one of two kinds of run.

A task says all that its result depends on, so that it can be run in any process, and its result be found
again.
"""

import hashlib
from collections.abc import Iterable
from contextlib import closing, nullcontext
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.data.prefetch import prefetch
from tricue.evaluation import one_pass, restarts
from tricue.evaluation.dataset import Entry, Opened
from tricue.evaluation.record import Record
from tricue.evaluation.tracker_spec import SafeTracker, TrackerSpec

ONE_PASS, RESTARTS = "one-pass", "restarts"
_DECIDING = (
    *("_core*.so", "_core*.pyd", "camera/**/*.py", "data/**/*.py", "reference/**/*.py", "track/**/*.py"),
    *(f"evaluation/{name}.py" for name in ("tracker_spec", "one_pass", "baselines", "restarts")),
)


@dataclass(frozen=True)
class Task:
    """kind: ONE_PASS, from the first true box to the end, or RESTARTS, started again after each failure."""

    tracker: TrackerSpec
    entry: Entry
    seed: int = 0
    kind: str = ONE_PASS

    @property
    def name(self) -> str:
        """Unique among the tasks of an evaluation; a relative path."""
        return f"{self.kind}/{self.tracker.name}/{self.entry.name}/seed-{self.seed}"

    def fingerprint(self, digest: str, described: str) -> str:
        """Changes with all that the result depends on; digest: the opened entry's; described: the spec."""
        parts = (self.name, digest, described, code_digest())
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def perform(task: Task, ahead: int = 0) -> Record:
    """Run the task. What the tracker raises is part of the record; ValueError or OSError where the sequence
    can't be read.

    ahead: how many frames may be read before their turn, by a thread that takes part of another core. It
    changes no result, but the times a little.
    """
    opened = task.entry.open()
    frames = map(task.tracker.view(opened), opened.source)
    with closing(prefetch(frames, ahead)) if ahead else nullcontext(frames) as shown:
        return _restarted(task, opened, shown) if task.kind == RESTARTS else _one_pass(task, opened, shown)


def _one_pass(task: Task, opened: Opened, frames: Iterable[Frame]) -> Record:
    """From the first frame with a true box, which hand-made truth may have later than the images."""
    tracker, start = task.tracker.make(opened, task.seed), opened.start
    run = one_pass.run(tracker, frames, Box(*opened.boxes[start].tolist()), start)
    return Record(run, (start,), tracker.trouble)


def _restarted(task: Task, opened: Opened, frames: Iterable[Frame]) -> Record:
    made: list[SafeTracker] = []

    def make() -> SafeTracker:
        made.append(task.tracker.make(opened, task.seed + len(made)))
        return made[-1]

    record = restarts.run(make, frames, opened.boxes)
    return replace(record, trouble=next((tracker.trouble for tracker in made if tracker.trouble), ""))


@cache
def code_digest() -> str:
    """Of the code that decides what our trackers say: a change of it is no reason to trust old results."""
    root, found = Path(tricue.__file__).parent, hashlib.sha256()
    for path in sorted({path for pattern in _DECIDING for path in root.glob(pattern)}):
        found.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
    return found.hexdigest()
