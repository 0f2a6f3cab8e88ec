# SPDX-License-Identifier: MIT
"""Prepares a run of ``tricue track`` from the options: the source, the tracker, and its start."""

import argparse
import math
from collections.abc import Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

from tricue.camera.box import Box
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.cli.arguments import StartBox
from tricue.cli.calibrations import find_calibration, is_registered
from tricue.cli.output_files import check_different, check_not_read
from tricue.cli.outputs import STANDARD_OUTPUT, Step
from tricue.cli.settings import make_tracker, read_settings
from tricue.cli.source_options import opening
from tricue.cli.starts import choose_start, default_tracker
from tricue.cli.steps import Start
from tricue.data.input_files import input_files
from tricue.data.open_source import Source, open_source
from tricue.data.truth_check import find_missing_image
from tricue.draw.video import check_name, written_path
from tricue.draw.writable import check_writable
from tricue.errors import BoxError
from tricue.track.base.registry import traits
from tricue.track.base.track import Tracker
from tricue.track.base.validation import check_box_in
from tricue.track.multi.tracker import MultiTracker


class TrackRun(NamedTuple):
    """The source, the tracker, how it starts, and the known intrinsics or stereo rig.

    targets, boxes: for several targets, which all have such a tracker, with the numbers of their first
        frames; None for one.
    first, end: the numbers of the first frame and of the one after the last, None for all.
    assumed: whether the camera is only assumed.
    mismatch: why the true boxes can't be compared with the tracks; "" if they can.
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
    mismatch: str = ""

    def known(self, step: Step) -> Step:
        """The step, without positions if no camera is known that would make them meters."""
        if self.intrinsics is not None:
            return step
        tracks = step.tracks and {target: track.in_image() for target, track in step.tracks.items()}
        return step._replace(track=step.track.in_image(), tracks=tracks)

    @property
    def frames(self) -> int | None:
        """The number of frames; None if unknown."""
        return self._tracked_of(self.source.length)

    @property
    def stated_frames(self) -> int | None:
        """The number of frames for the progress, maybe wrong (see ``Source.stated_length``)."""
        return self._tracked_of(self.source.stated_length)

    def _tracked_of(self, length: int | None) -> int | None:
        """How many frames of so many are tracked."""
        ends = [each for each in (length, self.end) if each is not None]
        return max(min(ends) - self.first, 0) if ends else None


def prepare(options: argparse.Namespace) -> tuple[TrackRun, list[str]]:
    """Open the source and make the tracker; notes for the user."""
    if options.select:
        options.box = _selected(options)
    boxes = _numbered(options)
    several = len(boxes) > 1
    if options.trail is not None and not options.output:
        raise ValueError("--trail: expected with --output, into which it is drawn")
    if options.plot:
        from tricue.draw.paths import check_format

        if several:
            raise ValueError(f"--plot: expected one --box, got {len(options.box)}")
        check_format(options.plot)
    source = open_source(options.input, target=options.target, **opening(options))
    options.tracker = options.tracker or default_tracker(options, source)
    _check_outputs(options, source)
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
    start = choose_start(options, source, tracker, rig, known)
    run = TrackRun(source, tracker, known, start, rig, first=first, end=None if end is None else end + 1)
    run = run._replace(assumed=found.assumed, mismatch=find_missing_image(Path(options.input), source))
    if several:
        _check_boxes(boxes, source)
        run = run._replace(targets=_targets(options, found.keywords), boxes=boxes)
    return run, [*source.notes, *filter(None, [found.note, _time_note(source)])]


def _time_note(source: Source) -> str:
    """A note on the assumed times of frames, "" if they are known."""
    rate = f"{source.fps:g} frames/s assumed, as the images have no times; give another rate with --fps N"
    return "" if source.knows_times else rate


def _check_outputs(options: argparse.Namespace, source: Source) -> None:
    """ValueError for an output that would overwrite an input or another output, OSError for one that can't be
    written; before the first frame, and without touching a file.
    """
    _check_standard_output(options)
    if options.output:
        check_name(options.output)
    overlay = options.output and written_path(options.output)
    json = None if options.json == STANDARD_OUTPUT else options.json
    files = overlay, options.csv, json, options.mot, options.coco, options.plot
    outputs = [path for path in files if path]
    places = [Path(place) for place in (options.input, options.right, options.depth) if place]
    given = filter(None, (options.calibration, options.params))
    check_not_read(outputs, chain(places, given, input_files(source, *places)))
    check_different(outputs)
    for path in outputs:
        check_writable(path)


def _check_standard_output(options: argparse.Namespace) -> None:
    """ValueError for - as a file, except that of --json."""
    for name in ("output", "csv", "mot", "coco"):
        if getattr(options, name) == STANDARD_OUTPUT:
            raise ValueError(f"--{name} -: expected a file; --json - alone writes to standard output")


def _selected(options: argparse.Namespace) -> list[StartBox]:
    """The boxes that the user draws in the browser; ValueError if there are none."""
    from tricue.app import select_boxes

    _check_selection(options)
    drawn = select_boxes(options.input, target=options.target, **opening(options))
    found = [StartBox(box, frame) for frame, box in drawn]
    if not found:
        raise ValueError("--select: expected a box, none was drawn")
    return found


def _check_selection(options: argparse.Namespace) -> None:
    """ValueError if the images in the page aren't those in whose pixels the tracker takes boxes."""
    if options.rectify:
        raise ValueError(
            "--select: expected without --rectify, as the page shows images that aren't rectified; give --box"
        )
    if options.tracker is None or any("color" in each.names for each in traits(options.tracker).channels):
        return
    source = open_source(options.input, target=options.target, **opening(options))
    if {"color", "depth"} <= source.channels.keys() and not is_registered(options, source):
        raise ValueError(
            f"--select: {options.tracker} takes boxes in depth's pixels, the page shows color's; give --box"
        )


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


def _check_boxes(boxes: Sequence[tuple[int, Box]], source: Source) -> None:
    """ValueError names a box on which no tracker could start, before hours are spent on the others."""
    first = min(frame for frame, _ in boxes)
    width, height = map(max, zip(*(stream.size for stream in source.channels.values()), strict=True))
    for frame, box in boxes:
        if source.length is not None and first < source.length <= frame:
            raise ValueError(f"--box {frame}:...: expected a frame from {first} to {source.length - 1}")
        try:
            check_box_in(box, (height, width))
        except BoxError as error:
            reason = str(error).removeprefix("box: ")
            raise ValueError(f"--box {frame}:{','.join(f'{value:g}' for value in box)}: {reason}") from None


def _targets(options: argparse.Namespace, camera: Mapping[str, Any]) -> MultiTracker:
    parameters = read_settings(options.tracker, options.paper or options.params, options.set)
    shared = {"workers": options.workers, "seed": options.seed, "kernels": options.kernels}
    return MultiTracker(options.tracker, **shared, **camera, **parameters)
