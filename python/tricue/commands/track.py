# SPDX-License-Identifier: MIT
"""``tricue track INPUT``: follow a target through a video and write down where it is."""

import ast
import dataclasses
import math
from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from itertools import takewhile
from pathlib import Path
from typing import Any

import numpy as np

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.sources import Source, open_source
from tricue.commands.outputs import CsvOutput, JsonOutput, Output, Step, VideoOutput
from tricue.commands.progress import Progress
from tricue.commands.run import Clock, Start, steps, stoppable
from tricue.track.create import create, tracker_class
from tricue.track.track import Status, Tracker

INTERRUPTED = 130


def track(options: Namespace) -> int:
    """Run the verb and print what came out; the exit code."""
    tracker = make_tracker(options.tracker, options.params, options.set, options.seed, options.kernels)
    source = open_source(options.input)
    _spare_the_input(Path(options.input), (options.output, options.csv, options.json))
    clock, boxes = Clock(), {}
    with ExitStack() as files:
        outputs = [files.enter_context(output) for output in _outputs(options, source, tracker)]
        stop = files.enter_context(stoppable())
        progress = files.enter_context(Progress(source.length))
        frames = takewhile(lambda _: not stop(), source)
        for step in _hinted(steps(tracker, frames, _start(options, source), clock), clock):
            for output in outputs:
                output.write(step)
            boxes[step.number] = step.track.box
            progress(step.number + 1, clock.speeds)
        interrupted = stop()
    _report(source, clock, boxes, [output.path for output in outputs], interrupted)
    return INTERRUPTED if interrupted else 0


def make_tracker(
    name: str, params_file: Path | None, settings: Sequence[str], seed: int, kernels: str
) -> Tracker:
    """The tracker with parameters of a TOML file, overridden by settings "name=value"."""
    values: dict[str, Any] = {}
    if params_file is not None:
        values = dataclasses.asdict(tracker_class(name).Params.from_toml(params_file))
    return create(name, **{**values, **parse_settings(settings)}, seed=seed, kernels=kernels)


def parse_settings(settings: Sequence[str]) -> dict[str, Any]:
    """Keywords from strings name=value: numbers, true, false, tuples such as 16,20; the rest as text."""
    pairs = [setting.partition("=") for setting in settings]
    for name, equals, _ in pairs:
        if not (equals and name.isidentifier()):
            raise ValueError(f"--set: expected name=value, got {name + equals!r}")
    return {name: _literal(text.strip()) for name, _, text in pairs}


def _literal(text: str) -> Any:
    try:
        return ast.literal_eval(text.title() if text in ("true", "false") else text)
    except (ValueError, SyntaxError):
        return text


def _spare_the_input(place: Path, outputs: Sequence[Path | None]) -> None:
    for path in outputs:
        if path is not None and path.exists() and place.exists() and path.samefile(place):
            raise ValueError(f"{path}: expected another file than the input to write to")


def _outputs(options: Namespace, source: Source, tracker: Tracker) -> Iterator[Output]:
    """One after the other, so that the first is closed if the second can't be opened."""
    if options.output:
        yield VideoOutput(options.output, source.fps)
    if options.csv:
        yield CsvOutput(options.csv)
    if options.json:
        yield JsonOutput(options.json, _about(options, source, tracker))


def _hinted(found: Iterator[Step], clock: Clock) -> Iterator[Step]:
    """The steps; where the tracker doesn't even start, the error says how to give it another box."""
    try:
        yield from found
    except ValueError as error:
        if clock.decoded == 1 and not any(clock.statuses.values()):
            raise ValueError(f"{error}; give --box x,y,width,height or --detect face") from None
        raise


def _about(options: Namespace, source: Source, tracker: Tracker) -> dict[str, Any]:
    return {
        "tricue": tricue.__version__,
        "source": source.name,
        "fps": source.fps,
        "tracker": options.tracker,
        "seed": options.seed,
        "kernels": options.kernels,
        "params": {name: _plain(value) for name, value in dataclasses.asdict(tracker.params).items()},
    }


def _plain(value: Any) -> Any:
    """JSON has no infinity."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _start(options: Namespace, source: Source) -> Start | None:
    """How the tracker starts: on the given box, on a face, on the sequence's first true box, or by itself."""
    box = options.box or (None if options.detect else source.first_box)
    if box is not None:
        return lambda _: box
    if options.detect == "face":
        from tricue.commands.faces import find_face

        return lambda frame: _face(frame, find_face)
    return None


def _face(frame: Frame, find: Any) -> Box | None:
    if frame.color is None:
        raise ValueError("--detect face: expected color images")
    face: Box | None = find(frame.color)
    return face


def _report(
    source: Source, clock: Clock, boxes: Mapping[int, Box], paths: Sequence[Path], interrupted: bool
) -> None:
    if not boxes and not interrupted:
        raise ValueError(
            f"{source.name}: found no face in {clock.decoded} frames; give --box x,y,width,height"
        )
    counts = ", ".join(f"{clock.statuses[status]} {status}" for status in Status)
    print(f"{source.name}: {clock.decoded} frames{' until interrupted' if interrupted else ''}, {counts}")
    print(clock.speeds)
    if source.truth is not None:
        print(_score(source.truth, boxes, clock.decoded))
    for path in paths:
        print(f"wrote {path}")


def _score(truth: Any, boxes: Mapping[int, Box], frames: int) -> str:
    """AUC and precision over the frames that were read and have a true box."""
    from tricue.evaluation import metrics

    count = min(len(truth), frames)
    found = np.full((count, 4), np.nan)
    for index, box in boxes.items():
        if index < count:
            found[index] = box
    score = metrics.score(found, truth[:count])
    return f"against the true boxes: AUC {score.auc:.3f}, precision at 20 px {score.precision:.3f}"
