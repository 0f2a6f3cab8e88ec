# SPDX-License-Identifier: MIT
"""``tricue track INPUT``: tracks a target, or several, through a video and writes their positions."""

import argparse
import dataclasses
import math
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, redirect_stdout
from itertools import islice, takewhile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import tricue
from tricue.camera.box import Box
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.cli.arguments import (
    StartBox,
    add_common,
    add_topics,
    angles,
    count,
    frame_number,
    start_box,
    tracker_name,
)
from tricue.cli.calibrations import find_calibration
from tricue.cli.exports import CocoOutput, MotOutput
from tricue.cli.lost_ranges import LostRanges
from tricue.cli.outputs import STANDARD_OUTPUT, CsvOutput, JsonLines, JsonOutput, Output, Step, VideoOutput
from tricue.cli.progress import Progress
from tricue.cli.signals import catch_signals
from tricue.cli.source_options import add_source_options, open_input, opening
from tricue.cli.starts import (
    BOX_HINT,
    DEFAULT_TRACKER,
    choose_start,
    default_tracker,
    depth_tracker,
    start_hint,
)
from tricue.cli.steps import RunClock, Start, steps, steps_of_targets
from tricue.data.open_source import Source
from tricue.export.table import TableForm
from tricue.track.base.registry import names
from tricue.track.base.settings import PAPER, make_tracker, read_settings
from tricue.track.base.track import Status, Track, Tracker
from tricue.track.multi.tracker import MultiTracker

EXAMPLES = """\
examples:
  tricue track video.mp4 --box 120,80,64,78 --output overlay.mp4 --csv track.csv
  tricue track 0 --detect face --output overlay.mp4           the first camera, until Ctrl-C
  tricue track sequences/David --json track.json              starts on the sequence's first true box
  tricue track images/ --box 10,20,30,40 --tracker color-particle --set particles=300 --seed 7
  tricue track images/ --box=-5,20,30,40                      a box that extends left of the image
  tricue track depth/ --depth-scale 0.001 --fps 15 --tracker depth-particle --fov 57,43 --plot path.png
  tricue track video.mp4 --depth depth/ --depth-scale 0.001 --tracker depth-particle --calibration camera.yml
  tricue track left.mp4 --right right.mp4 --calibration stereo.yml --tracker stereo-head --detect face
  tricue track walk.bag --topics color=/rgb/image_raw,depth=/depth/image_raw --box 60,30,25,74
  tricue track rtsp://camera/stream --box 60,30,25,74         live: always the newest frame
  tricue track kitti/ --tracker stereo-head --box 560,170,30,60 --set near=5 --set far=40
  tricue track pair/ --tracker flow-depth --box 60,30,25,74 --calibration stereo.yml --output overlay.mp4
  tricue track rgbd/ --tracker flow-depth --box 60,30,25,74   color and depth; a target among others
  tricue track video.mp4 --tracker flow-depth --set cues=flow --box 60,30,25,74   without any depth
  tricue track video.mp4 --box 60,30,25,74 --box 120,32,24,70 --workers 2 --mot tracks.txt   two targets
"""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument(
        "input", metavar="INPUT", help="video, folder of images, sequence, recording, URL, camera number"
    )
    command.add_argument(
        "--tracker",
        type=tracker_name,
        metavar="NAME",
        help=f"{', '.join(names())} or module:Class; default {DEFAULT_TRACKER}, or {depth_tracker()} "
        "for depth without a box to start on",
    )
    start = command.add_mutually_exclusive_group()
    start.add_argument(
        "--box",
        type=start_box,
        action="append",
        metavar="[FRAME:]X,Y,W,H",
        help="the box to start on, in pixels, and its frame if that isn't the first; once for each target",
    )
    start.add_argument(
        "--select", action="store_true", help="draw the boxes to start on in the browser (extra app)"
    )
    start.add_argument(
        "--detect",
        choices=("face", "person"),
        help="start on the first face (stereo: head), or on the first person that a depth tracker detects",
    )
    command.add_argument(
        "--start", type=frame_number, default=0, metavar="N", help="the first frame, from 0; default 0"
    )
    command.add_argument(
        "--end", type=frame_number, metavar="N", help="the last frame; by default that of all"
    )
    add_topics(command)
    add_source_options(command).add_argument(
        "--assume-fov",
        type=angles,
        metavar="H[,V]",
        help="angles to assume where they aren't known; positions are then marked as assumed",
    )
    command.add_argument(
        "--output", type=Path, metavar="FILE", help="overlay video, .mp4, .mkv, .webm or .avi"
    )
    command.add_argument("--csv", type=Path, metavar="FILE", help="a line per frame")
    command.add_argument(
        "--json",
        type=Path,
        metavar="FILE",
        help="the same, with the tracker and its parameters; - for an object a line on standard output",
    )
    command.add_argument("--mot", type=Path, metavar="FILE", help="the tracks as MOTChallenge's text")
    command.add_argument("--coco", type=Path, metavar="FILE", help="the tracks as COCO's JSON of a video")
    command.add_argument("--plot", type=Path, metavar="FILE", help="the path in meters from above, .png")
    command.add_argument(
        "--workers",
        type=count,
        default=1,
        metavar="N",
        help="processes that share the targets of several boxes, default %(default)s",
    )
    command.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the tracker"
    )
    base = command.add_mutually_exclusive_group()
    base.add_argument("--params", type=Path, metavar="FILE", help="parameters of the tracker, TOML")
    base.add_argument(
        "--paper",
        action="store_const",
        const=PAPER,
        help="the tracker as its paper prints it, without stages of ours",
    )
    add_common(command)


class TrackRun(NamedTuple):
    """The source, the tracker, how it starts, and the known intrinsics or stereo rig.

    targets, boxes: of several targets, for each of which there is such a tracker, and the numbers of their
        first frames; None for one.
    first, end: the numbers of the first frame and of the one after the last, None for all.
    assumed: whether the camera is only supposed.
    """

    source: Source
    tracker: Tracker
    intrinsics: Intrinsics | None
    start: Start | None
    rig: StereoRig | None = None
    targets: MultiTracker | None = None
    boxes: Sequence[tuple[int, Box]] = ()
    first: int = 0
    end: int | None = None
    assumed: bool = False

    def known(self, step: Step) -> Step:
        """The step, without positions where no camera is known by which they would be meters."""
        if self.intrinsics is not None:
            return step
        tracks = step.tracks and {target: track.in_image() for target, track in step.tracks.items()}
        return step._replace(track=step.track.in_image(), tracks=tracks)

    def seconds(self, step: Step) -> float:
        """The time of a step's frame."""
        return step.number / self.source.fps if step.frame.timestamp is None else step.frame.timestamp

    @property
    def frames(self) -> int | None:
        """How many there are; None where that isn't known."""
        ends = [each for each in (self.source.length, self.end) if each is not None]
        return max(min(ends) - self.first, 0) if ends else None


def run(options: argparse.Namespace) -> int:
    """TrackRun the command and print the results; the exit code."""
    run, notes = _prepare(options)
    clock = RunClock()
    tracks: dict[int, dict[int, Track]] = {}
    lost: dict[int, LostRanges] = {}
    with ExitStack() as files:
        outputs = [files.enter_context(output) for output in _outputs(options, run)]
        stop = files.enter_context(catch_signals())
        progress = files.enter_context(Progress(run.frames))
        frames = takewhile(lambda _: not stop(), islice(run.source, run.first, run.end))
        if run.targets is None:
            found = steps(run.tracker, frames, run.start, clock, run.first)
        else:
            targets = files.enter_context(run.targets)
            found = steps_of_targets(targets, frames, run.boxes, clock, run.first)
        for step in map(run.known, _with_start_hint(found, run, clock)):
            for output in outputs:
                output.write(step)
            for target, track in step.targets.items():
                tracks.setdefault(target, {})[step.number] = track
                lost.setdefault(target, LostRanges()).add(step.number, run.seconds(step), track.status)
            progress(step.number + 1 - run.first, clock.speeds)
        signal_number = stop()
    interrupted = signal_number != 0
    if not tracks and not interrupted:
        raise ValueError(_not_started(run, clock))
    with redirect_stdout(sys.stderr if options.json == STANDARD_OUTPUT else sys.stdout):
        _report(run, clock, tracks, lost, interrupted)
        notes += run.source.remarks
        notes += [f"wrote {output.about}" for output in outputs if output.about]
        if options.plot:
            notes.append(_plot(options.plot, run, tracks.get(1, {})))
        for note in notes:
            print(note)
    return 128 + signal_number if interrupted else 0


def _check_not_input(place: Path | None, outputs: Sequence[Path]) -> None:
    for path in outputs:
        if place and path.exists() and place.exists() and path.samefile(place):
            raise ValueError(f"{path}: expected another file than the input to write to")


def _check_different(outputs: Sequence[Path]) -> None:
    files = [path.resolve() for path in outputs if path.is_file() or not path.exists()]  # not /dev/null
    for index, path in enumerate(files):
        if path in files[:index]:
            raise ValueError(f"{path}: expected a file for each output, got this one twice")


def _prepare(options: argparse.Namespace) -> tuple[TrackRun, list[str]]:
    """Open the source and make the tracker; notes for the user."""
    if options.select:
        options.box = _selected(options)
    boxes = _numbered(options)
    several = len(boxes) > 1
    if options.plot:
        from tricue.draw.paths import check_format

        if several:
            raise ValueError(f"--plot: expected one --box, got {len(options.box)}")
        check_format(options.plot)
    source = open_input(options)
    options.tracker = options.tracker or default_tracker(options, source)
    right = Path(options.right) if options.right else None
    files = options.output, options.csv, options.json, options.mot, options.coco, options.plot
    outputs = [path for path in files if path]
    for place in (Path(options.input), right, options.calibration, options.params):
        _check_not_input(place, outputs)
    _check_different(outputs)
    found = find_calibration(options, source)
    source = found.prepare(source)
    tracker = make_tracker(
        options.tracker,
        options.paper or options.params,
        options.set,
        options.seed,
        options.kernels,
        **found.keywords,
    )
    rig = found.rig
    known = rig.intrinsics if rig else found.intrinsics
    first, end = min([frame for frame, _ in boxes], default=options.start), options.end
    start = choose_start(options, source, tracker, rig)
    run = TrackRun(source, tracker, known, start, rig, first=first, end=None if end is None else end + 1)
    run = run._replace(assumed=found.assumed)
    if several:
        run = run._replace(targets=_targets(options, found.keywords), boxes=boxes)
    return run, [*source.notes, *([found.note] if found.note else [])]


def _selected(options: argparse.Namespace) -> list[StartBox]:
    """The boxes that the user draws in the browser; ValueError where there is none."""
    from tricue.app import select_boxes

    found = [StartBox(box, frame) for frame, box in select_boxes(options.input, **opening(options))]
    if not found:
        raise ValueError("--select: expected a box, none was drawn")
    return found


def _numbered(options: argparse.Namespace) -> list[tuple[int, Box]]:
    """The boxes to start on with the numbers of their frames; ValueError for a frame that isn't tracked."""
    last = math.inf if options.end is None else options.end
    if last < options.start:
        raise ValueError(f"--end {options.end}: expected {options.start}, of --start, or more")
    found = [(options.start if frame is None else frame, box) for box, frame in options.box or ()]
    for frame, _ in found:
        if not options.start <= frame <= last:
            raise ValueError(f"--box {frame}:...: expected a frame from --start to --end")
    return found


def _targets(options: argparse.Namespace, camera: Mapping[str, Any]) -> MultiTracker:
    parameters = read_settings(options.tracker, options.paper or options.params, options.set)
    shared = {"workers": options.workers, "seed": options.seed, "kernels": options.kernels}
    return MultiTracker(options.tracker, **shared, **camera, **parameters)


def _outputs(options: argparse.Namespace, run: TrackRun) -> Iterator[Output]:
    """Open the outputs one by one, so that the first is closed if the second can't be opened."""
    if options.output:
        yield VideoOutput(options.output, run.source.fps, run.rig, run.assumed, run.frames)
    world = run.intrinsics is not None and run.intrinsics.pose is not None
    form = TableForm(world, run.targets is not None, run.assumed)
    if options.csv:
        yield CsvOutput(options.csv, form)
    if options.json == STANDARD_OUTPUT:
        yield JsonLines(form)
    elif options.json:
        yield JsonOutput(options.json, _about(options, run), run.source.fps, form)
    if options.mot:
        yield MotOutput(options.mot, positions=not run.assumed)
    if options.coco:
        yield CocoOutput(options.coco, Path(run.source.name).name, run.source.fps)


def _with_start_hint(found: Iterator[Step], run: TrackRun, clock: RunClock) -> Iterator[Step]:
    """The steps; an error of the tracker's start gets a hint about how to fix it."""
    try:
        yield from found
    except ValueError as error:
        if clock.decoded == 1 and not any(clock.statuses.values()):
            raise ValueError(f"{error}{start_hint(error, run.source, run.tracker)}") from None
        raise


def _not_started(run: TrackRun, clock: RunClock) -> str:
    if run.first and not clock.decoded:
        length = run.source.length
        has = "" if length is None else f"; {run.source.name} has {length}"
        return f"frame {run.first}: expected a frame to start in{has}"
    if clock.not_found_reason:
        reason = f"the tracker started in none of {clock.decoded} frames: {clock.not_found_reason}"
    else:
        reason = f"found no face in {clock.decoded} frames"
    return f"{run.source.name}: {reason}; {BOX_HINT}"


def _about(options: argparse.Namespace, run: TrackRun) -> dict[str, Any]:
    return {
        "tricue": tricue.__version__,
        "source": run.source.name,
        "fps": run.source.fps,
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
    """JSON has no infinity."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _report(
    run: TrackRun,
    clock: RunClock,
    tracks: Mapping[int, Mapping[int, Track]],
    lost: Mapping[int, LostRanges],
    interrupted: bool,
) -> None:
    frames = f"{run.source.name}: {clock.decoded} frames{' until interrupted' if interrupted else ''}"
    if len(tracks) > 1:
        print(frames)
        for target, found in tracks.items():
            counts = _counts(Counter(track.status for track in found.values()))
            print("; ".join(filter(None, (f"target {target}: {counts}", str(lost[target])))))
        print(clock.speeds)
        return
    print(f"{frames}, {_counts(clock.statuses)}")
    for line in filter(None, map(str, lost.values())):
        print(line)
    print(clock.speeds)
    found = tracks.get(1, {})
    if first := min(found, default=0):
        print(f"started in frame {first}")
    truth = run.source.truth
    if truth is not None and np.isfinite(truth[run.first + 1 :]).any():
        print(_score(truth, found, run.first, clock.decoded))


def _counts(statuses: Mapping[Status, int]) -> str:
    return ", ".join(f"{statuses[status]} {status}" for status in Status)


def _score(truth: Any, tracks: Mapping[int, Track], first: int, frames: int) -> str:
    """AUC and precision over the frames that were read and have a true box."""
    from tricue.evaluation import metrics

    truth = truth[first : first + frames]
    found = np.full((len(truth), 4), np.nan)
    for number, track in tracks.items():
        if number - first < len(truth):
            found[number - first] = track.box
    score = metrics.score(found, truth)
    return f"against the true boxes: AUC {score.auc:.3f}, precision at 20 px {score.precision:.3f}"


def _plot(path: Path, run: TrackRun, tracks: Mapping[int, Track]) -> str:
    """Write the path seen from above; a note about the result."""
    from tricue.draw.paths import save_path

    if all(track.position is None for track in tracks.values()):
        return f"{path}: not written, no track has a position in meters"
    save_path(path, tracks.values(), run.intrinsics)
    return f"wrote {path}{', in assumed meters' if run.assumed else ''}"
