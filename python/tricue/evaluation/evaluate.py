# SPDX-License-Identifier: MIT
"""Evaluate trackers on a data set: run the missing tasks, reuse finished ones, and score all runs.

Finished runs are stored in a folder. An evaluation can be stopped at any time; the same call continues with
the missing runs and ends with the same numbers.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tricue.data.truth_check import find_doubts
from tricue.errors import one_line
from tricue.evaluation.attributes.measure import SequenceAttributes
from tricue.evaluation.dataset import Entry, OpenedSequence, ReadOptions, find_entries
from tricue.evaluation.eta import RemainingTime
from tricue.evaluation.foreign.spec import DEFAULT_TIME_LIMIT
from tricue.evaluation.protocols import ONE_PASS, RESTARTS, Order, orders
from tricue.evaluation.record import Record
from tricue.evaluation.restarts import Robustness
from tricue.evaluation.results_folder import ResultError, ResultsSpec, results_spec
from tricue.evaluation.rows import (
    Row,
    ScoredRun,
    Speed,
    make_row,
    measure_robustness,
    measure_speed,
    score_run,
    without_truth,
)
from tricue.evaluation.schedule import Perform, run_tasks
from tricue.evaluation.store import Store
from tricue.evaluation.tasks import Task, perform
from tricue.evaluation.tracker_spec import TrackerSpec
from tricue.evaluation.trackers import missing_note, require_unique, tracker_specs

RUNS = "runs"  # the folder of finished runs in an evaluation's folder


@dataclass(frozen=True)
class Options:
    """The options of an evaluation: what to run.

    trackers: names of ours, of the baselines and of others, such as ``mine.py:Mine``; None for all that are
    installed. settings: parameters that aren't the defaults, by tracker name. seeds: runs of each tracker
    that draws random numbers. restarts: whether to also run each with restarts. reading: how the data set's
    files are read. results: folders of others' results, NAME=FOLDER. time_limit: seconds for an update of a
    tracker that isn't ours. protocols: names of those to run in addition to one pass, see
    :mod:`tricue.evaluation.protocols`. TypeError for names that aren't a tuple or a list of strings.
    """

    trackers: tuple[str, ...] | None = None
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    seeds: int = 1
    restarts: bool = True
    reading: ReadOptions = field(default_factory=ReadOptions)
    results: tuple[str, ...] = ()
    time_limit: float = DEFAULT_TIME_LIMIT
    protocols: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name in ("trackers", "results", "protocols"):
            value: Any = getattr(self, name)
            several = isinstance(value, (tuple, list)) and all(isinstance(each, str) for each in value)
            if not several and (name, value) != ("trackers", None):
                raise TypeError(f"{name}: expected a tuple of names, got {value!r:.80}")

    @property
    def orders(self) -> dict[str, tuple[str, ...]]:
        """The kinds of the runs of each protocol, one pass first. ValueError for an unknown protocol."""
        names = dict.fromkeys((ONE_PASS, *self.protocols))
        return {name: tuple(order.name for order in orders(name)) for name in names}


class RunResult(NamedTuple):
    """A run compared with the truth, and its numbers."""

    task: Task
    scored: ScoredRun
    row: Row
    speed: Speed


@dataclass(frozen=True, repr=False)
class Evaluation:
    """The outcome of an evaluation. left_out: why a tracker didn't run on a sequence, by both names. failed:
    the errors of unreadable sequences and of failed tasks, by name. notes: lines about trackers and results.
    attributes: of the sequences, by name, if they were measured.
    """

    options: Options
    opened: tuple[OpenedSequence, ...]
    trackers: tuple[TrackerSpec, ...]
    results: tuple[RunResult, ...]
    left_out: Mapping[tuple[str, str], str]
    failed: Mapping[str, str]
    notes: tuple[str, ...] = ()
    attributes: Mapping[str, SequenceAttributes] = field(default_factory=dict)

    @property
    def groups(self) -> tuple[str, ...]:
        """The groups of sequences on which trackers can be compared, in the order of the sequences."""
        return tuple(dict.fromkeys(each.group for each in self.opened))

    @property
    def one_pass(self) -> list[RunResult]:
        """The results from the first true box to the end."""
        return [each for each in self.results if each.row.run == ONE_PASS]

    @property
    def recordings(self) -> dict[str, str]:
        """The recording of each sequence, by name: several targets may be in one recording."""
        return {each.entry.name: str(each.entry.place) for each in self.opened}

    @property
    def unstarted(self) -> dict[str, dict[str, list[str]]]:
        """The trackers that started on no sequence, because they couldn't be created or failed at their
        start: by tracker name, the sequences by reason.
        """
        found: dict[str, dict[str, list[str]]] = {}
        started = {each.row.tracker for each in self.results if not _start_error(each.scored)}
        for each in self.results:
            if each.row.tracker not in started:
                names = found.setdefault(each.row.tracker, {}).setdefault(_start_error(each.scored), [])
                if each.row.sequence not in names:
                    names.append(each.row.sequence)
        return found

    def of(self, group: str, tracker: str, protocol: str = ONE_PASS) -> list[RunResult]:
        """The results of one tracker on a group's sequences, with one protocol."""
        kinds = self.options.orders[protocol]
        return [
            each
            for each in self.results
            if (each.row.group, each.row.tracker) == (group, tracker) and each.row.run in kinds
        ]

    def __repr__(self) -> str:
        counts = {name: len(getattr(self, name)) for name in ("opened", "trackers", "results", "failed")}
        return f"Evaluation({', '.join(f'{name}=<{count}>' for name, count in counts.items())})"

    def _repr_html_(self) -> str:
        from tricue.notebook.results import evaluation_html

        return evaluation_html(self)


class ProgressUpdate(NamedTuple):
    """Progress after each run: finished and total runs, and the last task."""

    done: int
    total: int
    last: Task | None
    seconds_left: float | None


def evaluate(
    root: str | Path,
    folder: str | Path,
    options: Options = Options(),
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    fresh: bool = False,
    on_progress: Callable[["ProgressUpdate"], None] = lambda _: None,
    on_search: Callable[[int], None] = lambda _: None,
    work: Perform = perform,
) -> Evaluation:
    """Run on the data set at ``root`` what ``folder`` doesn't have yet, and score all runs.

    jobs, scheduler: as :func:`tricue.evaluation.schedule.run_tasks` takes them. fresh: whether to run
    everything again. on_progress: called after each run. on_search: gets the number of folders that were
    searched for sequences so far. ValueError or OSError, before the first run, for an unusable data set,
    folder or option.
    """
    plan = _Plan(Path(root), options, on_search)
    store = Store(Path(folder) / RUNS)
    store.prepare()
    failed = dict(plan.failed)
    for task in () if fresh else plan.missing:
        record = store.load(task, plan.fingerprint(task))
        if record and not task.tracker.outdated(record.error):
            plan.add(task, record)
    missing = sorted(plan.missing, key=plan.weight, reverse=True)
    remaining = RemainingTime(plan.weight, missing)
    done = len(plan.tasks) - len(missing)
    on_progress(ProgressUpdate(done, len(plan.tasks), None, None))
    with closing(run_tasks(missing, work, jobs, scheduler)) as results:
        for index, record, error in results:
            task = missing[index]
            if record is None:
                failed[task.name] = error
            else:
                store.save(task, plan.fingerprint(task), record)
                plan.add(task, record)
            done += 1
            on_progress(ProgressUpdate(done, len(plan.tasks), task, remaining.update(task)))
    return plan.evaluation(failed)


class _Plan:
    """The tasks of an evaluation, and the sequences that they run on."""

    def __init__(self, root: Path, options: Options, on_search: Callable[[int], None]) -> None:
        self.options = options
        kinds = {kind: Order.named(kind) for each in options.orders.values() for kind in each}
        self._orders = {kind: order for kind, order in kinds.items() if kind != ONE_PASS}
        results = [results_spec(text) for text in options.results]
        specs = tracker_specs(options.trackers, options.settings, options.time_limit)
        self.trackers: tuple[TrackerSpec, ...] = (*specs, *results)
        require_unique(each.name for each in self.trackers)
        self.failed: dict[str, str] = {}
        self.opened = dict(self._open_all(find_entries(root, options.reading, on_search)))
        self.left_out: dict[tuple[str, str], str] = {}
        self.scored: dict[Task, tuple[ScoredRun, Speed]] = {}
        self.restarted: dict[Task, Robustness] = {}
        self._read: defaultdict[TrackerSpec, Counter[str]] = defaultdict(Counter)
        self._described = {spec: spec.description for spec in self.trackers}
        self._digests = {name: opened.digest for name, opened in self.opened.items()}
        self.tasks = [task for opened in self.opened.values() for task in self._list_tasks(opened)]

    def _open_all(self, entries: Sequence[Entry]) -> Iterator[tuple[str, OpenedSequence]]:
        """Yield the readable sequences; if there is none, raise the first one's error."""
        for entry in entries:
            opened = _try_open(entry)
            if isinstance(opened, OpenedSequence):
                yield entry.name, opened
            else:
                self.failed[entry.name] = one_line(opened)
        if len(self.failed) == len(entries):
            raise ValueError(next(iter(self.failed.values())))

    def _list_tasks(self, opened: OpenedSequence) -> list[Task]:
        kinds = [kind for kind, order in self._orders.items() if len(order.seen(opened))]
        kinds = [ONE_PASS, *([RESTARTS] if self.options.restarts else []), *kinds]
        tasks = []
        for spec in self.trackers:
            if reason := spec.unsupported_reason(opened):
                self.left_out[spec.name, opened.entry.name] = reason
                continue
            if isinstance(spec, ResultsSpec):
                tasks += self._add_results(spec, opened)
                continue
            seeds = range(self.options.seeds if spec.random else 1)
            tasks += [Task(spec, opened.entry, seed, kind) for kind in kinds for seed in seeds]
        return tasks

    def _add_results(self, spec: ResultsSpec, opened: OpenedSequence) -> list[Task]:
        """Score others' runs on a sequence, each as one seed's; return their finished tasks."""
        try:
            found = spec.read(opened, self.opened)
        except (OSError, ResultError) as error:
            self.left_out[spec.name, opened.entry.name] = one_line(error)
            return []
        self._read[spec][found.about] += 1
        tasks = [Task(spec, opened.entry, seed) for seed in range(len(found.records))]
        for task, record in zip(tasks, found.records, strict=True):
            self.add(task, record)
            if found.supervised:
                run, speed = self.scored[task]
                self.scored[task] = without_truth(run), speed
                self.add(replace(task, kind=RESTARTS), record)
        return tasks

    @property
    def missing(self) -> list[Task]:
        """The tasks that haven't been run."""
        return [task for task in self.tasks if task not in self.scored and task not in self.restarted]

    def fingerprint(self, task: Task) -> str:
        return task.fingerprint(self._digests[task.entry.name], self._described[task.tracker])

    def weight(self, task: Task) -> float:
        """The relative duration of a task; long tasks start first, so that all processes end together."""
        opened = self.opened[task.entry.name]
        frames = float(opened.source.length or len(opened.boxes))
        if task.kind in self._orders:
            frames = float(len(self._orders[task.kind].seen(opened)))
        return frames * task.tracker.relative_time

    def add(self, task: Task, record: Record) -> None:
        """Score a finished run and keep only its scores, to limit memory."""
        opened = self.opened[task.entry.name]
        if task.kind == RESTARTS:
            self.restarted[task] = measure_robustness(record, opened)
        else:
            speed = measure_speed(opened, task.tracker.name, task.seed, record.run, task.kind)
            self.scored[task] = score_run(record, opened), speed

    def evaluation(self, failed: Mapping[str, str]) -> Evaluation:
        """The results so far, in the order of the tasks."""
        results = tuple(self._results())
        opened = tuple(self.opened.values())
        notes = (
            missing_note(self.options.trackers),
            *self._results_notes(),
            *self._truth_notes(),
            *self._unknown_notes(),
        )
        return Evaluation(
            self.options, opened, self.trackers, results, self.left_out, failed, tuple(filter(None, notes))
        )

    def _results_notes(self) -> Iterator[str]:
        """How each folder of results was read, and on how many sequences."""
        for spec in self.trackers:
            if isinstance(spec, ResultsSpec):
                count, total = self._read[spec].total(), len(self.opened)
                how = ["; or ".join(self._read[spec])] if count else []
                yield ", ".join(
                    [f"{spec.name}: results in {spec.form} form", f"{count} of {total} sequences", *how]
                )

    def _truth_notes(self) -> Iterator[str]:
        """The sequences that have true boxes after their last frame, or doubtful ones."""
        seen: dict[str, int] = {}  # frames of videos, whose length only runs show
        for task, (run, _) in self.scored.items():
            if task.kind == ONE_PASS and not isinstance(task.tracker, ResultsSpec):
                seen[task.entry.name] = run.start + len(run.scores)
        for name, opened in self.opened.items():
            frames = opened.source.length or seen.get(name)
            if frames is not None and (more := len(opened.boxes) - frames) > 0:
                rows = "1 row" if more == 1 else f"{more} rows"
                yield f"{name}: {rows} of true boxes more than there are frames"
            with suppress(OSError, ValueError):  # of images that can't be read, which failed runs tell
                yield from (f"{name}: {doubt}" for doubt in find_doubts(opened.source, opened.size, frames))

    def _unknown_notes(self) -> Iterator[str]:
        """The sequences of which only the first true box is known, such as those of test sets."""
        for name, opened in self.opened.items():
            if np.isnan(opened.boxes[opened.start + 1 : opened.source.length]).any(axis=1).all():
                yield f"{name}: only the first true box is known, on which trackers start: no overlap counts"

    def _results(self) -> Iterator[RunResult]:
        for task in self.tasks:
            if task in self.scored:
                run, speed = self.scored[task]
                again = replace(task, kind=RESTARTS)
                robustness = self.restarted.get(again) if task.kind == ONE_PASS else None
                opened, tracker = self.opened[task.entry.name], task.tracker.name
                row = make_row(opened, tracker, task.seed, run, robustness, task.kind)
                yield RunResult(task, run, row, speed)


def _start_error(run: ScoredRun) -> str:
    """Why a tracker didn't start; "" if it did, even if it failed later."""
    first = f"frame {run.start}: "
    return run.error.removeprefix(first) if run.error.startswith(first) else ""


def _try_open(entry: Entry) -> OpenedSequence | OSError | ValueError:
    """The opened entry, or the error if it can't be opened or has no frame to start in."""
    try:
        opened = entry.open()
        opened.check()
        return opened
    except (OSError, ValueError) as error:
        return error
