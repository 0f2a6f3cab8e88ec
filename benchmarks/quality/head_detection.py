# SPDX-License-Identifier: MIT
"""Detection of heads, without a box, in stereo pairs and in depth: rates, false starts and times.

    python -m benchmarks.quality.head_detection [DATA]

"a box" is the share of frames in which a head is found, "on the head" that of boxes that overlap the true one
by 0.5 or more, "overlap" the mean of these overlaps. At least 95 % of a rendered head is visible; "facing"
ones show the face, "turned" ones only their side or hair; "gray" ones are all of these without color.

"nobody": the parts of these frames beside the person, rooms with objects on tables, and recordings. There,
each box is a false start. The baselines of Middlebury's pairs and of the conveyor's aren't known. The true
heads of recorded people aren't known: all boxes were checked by eye.
"""

import argparse
import sys
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import cv2
import numpy as np
from tricue import kernels
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.read_calibration import read_intrinsics, read_registration
from tricue.camera.rig import Intrinsics
from tricue.data.open_source import open_source
from tricue.scenes import HEAD_KINDS, ROOM_KINDS, head, room_scene
from tricue.track.base.validation import camera_or_default
from tricue.track.head_detection.find_head import find_head_in_depth, find_head_in_pair

from benchmarks.quality.common.sequences import data_folder
from benchmarks.quality.common.tables import markdown

MIN_OVERLAP, MIN_VISIBLE = 0.5, 0.95
MAX_FACING = 1.0  # radians
OFTEN, EVERY, FEW = 3, 20, 40  # frames from one that is measured to the next
UNKNOWN_BASELINE = 0.12  # meters
BESIDE = 3  # head widths from the head's middle, beyond which a frame doesn't show the person
MIN_SHARE = 0.4  # of the frame's width, that a part beside the person needs
NOBODY = "kitchen-mug", "paper-cup", "yellow-dragon"  # recordings with registered depth
PEOPLE = "walk-away", "queue-first", "queue-second"  # recordings whose depth has to be registered


class Answer(NamedTuple):
    """What was found in a frame. overlap: with the true box; NaN without one, or if nothing was found."""

    source: str
    found: bool
    overlap: float
    milliseconds: float


def main() -> int:
    """Print the table."""
    command = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    command.add_argument("--seeds", type=int, default=5, help="scenes of each kind")
    command.add_argument("--first", type=int, default=100, help="their first seed")
    command.add_argument("data", nargs="?", type=Path, default=data_folder(), help="recordings")
    options = command.parse_args()
    seeds = range(options.first, options.first + options.seeds)
    recorded = [*_recorded(options.data), *_recorded_depth(options.data)]
    answers = [*_rendered(seeds), *_rooms(seeds), *recorded]
    rows = []
    for source in dict.fromkeys(each.source for each in answers):
        of_source = [each for each in answers if each.source == source]
        found = f"{np.mean([each.found for each in of_source]):.1%}"
        right = [each.overlap for each in of_source if each.overlap >= MIN_OVERLAP]
        known = [f"{len(right) / len(of_source):.1%}", f"{np.mean(right):.2f}"] if right else ["", ""]
        times = np.median([each.milliseconds for each in of_source])
        rows.append([source, str(len(of_source)), found, *known, f"{times:.0f}"])
    print(markdown(["frames of", "frames", "a box", "on the head", "overlap", "ms a frame"], rows))
    return 0


def _answer(source: str, frame: Frame, baseline: float, true: Box | None) -> Answer:
    assert frame.color is not None
    assert frame.right is not None
    before = perf_counter()
    found = find_head_in_pair(kernels.load("native"), frame.color, frame.right, baseline)
    seconds = perf_counter() - before
    overlap = np.nan if found is None or true is None else found.iou(true)
    return Answer(source, found is not None, overlap, 1000 * seconds)


def _rendered(seeds: Iterable[int]) -> Iterator[Answer]:
    for camera in ("160x120", "640x480"):
        for kind in HEAD_KINDS:
            for seed in seeds:
                scene = head(seed, 60, camera, kind=kind)
                for index in range(0, 60, EVERY):
                    frame, true, baseline = scene.frames[index], scene.boxes[index], scene.rig.baseline
                    if scene.visible[index] >= MIN_VISIBLE:
                        side = "facing" if scene.facing[index] < MAX_FACING else "turned"
                        yield _answer(f"head, {camera}, {side}", frame, baseline, true)
                        yield _answer(f"head, {camera}, gray", _gray(frame), baseline, true)
                        for rest in _beside(frame, true):
                            yield _answer(f"nobody, {camera}", rest, baseline, None)


def _gray(frame: Frame) -> Frame:
    assert frame.color is not None
    assert frame.right is not None
    left, right = (cv2.cvtColor(each, cv2.COLOR_BGR2GRAY) for each in (frame.color, frame.right))
    return Frame(left, right=right)


def _beside(frame: Frame, true: Box) -> Iterator[Frame]:
    """The parts of a pair left and right of the person, if they are wide enough."""
    assert frame.color is not None
    assert frame.right is not None
    width, (x, _) = frame.color.shape[1], true.center
    left, right = int(x - BESIDE * true.width), int(x + BESIDE * true.width)
    for part in (slice(0, max(left, 0)), slice(right, None)):
        if len(range(*part.indices(width))) > MIN_SHARE * width:
            color, other = (np.ascontiguousarray(each[:, part]) for each in (frame.color, frame.right))
            yield Frame(color, right=other)


def _rooms(seeds: Iterable[int]) -> Iterator[Answer]:
    for kind in ROOM_KINDS:
        for seed in seeds if kind != "walker" else ():
            scene = room_scene(kind, seed, channels="rgbd")
            for frame in scene.frames[::FEW]:
                yield _answer_in_depth("nobody, color and depth", frame, scene.intrinsics)


def _recorded(data: Path) -> Iterator[Answer]:
    for left in sorted((data / "disparity").glob("*/im2.png")):
        right = left.with_name("im6.png")
        yield _answer("Middlebury", _pair(left, right), UNKNOWN_BASELINE, None)
    for left in sorted((data / "stereo" / "kitti-tracking" / "image_02").rglob("*.png")):
        right = Path(str(left).replace("image_02", "image_03"))
        yield _answer("KITTI", _pair(left, right), 0.54, None)
    for index, frame in enumerate(open_source(data / "stereo" / "conveyor-box")):
        if index % EVERY == 0:
            yield _answer("conveyor-box", frame, UNKNOWN_BASELINE, None)
    rng = np.random.default_rng(0)
    for _ in range(20):
        noise = rng.integers(0, 256, (2, 120, 160, 3), np.uint8)
        yield _answer("noise", Frame(noise[0], right=noise[1]), UNKNOWN_BASELINE, None)


def _recorded_depth(data: Path) -> Iterator[Answer]:
    for name in NOBODY:
        for index, frame in enumerate(open_source(data / "rgbd" / name)):
            if index % EVERY == 0:
                assert frame.depth is not None
                camera = camera_or_default(None, frame.depth.shape)
                yield _answer_in_depth("nobody, recorded color and depth", frame, camera)
    for name in PEOPLE:
        source = open_source(data / "rgbd" / name)
        calibration = data / "rgbd" / "intrinsics.toml"
        register = read_registration(calibration, source.size, source.size)
        camera = read_intrinsics(calibration, source.size, "color")
        for registered, as_recorded in ((register, "registered"), (None, "not registered")):
            for index, frame in enumerate(replace(source, register=registered)):
                if index % OFTEN == 0:
                    yield _answer_in_depth(f"{name}, {as_recorded}", frame, camera)


def _answer_in_depth(source: str, frame: Frame, camera: Intrinsics) -> Answer:
    assert frame.color is not None
    assert frame.depth is not None
    before = perf_counter()
    found = find_head_in_depth(kernels.load("native"), frame.color, frame.depth, camera.fx)
    return Answer(source, found is not None, np.nan, 1000 * (perf_counter() - before))


def _pair(left: Path, right: Path) -> Frame:
    images = [cv2.imread(str(path)) for path in (left, right)]
    return Frame(images[0], right=images[1])


if __name__ == "__main__":
    sys.exit(main())
