# SPDX-License-Identifier: MIT
"""``tricue track INPUT``: tracks a target, or several, through a video and writes their positions."""

import argparse
import dataclasses
import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, redirect_stdout
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any

import tricue
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics
from tricue.cli.exports import CocoOutput, MotOutput
from tricue.cli.option_names import by_options
from tricue.cli.outputs import STANDARD_OUTPUT, CsvOutput, JsonLines, JsonOutput, Output, Step, VideoOutput
from tricue.cli.progress import Progress
from tricue.cli.signals import catch_signals
from tricue.cli.starts import in_options, start_hint
from tricue.cli.steps import RunClock, steps, steps_of_targets, with_known_tracks
from tricue.cli.track_options import EXAMPLES, add_options
from tricue.cli.track_preparation import TrackRun, prepare
from tricue.cli.track_report import (
    RunRecord,
    changed_size,
    not_started,
    plot,
    report,
    require_all_started,
)
from tricue.data.streams import image_names
from tricue.data.truth_check import find_doubts
from tricue.export.table import TableForm
from tricue.track.base.track import Track, Tracker
from tricue.track.multi.tracker import MultiTracker

__all__ = ["EXAMPLES", "add_options", "run"]


def run(options: argparse.Namespace) -> int:
    """Run the command and print the results; return the exit code."""
    run, notes = prepare(options)
    clock, record = RunClock(), RunRecord(run.source.fps)
    outputs, signal_number = _track(options, run, clock, record)
    interrupted = signal_number != 0
    if not record.tracks and not interrupted:
        raise ValueError(not_started(run, clock))
    with redirect_stdout(sys.stderr if options.json == STANDARD_OUTPUT else sys.stdout):
        report(run, clock, record, interrupted)
        results = _results(options, run, outputs, record.tracks.get(1, {}))
        doubts = find_doubts(run.source, clock.start_size, _length(run, clock, interrupted))
        for note in [*record.notes, *notes, *run.source.remarks, *doubts, *results]:
            print(by_options(note))
    if not interrupted:
        require_all_started(run, clock)
    return 128 + signal_number if interrupted else 0


def _track(
    options: argparse.Namespace, run: TrackRun, clock: RunClock, record: RunRecord
) -> tuple[list[Output], int]:
    """Track through all frames; the outputs that were written, and the signal that ended the run, or 0."""
    outputs: list[Output] = []
    with ExitStack() as files:
        stop = files.enter_context(catch_signals())
        progress = files.enter_context(Progress(run.stated_frames))
        frames = stop.until_caught(islice(run.source, run.first, run.end))
        targets = None if run.targets is None else files.enter_context(run.targets)
        for step in stop.unless_stuck(_steps(run, targets, frames, clock)):
            if not record.tracks:  # only now, so that a run that never starts keeps an earlier one's files
                outputs.extend(map(files.enter_context, _outputs(options, run, clock)))
            for output in outputs:
                output.write(step)
            record.add(step)
            progress(step.number + 1 - run.first, clock.speeds)
        return outputs, stop()


def _steps(
    run: TrackRun, targets: MultiTracker | None, frames: Iterator[Frame], clock: RunClock
) -> Iterator[Step]:
    """The tracked frames, fit for the outputs. targets: those of the run, open; None for one."""
    if targets is None:
        found = steps(run.tracker, frames, run.start, clock, run.first)
    else:
        found = steps_of_targets(targets, frames, run.boxes, clock, run.first)
    return with_known_tracks(map(run.known, _with_hints(found, run, clock)))


def _with_hints(found: Iterator[Step], run: TrackRun, clock: RunClock) -> Iterator[Step]:
    """The steps; an error of the tracker's start gets a hint about how to fix it, and one of a frame of
    another size names it.
    """
    try:
        yield from found
    except ValueError as error:
        if clock.decoded == 1 and not any(clock.statuses.values()):
            errors = [each for each in (error, error.__cause__) if isinstance(each, ValueError)]
            hint = next(
                filter(None, (start_hint(each, run.source, run.tracker, run.first) for each in errors)), ""
            )
            raise ValueError(f"{in_options(str(error))}{hint}") from None
        if clock.last_size != clock.start_size:
            raise ValueError(changed_size(run, clock)) from None
        raise


def _length(run: TrackRun, clock: RunClock, interrupted: bool) -> int | None:
    """The number of the source's frames; None if unknown, as of a video that wasn't read to its end."""
    if run.source.length is not None or interrupted or run.end is not None:
        return run.source.length
    return run.first + clock.decoded


def _outputs(options: argparse.Namespace, run: TrackRun, clock: RunClock) -> Iterator[Output]:
    """Open the outputs one at a time, so that the first is closed if the second can't be opened."""
    if options.output:
        yield VideoOutput(
            options.output, run.source.fps, run.rig, run.assumed, run.frames, options.trail, run.first
        )
    world = run.intrinsics is not None and run.intrinsics.pose is not None
    form = TableForm(world, run.targets is not None, run.assumed)
    rate = partial(clock.rate, run.source)
    if options.csv:
        yield CsvOutput(options.csv, form)
    if options.json == STANDARD_OUTPUT:
        yield JsonLines(form)
    elif options.json:
        yield JsonOutput(options.json, _about(options, run), rate, form)
    if options.mot:
        yield MotOutput(options.mot, positions=not run.assumed)
    if options.coco:
        names = image_names(run.source.channels)
        yield CocoOutput(options.coco, Path(run.source.name).name, rate, names)


def _results(
    options: argparse.Namespace, run: TrackRun, outputs: Sequence[Output], first: Mapping[int, Track]
) -> Iterator[str]:
    """Lines on what was written. first: the first target's tracks by frame, for the plot."""
    yield from (f"wrote {output.about}" for output in outputs if output.about)
    if options.plot:
        yield plot(options.plot, run, first)


def _about(options: argparse.Namespace, run: TrackRun) -> dict[str, Any]:
    return {
        "tricue": tricue.__version__,
        "source": run.source.name,
        "tracker": options.tracker,
        "seed": options.seed,
        "kernels": options.kernels,
        "params": {name: _plain(value) for name, value in _params(run.tracker).items()},
        "intrinsics": None if run.intrinsics is None else _camera(run.intrinsics),
        **({"intrinsics_assumed": True} if run.assumed else {}),
        "baseline": None if run.rig is None else run.rig.baseline,
    }


def _camera(camera: Intrinsics) -> dict[str, Any]:
    """The camera's numbers; its pose only if it has one."""
    return {name: value for name, value in dataclasses.asdict(camera).items() if value is not None}


def _params(tracker: Tracker) -> dict[str, Any]:
    """The parameters by name; a third-party tracker's are its keywords."""
    params = tracker.params
    return dict(params) if isinstance(params, dict) else dataclasses.asdict(params)


def _plain(value: Any) -> Any:
    """A value for JSON, which has no infinity."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
