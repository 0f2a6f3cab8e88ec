# SPDX-License-Identifier: MIT
"""The unit of work: one tracker on one sequence from one seed, in one of two kinds of run.

A task says all that its result depends on, so that it can be run in any process, and its result be found
again.
"""

import hashlib
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import tricue
from tricue.camera.box import Box
from tricue.evaluation import one_pass, restarts
from tricue.evaluation.dataset import Entry, Opened
from tricue.evaluation.entrants import Entrant, Guarded
from tricue.evaluation.record import Record

ONE_PASS, RESTARTS = "one-pass", "restarts"
_DECIDING = (
    *("_core*.so", "_core*.pyd", "camera/**/*.py", "reference/**/*.py", "track/**/*.py"),
    *(f"evaluation/{name}.py" for name in ("entrants", "one_pass", "peers", "restarts")),
)


@dataclass(frozen=True)
class Task:
    """kind: ONE_PASS, from the first true box to the end, or RESTARTS, started again after each failure."""

    entrant: Entrant
    entry: Entry
    seed: int = 0
    kind: str = ONE_PASS

    @property
    def name(self) -> str:
        """Unique among the tasks of an evaluation; a relative path."""
        return f"{self.kind}/{self.entrant.name}/{self.entry.name}/seed-{self.seed}"

    def fingerprint(self, digest: str, described: str) -> str:
        """Changes with all that the result depends on; digest: the opened entry's; described: the entrant."""
        parts = (self.name, digest, described, code_digest())
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def perform(task: Task) -> Record:
    """Run the task. What the tracker raises is part of the record; ValueError or OSError where the sequence
    can't be read.
    """
    opened = task.entry.open()
    return _restarted(task, opened) if task.kind == RESTARTS else _one_pass(task, opened)


def _one_pass(task: Task, opened: Opened) -> Record:
    """From the first frame with a true box, which hand-made truth may have later than the images."""
    tracker, start = task.entrant.contender(opened, task.seed), opened.start
    frames = map(task.entrant.view(opened), opened.source)
    run = one_pass.run(tracker, frames, Box(*opened.boxes[start].tolist()), start)
    return Record(run, (start,), tracker.trouble)


def _restarted(task: Task, opened: Opened) -> Record:
    made: list[Guarded] = []

    def make() -> Guarded:
        made.append(task.entrant.contender(opened, task.seed + len(made)))
        return made[-1]

    record = restarts.run(make, map(task.entrant.view(opened), opened.source), opened.boxes)
    return replace(record, trouble=next((tracker.trouble for tracker in made if tracker.trouble), ""))


@cache
def code_digest() -> str:
    """Of the code that decides what our trackers say: a change of it is no reason to trust old results."""
    root, found = Path(tricue.__file__).parent, hashlib.sha256()
    for path in sorted({path for pattern in _DECIDING for path in root.glob(pattern)}):
        found.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
    return found.hexdigest()
