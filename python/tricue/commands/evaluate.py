# SPDX-License-Identifier: MIT
"""``tricue evaluate DATASET``: trackers over many sequences, tables and a report."""

import sys
from argparse import Namespace
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

from tricue.commands.progress import Progress
from tricue.evaluation import tables
from tricue.evaluation.dataset import Reading
from tricue.evaluation.evaluate import Evaluation, Options, Told, evaluate
from tricue.evaluation.report import vector
from tricue.evaluation.report.page import write_report
from tricue.evaluation.tasks import perform
from tricue.track.settings import read_settings

FAILED = 1


def run(options: Namespace) -> int:
    """Run the verb: progress on stderr, the table on stdout; the exit code is 1 if a sequence couldn't be
    read.
    """
    vector.require()  # now, not after hours
    folder: Path = options.output
    chosen = Options(
        trackers=tuple(options.trackers) if options.trackers else None,
        settings=settings_by_tracker(options.set),
        seeds=options.seeds,
        restarts=not options.no_restarts,
        reading=Reading(options.depth_scale, options.fps, options.unit, options.truth),
    )
    with Progress() as progress:

        def tell(told: Told) -> None:
            progress.total = told.total
            progress(told.done, _left(told))

        try:
            evaluation = evaluate(
                options.dataset,
                folder,
                chosen,
                jobs=options.jobs,
                fresh=options.fresh,
                scheduler=options.scheduler,
                tell=tell,
                work=partial(perform, ahead=options.ahead),
            )
        except KeyboardInterrupt:
            print(f"what is finished is in {folder}; the same command goes on", file=sys.stderr)
            raise
    return _report(evaluation, folder, options)


def settings_by_tracker(settings: Sequence[str]) -> dict[str, dict[str, Any]]:
    """Parameters by tracker from strings tracker.name=value."""
    found: dict[str, list[str]] = {}
    for setting in settings:
        tracker, dot, rest = setting.partition(".")
        if not dot or "=" in tracker:
            raise ValueError(f"--set: expected tracker.name=value, got {setting!r}")
        found.setdefault(tracker, []).append(rest)
    return {tracker: read_settings(tracker, None, each) for tracker, each in found.items()}


def _report(evaluation: Evaluation, folder: Path, options: Namespace) -> int:
    about = tables.settings(evaluation, dataset=str(options.dataset), jobs=options.jobs)
    written = [*tables.write(evaluation, folder, about), write_report(evaluation, folder, about)]
    print(tables.markdown(evaluation))
    for each in evaluation.results:
        if each.row.trouble:
            print(f"{each.row.tracker} on {each.row.sequence}, seed {each.row.seed}: {each.row.trouble}")
    for name, error in evaluation.failed.items():
        print(f"failed: {name}: {error}", file=sys.stderr)
    for path in written:
        print(f"wrote {path}")
    return FAILED if evaluation.failed else 0


def _left(told: Told) -> str:
    if told.last is None or told.seconds_left is None:
        return ""
    minutes, seconds = divmod(round(told.seconds_left), 60)
    return f"{minutes}:{seconds:02d} left, {told.last.entrant.name} {told.last.entry.name}"
