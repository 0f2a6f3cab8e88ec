# SPDX-License-Identifier: MIT
"""``tricue info PLACE``: describes a recording, or each sequence in a folder."""

import argparse
import json
import warnings
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from tricue.cli.arguments import add_topics
from tricue.cli.option_names import by_options
from tricue.cli.progress import SEARCH_NOTE, Progress
from tricue.cli.source_options import UNIT_HELP
from tricue.data import layouts
from tricue.data.datasets import find_sequences
from tricue.data.live import LiveStream
from tricue.data.open_source import Source, open_source
from tricue.data.streams import Video
from tricue.data.summary import (
    Summary,
    compute_duration,
    compute_rate,
    note_other_sizes,
    summarize_calibration,
    summarize_channel,
    summarize_depth,
    summarize_topics,
    summarize_truth,
)
from tricue.data.truth_check import find_doubts, find_missing_image

EXAMPLES = """\
examples:
  tricue info sequences/David
  tricue info sequences/                                      a line for each sequence below
  tricue info depth/ --depth-scale 0.001 --fps 15
  tricue info left.mp4 --right right.mp4 --calibration stereo.yml --unit 0.001
  tricue info robot.mcap --topics color=/camera/color/image_raw
  tricue info kitti/ --target "Car 31" --json
"""
VALUE_COLUMN = 13  # characters before the values


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument(
        "place", metavar="PLACE", help="video file, recording, sequence folder, or folder of sequences"
    )
    command.add_argument("--depth-scale", type=float, metavar="M", help="meters per unit of depth")
    command.add_argument("--fps", type=float, metavar="N", help="frames/s of images without times")
    command.add_argument(
        "--right", metavar="PLACE", help="the right camera's images; PLACE has the left one's"
    )
    command.add_argument("--target", metavar="NAME", help="one of a folder's several targets")
    add_topics(command)
    command.add_argument(
        "--calibration", type=Path, metavar="FILE", help="a calibration in place of the one beside the images"
    )
    command.add_argument("--unit", type=float, metavar="M", help=UNIT_HELP)
    command.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Run the command and print the facts; return the exit code."""
    try:
        source = _open(options)
    except ValueError:
        root = Path(options.place)
        below = _sequences_below(root) if root.is_dir() else []
        if not below:
            raise
        _refuse_options_of_one(root, options)
        return _list(root, below, options)
    facts = _facts(source, options)
    _print(facts, _lines(facts), options.json)
    return 0


def _open(options: argparse.Namespace) -> Source:
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "baseline: ")  # the summary has a warning of its own
        source = open_source(
            options.place,
            depth_scale=options.depth_scale,
            fps=options.fps,
            right=options.right,
            target=options.target,
            topics=options.topics,
        )
    if options.unit is not None and options.calibration is None:
        raise ValueError("--unit: expected with --calibration FILE, by OpenCV")
    if any(isinstance(stream, LiveStream) for stream in source.channels.values()):
        raise ValueError(f"{source.name}: expected a recording, of which the frames can be counted")
    return source


def _sequences_below(root: Path) -> list[Path]:
    """The sequences in a folder, with progress, as the search of a whole disk takes minutes."""
    with Progress() as progress:
        found = find_sequences(root, partial(progress, note=SEARCH_NOTE))
    return [path for path in found if path != root]


def _read_videos(source: Source) -> None:
    """Read the videos once, with progress, so that their frames are counted."""
    for name, stream in source.channels.items():
        if isinstance(stream, Video):
            with Progress(stream.stated_length) as progress:
                stream.count(partial(progress, note=f"reading {name}"))


def _facts(source: Source, options: argparse.Namespace) -> Summary:
    _read_videos(source)
    channels = {name: summarize_channel(stream) for name, stream in source.channels.items()}
    frames = min(each["frames"] for each in channels.values())
    unit = f"{source.format.split()[0]}'s format"
    given = "" if options.depth_scale is None else "--depth-scale"
    notes = [*source.notes, *source.remarks, *filter(None, map(note_other_sizes, source.channels.values()))]
    notes += [*filter(None, [find_missing_image(Path(options.place), source)])]
    first = next(iter(channels.values()))
    notes += find_doubts(source, (first["width"], first["height"]), frames)
    depth = source.channels.get("depth")
    return {
        "name": source.name,
        "format": source.format,
        "frames": frames,
        "fps": compute_rate(source, frames),
        "fps_known": source.knows_times,
        "seconds": compute_duration(source, frames),
        "channels": channels,
        "topics": summarize_topics(source),
        "depth": None if depth is None else summarize_depth(depth, unit, given),
        "truth": summarize_truth(source, frames),
        "targets": _targets(Path(options.place)),
        "calibration": summarize_calibration(source, options.calibration, options.unit),
        "notes": list(map(by_options, notes)),
    }


def _targets(place: Path) -> list[str]:
    return list(layouts.list_targets(place)) if place.is_dir() else []


def _lines(facts: Summary) -> Iterator[str]:
    """The facts as text lines."""
    yield f"{facts['name']}: {facts['format']}"
    assumed = "" if facts["fps_known"] else " (assumed, nothing tells the times)"
    yield _line(
        "frames", f"{facts['frames']}, {facts['fps']:.4g} a second{assumed}, {facts['seconds']:.2f} s"
    )
    for name, each in facts["channels"].items():
        other = f", {each['frames']} images" if each["frames"] != facts["frames"] else ""
        yield _line(name, f"{each['width']}x{each['height']}, {each['type']}{other}")
    if facts["depth"]:
        yield from _depth_lines(facts["depth"], facts["frames"])
    yield from _truth_lines(facts["truth"])
    if facts["targets"]:
        yield _line("targets", f"{len(facts['targets'])}, by --target: {', '.join(facts['targets'])}")
    yield from _calibration_lines(facts["calibration"])
    for topic in facts["topics"]:
        channel = f", as {topic['channel']}" if topic["channel"] else ""
        yield _line("topic", f"{topic['name']}, {topic['type']}, {topic['messages']} messages{channel}")
    for note in facts["notes"]:
        yield _line("note", note)


def _depth_lines(depth: Summary, frames: int) -> Iterator[str]:
    yield _line("", f"{depth['meters_per_unit']:g} m per unit, by {depth['unit_from']}")
    looked = depth["frames_looked_at"]
    sample = "all frames" if looked >= frames else f"{looked} frames, evenly spaced"
    if depth["near_m"] is None:
        yield _line("", f"no valid pixel in {sample}")
        return
    middle = f"{depth['near_m']:.3f} m to {depth['far_m']:.3f} m, 5th to 95th percentile"
    yield _line("", f"{middle}; {100 * depth['invalid']:.1f} % invalid pixels; of {sample}")


def _truth_lines(truth: Summary | None) -> Iterator[str]:
    if truth is None:
        yield _line("truth", "none")
        return
    boxes = _count(truth["boxes"], "box")
    yield _line("truth", f"{boxes}, {truth['absent']} absent, {truth['unknown']} unknown")
    if truth["boxes"]:
        width, height = (f"{low:.4g} to {high:.4g} px" for low, high in (truth["width"], truth["height"]))
        yield _line("", f"{width} wide, {height} high")
    if positions := truth["positions"]:
        meters = f"{positions['near_m']:.2f} m to {positions['far_m']:.2f} m"
        yield _line("", f"{positions['known']} positions, {positions['depth_known']} depths, {meters}")
    if truth["behind_the_end"]:
        yield _line("", f"{_count(truth['behind_the_end'], 'row')} more than there are frames")


def _calibration_lines(camera: Summary | None) -> Iterator[str]:
    if camera is None:
        yield _line("calibration", "none found")
        return
    yield _line("calibration", camera["file"])
    if "error" in camera:
        yield _line("", f"of no use: {camera['error']}")
        return
    yield _line("", ", ".join(f"{name} {camera[name]:.2f}" for name in ("fx", "fy", "cx", "cy")) + " px")
    across, down = camera["fov_deg"]
    yield _line("", f"field of view {across:.1f} x {down:.1f} degrees")
    if "baseline_m" in camera:
        yield _line("", f"baseline {camera['baseline_m']:.4f} m")
    if "warning" in camera:
        yield _line("warning", camera["warning"])


def _line(name: str, text: str) -> str:
    return f"  {name:{VALUE_COLUMN}}{text}"


def _refuse_options_of_one(root: Path, options: argparse.Namespace) -> None:
    """ValueError for an option that would be ignored, because it is about a single recording."""
    for name in ("fps", "right", "target", "topics", "calibration", "unit"):
        if getattr(options, name) is not None:
            raise ValueError(
                f"--{name}: expected with one recording, {root} is a folder of them; leave it out"
            )


def _list(root: Path, places: list[Path], options: argparse.Namespace) -> int:
    """Print a line per sequence; ValueError at the end if some can't be opened."""
    found = []
    with Progress(len(places)) as progress:
        for place in places:
            found.append(_summarize(root, place, options.depth_scale))
            progress(len(found), "sequences read")
    _print({"sequences": found}, map(_summary_line, found), options.json)
    if bad := sum("error" in each for each in found):
        raise ValueError(f"{root}: {bad} of {len(found)} sequences can't be opened")
    return 0


def _summarize(root: Path, place: Path, scale: float | None) -> Summary:
    name = place.relative_to(root).as_posix()
    try:
        source, names = _open_with_scale(place, scale), _targets(place)
    except (OSError, ValueError) as error:
        return {"place": name, "error": by_options(str(error))}
    boxes = None if source.truth is None else int(np.isfinite(source.truth).all(axis=1).sum())
    return {
        "place": name,
        "format": source.format,
        "frames": source.length,
        "channels": list(source.channels),
        "boxes": boxes,
        "targets": names,
    }


def _open_with_scale(place: Path, scale: float | None) -> Source:
    """The source, opened with the depth scale only if its format doesn't contain one."""
    try:
        source = open_source(place)
    except ValueError:
        if scale is None:
            raise
        return open_source(place, depth_scale=scale)
    left_out = "depth" not in source.channels and any("depth" in note for note in source.notes)
    return open_source(place, depth_scale=scale) if scale is not None and left_out else source


def _summary_line(facts: Summary) -> str:
    if "error" in facts:
        return f"{facts['place']}: can't be opened: {facts['error']}"
    frames = "frames not counted" if facts["frames"] is None else _count(facts["frames"], "frame")
    truth = [_count(facts["boxes"], "box")] if facts["boxes"] is not None else []
    targets = [f"{len(facts['targets'])} targets"] if facts["targets"] else []
    what = ", ".join([facts["format"], frames, " and ".join(facts["channels"]), *truth, *targets])
    return f"{facts['place']}: {what}"


def _count(number: int, thing: str) -> str:
    """Such as "1 box", "2 boxes"."""
    ending = "" if number == 1 else "es" if thing.endswith("x") else "s"
    return f"{number} {thing}{ending}"


def _print(facts: Any, lines: Iterator[str], as_json: bool) -> None:
    print(json.dumps(facts, indent=1, allow_nan=False) if as_json else "\n".join(lines))
