# SPDX-License-Identifier: MIT
"""Trackers over a data set: what is to be run, what of it was run before, and what came of it.

An evaluation is its folder of finished runs. It can be stopped at any time; the same call goes on with the
runs that are missing, and ends with the same numbers.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

from tricue.errors import one_line
from tricue.evaluation.dataset import Entry, Opened, Reading, find_entries
from tricue.evaluation.eta import Remaining
from tricue.evaluation.record import Record
from tricue.evaluation.rows import Row, ScoredRun, Speed, judged, robustness_of, row_of, speed_of
from tricue.evaluation.schedule import Perform, completed
from tricue.evaluation.store import Store
from tricue.evaluation.tasks import ONE_PASS, RESTARTS, Task, perform
from tricue.evaluation.tracker_spec import TrackerSpec, tracker_specs

RUNS = "runs"  # the folder of finished runs in an evaluation's


@dataclass(frozen=True)
class Options:
    """What is run.

    trackers: names of ours and of the baselines, None for all. settings: parameters that aren't the defaults,
    by our trackers' names. seeds: runs of those that draw random numbers. restarts: whether each is also run
    with restarts. reading: how the data set's files are read.
    """

    trackers: tuple[str, ...] | None = None
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    seeds: int = 1
    restarts: bool = True
    reading: Reading = field(default_factory=Reading)


class Result(NamedTuple):
    """A run in one pass against the truth, and its numbers."""

    task: Task
    judged: ScoredRun
    row: Row
    speed: Speed


@dataclass(frozen=True)
class Evaluation:
    """All that is known at the end. left_out: why a tracker didn't run on a sequence, by both names. failed:
    the errors of what couldn't be read, by the names of sequences or tasks.
    """

    options: Options
    opened: tuple[Opened, ...]
    trackers: tuple[TrackerSpec, ...]
    results: tuple[Result, ...]
    left_out: Mapping[tuple[str, str], str]
    failed: Mapping[str, str]

    @property
    def groups(self) -> tuple[str, ...]:
        """The groups of sequences on which trackers can be compared, in the order of the sequences."""
        return tuple(dict.fromkeys(each.group for each in self.opened))

    def of(self, group: str, tracker: str) -> list[Result]:
        """The results of one tracker on the sequences of a group."""
        return [each for each in self.results if (each.row.group, each.row.tracker) == (group, tracker)]


class Told(NamedTuple):
    """How far it is, told after each run: of how many runs how many are done, and the last."""

    done: int
    total: int
    last: Task | None
    seconds_left: float | None


def evaluate(
    root: Path,
    folder: Path,
    options: Options = Options(),
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    fresh: bool = False,
    tell: Callable[["Told"], None] = lambda told: None,
    work: Perform = perform,
) -> Evaluation:
    """Run all that is missing in ``folder`` of the data set at ``root``, and judge all of it.

    jobs, scheduler: as :func:`schedule.completed` takes them. fresh: whether to run all again. tell: hears of
    the progress. ValueError or OSError for a data set or options that can't be used.
    """
    plan = _Plan(root, options)
    store = Store(folder / RUNS)
    failed = dict(plan.failed)
    for task in () if fresh else plan.tasks:
        if record := store.load(task, plan.fingerprint(task)):
            plan.take(task, record)
    missing = sorted((task for task in plan.tasks if task not in plan.taken), key=plan.weight, reverse=True)
    remaining = Remaining(plan.weight, missing)
    done = len(plan.taken)
    tell(Told(done, len(plan.tasks), None, None))
    with closing(completed(missing, work, jobs, scheduler)) as results:
        for index, record, error in results:
            task = missing[index]
            if record is None:
                failed[task.name] = error
            else:
                store.save(task, plan.fingerprint(task), record)
                plan.take(task, record)
            done += 1
            tell(Told(done, len(plan.tasks), task, remaining.after(task)))
    return plan.evaluation(failed)


class _Plan:
    """The tasks of an evaluation, and the sequences that they run on."""

    def __init__(self, root: Path, options: Options) -> None:
        self.options = options
        self.trackers = tuple(tracker_specs(options.trackers, options.settings))
        self.failed: dict[str, str] = {}
        self.opened = dict(self._opened(find_entries(root, options.reading)))
        self.left_out: dict[tuple[str, str], str] = {}
        self.taken: dict[Task, Any] = {}
        self._described = {spec: spec.described for spec in self.trackers}
        self._digests = {name: opened.digest for name, opened in self.opened.items()}
        self.tasks = [task for opened in self.opened.values() for task in self._tasks(opened)]

    def _opened(self, entries: Sequence[Entry]) -> Iterator[tuple[str, Opened]]:
        """Those that can be read; where none can, the first one's error is raised."""
        for entry in entries:
            opened = _tried(entry)
            if isinstance(opened, Opened):
                yield entry.name, opened
            else:
                self.failed[entry.name] = one_line(opened)
        if len(self.failed) == len(entries):
            raise ValueError(next(iter(self.failed.values())))

    def _tasks(self, opened: Opened) -> list[Task]:
        kinds = (ONE_PASS, RESTARTS) if self.options.restarts else (ONE_PASS,)
        tasks = []
        for spec in self.trackers:
            if why := spec.refuses(opened):
                self.left_out[spec.name, opened.entry.name] = why
                continue
            seeds = range(self.options.seeds if spec.random else 1)
            tasks += [Task(spec, opened.entry, seed, kind) for kind in kinds for seed in seeds]
        return tasks

    def fingerprint(self, task: Task) -> str:
        return task.fingerprint(self._digests[task.entry.name], self._described[task.tracker])

    def weight(self, task: Task) -> float:
        """How long a task may take, beside others: long ones begin first, so that none is left over."""
        opened = self.opened[task.entry.name]
        source = opened.source
        return float(source.length or len(opened.boxes)) * task.tracker.slowness

    def take(self, task: Task, record: Record) -> None:
        """Judge a finished run, of which no more is kept than that needs: there may be many long ones."""
        opened = self.opened[task.entry.name]
        if task.kind == RESTARTS:
            self.taken[task] = robustness_of(record, opened)
        else:
            speed = speed_of(opened, task.tracker.name, task.seed, record.run)
            self.taken[task] = judged(record, opened), speed

    def evaluation(self, failed: Mapping[str, str]) -> Evaluation:
        """What was taken, in the order of the tasks."""
        results = tuple(self._results())
        opened = tuple(self.opened.values())
        return Evaluation(self.options, opened, self.trackers, results, self.left_out, failed)

    def _results(self) -> Iterator[Result]:
        for task in self.tasks:
            if task.kind == ONE_PASS and task in self.taken:
                run, speed = self.taken[task]
                fails = self.taken.get(replace(task, kind=RESTARTS))
                row = row_of(self.opened[task.entry.name], task.tracker.name, task.seed, run, fails)
                yield Result(task, run, row, speed)


def _tried(entry: Entry) -> Opened | OSError | ValueError:
    """The entry opened, with a frame to start in, or what is wrong with it."""
    try:
        opened = entry.open()
        opened.check()
        return opened
    except (OSError, ValueError) as error:
        return error
