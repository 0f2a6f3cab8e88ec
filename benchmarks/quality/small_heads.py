# SPDX-License-Identifier: MIT
"""The stereo head tracker on heads that are small in wide images, by the least number of cells across them.

    python -m benchmarks.quality.small_heads [--seeds 2] [--jobs 2] [--cells 0 10 14 18 24]

Rendered scenes of all kinds of heads are in the middle of larger images, as by a wider lens. "on target" is
the share of frames with an overlap above 0.5. "found again" is that share after 40 frames of noise, which
hide the head: it goes on moving meanwhile. Times are medians over frames, of all frames and of those in
which the target is LOST.
"""

import argparse
import sys
import time
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np
import tricue
from joblib import Parallel, delayed
from tricue import Box, Frame, Status, StereoRig
from tricue.scenes import head
from tricue.scenes.heads.head import HEAD_KINDS

from benchmarks.frame_size import Size, embedded, margins, widened
from benchmarks.quality.common.tables import markdown

PLACES: tuple[tuple[Size, Size], ...] = (
    ((160, 120), (160, 120)),
    ((160, 120), (640, 480)),
    ((640, 480), (640, 480)),
    ((640, 480), (1280, 720)),
    ((640, 480), (1920, 1080)),
)
"""Sizes of the scene and of the image around it."""
FRAMES = 110
HIDDEN = range(40, 80)  # frames


class Result(NamedTuple):
    """A run: shares of frames, and times in ms."""

    on_target: float
    overlap: float
    found_again: float
    milliseconds: float
    lost_milliseconds: float


class Run(NamedTuple):
    """Overlaps with the true boxes, statuses and times of the frames after the first."""

    overlaps: np.ndarray
    lost: np.ndarray
    milliseconds: np.ndarray


def main() -> int:
    """Print the table."""
    command = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    command.add_argument("--seeds", type=int, default=2, help="of each kind of scene")
    command.add_argument("--jobs", type=int, default=1, help="scenes at a time")
    command.add_argument("--cells", type=int, nargs="+", default=[0, 10, 14, 18, 24])
    options = command.parse_args()
    scenes = list(product(PLACES, HEAD_KINDS, range(options.seeds)))
    found = Parallel(options.jobs)(delayed(results)(*each, options.cells) for each in scenes)
    rows = []
    for place, (index, cells) in product(PLACES, enumerate(options.cells)):
        of_place = [each[index] for each, scene in zip(found, scenes, strict=True) if scene[0] == place]
        mean = np.nanmean(np.array(of_place), axis=0)
        inner, outer = ("x".join(map(str, size)) for size in place)
        shares = [f"{mean[column]:.2f}" for column in range(3)]
        rows.append([f"{inner} in {outer}", str(cells), *shares, f"{mean[3]:.2f}", f"{mean[4]:.1f}"])
    columns = ["scene", "min_head_cells", "on target", "overlap", "found again", "ms", "ms, LOST"]
    print(markdown(columns, rows))
    return 0


def results(place: tuple[Size, Size], kind: str, seed: int, cells: list[int]) -> list[Result]:
    """The results on one scene, for each number of cells."""
    small, size = place
    scene = head(seed, FRAMES, kind=kind, camera=f"{small[0]}x{small[1]}")
    frames = [
        embedded(frame, size, index) if size != small else frame for index, frame in enumerate(scene.frames)
    ]
    hidden = [noise(frame, index) if index in HIDDEN else frame for index, frame in enumerate(frames)]
    left, top = margins(small, size)
    boxes = [Box(x + left, y + top, width, height) for x, y, width, height in scene.boxes]
    rig = StereoRig(widened(scene.rig.intrinsics, size), scene.rig.baseline)
    make = partial(tricue.StereoHeadTracker, rig=rig)
    found = []
    for least in cells:
        seen = follow(make(min_head_cells=least), frames, boxes)
        again = follow(make(min_head_cells=least), hidden, boxes)
        after = again.overlaps[HIDDEN.stop - 1 :] > 0.5
        lost = again.milliseconds[again.lost]
        found.append(
            Result(
                float(np.mean(seen.overlaps > 0.5)),
                float(seen.overlaps.mean()),
                float(after.mean()),
                float(np.median(seen.milliseconds)),
                float(np.median(lost)) if len(lost) else float("nan"),
            )
        )
    return found


def follow(tracker: tricue.StereoHeadTracker, frames: list[Frame], boxes: list[Box]) -> Run:
    """Follow the head from its first true box."""
    tracker.init(frames[0], boxes[0])
    overlaps, lost, times = [], [], []
    for frame, box in zip(frames[1:], boxes[1:], strict=True):
        before = time.perf_counter()
        track = tracker.update(frame)
        times.append(1e3 * (time.perf_counter() - before))
        overlaps.append(track.box.iou(box))
        lost.append(track.status is Status.LOST)
    return Run(np.array(overlaps), np.array(lost), np.array(times))


def noise(frame: Frame, seed: int) -> Frame:
    """A stereo pair of noise, of the frame's size and time."""
    shape = np.asarray(frame.color).shape
    left = np.random.default_rng(seed).integers(0, 256, shape, np.uint8)
    return Frame(left, right=np.roll(left, -5, axis=1), timestamp=frame.timestamp)


if __name__ == "__main__":
    sys.exit(main())
