# SPDX-License-Identifier: MIT
"""``tricue track INPUT``: follow a target through a video and write down where it is."""

import dataclasses
import math
from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from itertools import takewhile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import tricue
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.sources import Source, open_source
from tricue.commands.calibrations import find_calibration
from tricue.commands.outputs import CsvOutput, JsonOutput, Output, Step, VideoOutput
from tricue.commands.progress import Progress
from tricue.commands.run import Clock, Start, steps, stoppable
from tricue.commands.starts import BOX, advice, choose_start, usual_tracker
from tricue.track.settings import make_tracker
from tricue.track.track import Status, Track, Tracker

INTERRUPTED = 130


class Run(NamedTuple):
    """What is run: the source, the tracker, and the camera's intrinsics, or the pair's rig, where known."""

    source: Source
    tracker: Tracker
    intrinsics: Intrinsics | None
    start: Start | None
    rig: StereoRig | None = None


def track(options: Namespace) -> int:
    """Run the verb and print what came out; the exit code."""
    run, notes = _prepare(options)
    clock, tracks = Clock(), {}
    with ExitStack() as files:
        outputs = [files.enter_context(output) for output in _outputs(options, run)]
        stop = files.enter_context(stoppable())
        progress = files.enter_context(Progress(run.source.length))
        frames = takewhile(lambda _: not stop(), run.source)
        for step in _advised(steps(run.tracker, frames, run.start, clock), run, clock):
            for output in outputs:
                output.write(step)
            tracks[step.number] = step.track
            progress(step.number + 1, clock.speeds)
        interrupted = stop()
    if not tracks and not interrupted:
        raise ValueError(_not_started(run, clock))
    _report(run.source, clock, tracks, interrupted)
    notes += [f"wrote {output.path}" for output in outputs]
    if options.plot:
        notes.append(_plot(options.plot, run, tracks))
    for note in notes:
        print(note)
    return INTERRUPTED if interrupted else 0


def _spare_the_input(place: Path | None, outputs: Sequence[Path | None]) -> None:
    for path in outputs:
        if path and place and path.exists() and place.exists() and path.samefile(place):
            raise ValueError(f"{path}: expected another file than the input to write to")


def _prepare(options: Namespace) -> tuple[Run, list[str]]:
    """Open the source and make the tracker; what the user should know about them."""
    if options.plot:
        from tricue.evaluation.paths import check_format

        check_format(options.plot)
    source = open_source(
        options.input,
        depth=options.depth,
        depth_scale=options.depth_scale,
        fps=options.fps,
        right=options.right,
    )
    options.tracker = options.tracker or usual_tracker(options, source)
    right = Path(options.right) if options.right else None
    for place in (Path(options.input), right, options.calibration, options.params):
        _spare_the_input(place, (options.output, options.csv, options.json, options.plot))
    found = find_calibration(options, source)
    source = found.prepared(source)
    tracker = make_tracker(
        options.tracker, options.params, options.set, options.seed, options.kernels, **found.keywords
    )
    # A tracker that wasn't told may assume a camera of its own.
    rig = found.rig
    known = rig.intrinsics if rig else found.intrinsics or getattr(tracker, "intrinsics", None)
    run = Run(source, tracker, known, choose_start(options, source, tracker), rig)
    return run, [*source.notes, *([found.note] if found.note else [])]


def _outputs(options: Namespace, run: Run) -> Iterator[Output]:
    """One after the other, so that the first is closed if the second can't be opened."""
    if options.output:
        yield VideoOutput(options.output, run.source.fps, run.rig)
    if options.csv:
        yield CsvOutput(options.csv)
    if options.json:
        yield JsonOutput(options.json, _about(options, run))


def _advised(found: Iterator[Step], run: Run, clock: Clock) -> Iterator[Step]:
    """The steps; where the tracker doesn't even start, the error says what to give it."""
    try:
        yield from found
    except ValueError as error:
        if clock.decoded == 1 and not any(clock.statuses.values()):
            raise ValueError(f"{error}{advice(str(error), run.source, run.tracker)}") from None
        raise


def _not_started(run: Run, clock: Clock) -> str:
    if clock.waiting:
        reason = f"the tracker started in none of {clock.decoded} frames: {clock.waiting}"
    else:
        reason = f"found no face in {clock.decoded} frames"
    return f"{run.source.name}: {reason}; {BOX}"


def _about(options: Namespace, run: Run) -> dict[str, Any]:
    return {
        "tricue": tricue.__version__,
        "source": run.source.name,
        "fps": run.source.fps,
        "tracker": options.tracker,
        "seed": options.seed,
        "kernels": options.kernels,
        "params": {name: _plain(value) for name, value in dataclasses.asdict(run.tracker.params).items()},
        "intrinsics": None if run.intrinsics is None else dataclasses.asdict(run.intrinsics),
        "baseline": None if run.rig is None else run.rig.baseline,
    }


def _plain(value: Any) -> Any:
    """JSON has no infinity."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _report(source: Source, clock: Clock, tracks: Mapping[int, Track], interrupted: bool) -> None:
    counts = ", ".join(f"{clock.statuses[status]} {status}" for status in Status)
    print(f"{source.name}: {clock.decoded} frames{' until interrupted' if interrupted else ''}, {counts}")
    print(clock.speeds)
    if first := min(tracks, default=0):
        print(f"started in frame {first}")
    if source.truth is not None and np.isfinite(source.truth[1:]).any():
        print(_score(source.truth, tracks, clock.decoded))


def _score(truth: Any, tracks: Mapping[int, Track], frames: int) -> str:
    """AUC and precision over the frames that were read and have a true box."""
    from tricue.evaluation import metrics

    count = min(len(truth), frames)
    found = np.full((count, 4), np.nan)
    for index, track in tracks.items():
        if index < count:
            found[index] = track.box
    score = metrics.score(found, truth[:count])
    return f"against the true boxes: AUC {score.auc:.3f}, precision at 20 px {score.precision:.3f}"


def _plot(path: Path, run: Run, tracks: Mapping[int, Track]) -> str:
    """Write the path seen from above; what came of it."""
    from tricue.evaluation.paths import save_path

    if all(track.position is None for track in tracks.values()):
        return f"{path}: not written, no track has a position in metres"
    save_path(path, tracks.values(), run.intrinsics)
    return f"wrote {path}"
