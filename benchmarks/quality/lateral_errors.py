# SPDX-License-Identifier: MIT
"""The fused tracker's lateral position errors, to the right and down, and whether its covariance fits them.

    python -m benchmarks.quality.lateral_errors --shift 0.035 --jobs 2

Only frames that are TRACKED with an overlap above 0.5 count. The true center of a scene's target is known. In
recordings, it is assumed to be the center of the true box, which must be entirely in the image, at the
tracked depth; true boxes are in the depth image's pixels, as in ``depth_video``.

All columns have two numbers, to the right and down. "error" is the root mean square, "deviation" the median
standard deviation. "without" is the share of errors within two standard deviations if the covariance had no
term proportional to the side of the track's box (SHARED_LATERAL_ERROR in position_filter.py). "in use" and
"left out" are the shares within one and within two standard deviations, with the factor of that term in use,
and with the factor that is most likely for the other targets, each of which counts the same; "share" is that
factor. 0.683 and 0.954 would be right. Targets of one recording are left out together; seeds of one kind of
scene are one target.
"""

import sys
from collections.abc import Callable, Sequence
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue import scenes
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics
from tricue.scenes.rooms.scene import ROOM_KINDS, room_scene
from tricue.track.base.track import Status, Track
from tricue.track.fused.position_filter import SHARED_LATERAL_ERROR
from tricue.track.fused.tracker import FusedTracker

from benchmarks.quality.common.arguments import add_dataset, add_output, bare_parser, seeds
from benchmarks.quality.common.depth_recordings import DepthRecording, find_targets
from benchmarks.quality.common.folds import leave_one_out
from benchmarks.quality.common.frame_results import GOOD_OVERLAP
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.sequence_runs import SequenceTask, find_tasks
from benchmarks.quality.common.tables import Cell, markdown, write_csv

Array = NDArray[np.float64]
PEOPLE: dict[str, Callable[..., scenes.DepthScene]] = {
    "walker": scenes.walker,
    "crossing": scenes.crossing,
}
MIN_FRAMES = 10
"""Targets with fewer frames are left out."""
SHARES = np.geomspace(0.002, 1.0, 400)
"""Candidates for the most likely share."""
HEAD = ("target", "frames", "error, mm", "deviation, mm", "without", "in use", "left out", "share")


class Errors(NamedTuple):
    """A target's errors in N frames, to the right and down.

    off: (N, 2) meters. variance: (N, 2) m², without the share's term. unit: (N, 2) m², that term for a share
    of 1.
    """

    target: str
    off: Array
    variance: Array
    unit: Array

    def deviations(self, share: float) -> Array:
        """(N, 2) meters, the standard deviations with this share."""
        return np.sqrt(self.variance + share**2 * self.unit)

    def within(self, share: float, times: float) -> Array:
        """(2,) the shares of errors within so many standard deviations."""
        return np.asarray(np.mean(np.abs(self.off) <= times * self.deviations(share), axis=0))

    def surprise(self, share: float) -> float:
        """The mean negative log-likelihood, up to a constant factor and offset."""
        variance = self.deviations(share) ** 2
        return float(np.mean(np.log(variance) + self.off**2 / variance))


def pool(targets: Sequence[Errors]) -> list[Errors]:
    """Targets with the same name as one; those with too few frames are left out."""
    found: list[Errors] = []
    for name in dict.fromkeys(each.target for each in targets):
        same = [each for each in targets if each.target == name]
        off, variance, unit = (np.concatenate(columns) for columns in list(zip(*same, strict=True))[1:])
        found.append(Errors(name, off, variance, unit))
    return [each for each in found if len(each.off) >= MIN_FRAMES]


def most_likely_share(targets: Sequence[Errors]) -> float:
    """The share for which the targets' errors are most likely; each target counts the same."""
    return float(min(SHARES, key=lambda share: np.mean([each.surprise(share) for each in targets])))


def measure(
    name: str,
    frames: Sequence[Frame],
    boxes: Array,
    camera: Intrinsics,
    positions: Array | None,
) -> Errors:
    """The errors of the tracker, which starts on the first true box.

    positions: (N, 3) the true ones, meters; None to use the boxes' centers.
    """
    tracker = FusedTracker(intrinsics=camera)
    found: list[tuple[Array, Array, Array]] = []
    track = tracker.init(frames[0], Box(*boxes[0].tolist()))
    for index in range(1, len(frames)):
        track = tracker.update(frames[index])
        true = Box(*boxes[index].tolist())
        if not _counts(track, true, camera, whole=positions is None):
            continue
        assert track.position is not None
        assert track.covariance is not None
        scale = track.position[2] / np.array([camera.fx, camera.fy])
        middle = (np.array(true.center) - 0.5 - (camera.cx, camera.cy)) * scale
        unit = track.box.area * scale**2
        off = track.position[:2] - (middle if positions is None else positions[index, :2])
        found.append((off, np.diag(track.covariance)[:2] - SHARED_LATERAL_ERROR**2 * unit, unit))
    off, variance, unit = np.array(found).reshape(-1, 3, 2).transpose(1, 0, 2)
    return Errors(name, off, variance, unit)


def _counts(track: Track, true: Box, camera: Intrinsics, whole: bool) -> bool:
    """Whether the track is on the target, and, with ``whole``, the true box is entirely in the image."""
    if not np.isfinite(true).all() or track.status is not Status.TRACKED or track.position is None:
        return False
    inside = true.clip(camera.width, camera.height).area > 0.999 * true.area if whole else True
    return inside and track.box.iou(true) > GOOD_OVERLAP


def measure_recording(task: SequenceTask, shift: float) -> Errors | None:
    """A recorded target; None without depth or calibration."""
    recording = DepthRecording(task.entry.open(), shift)
    camera = recording.inputs.intrinsics
    if camera is None or "depth" not in recording.inputs.channels:
        return None
    truth = recording.truth
    first = int(np.argmax(~np.isnan(truth).any(axis=1)))
    return measure(task.entry.name, recording.frames[first:], truth[first:], camera, None)


def measure_people(scene: tuple[str, int]) -> Errors:
    """A rendered person in front of a time-of-flight camera, by the scene's kind and seed."""
    kind, seed = scene
    made = PEOPLE[kind](seed)
    return measure(f"scene, {kind}", made.frames, np.array(made.boxes), made.intrinsics, made.positions)


def measure_room(scene: tuple[str, int]) -> Errors:
    """A target in a rendered room, by the scene's kind and seed."""
    kind, seed = scene
    made = room_scene(kind, seed, channels="rgbd")
    return measure(f"room, {kind}", made.frames, made.boxes, made.intrinsics, made.positions)


def rows(targets: Sequence[Errors]) -> list[list[Cell]]:
    """A line per target, and one with their means."""
    lines: list[list[Cell]] = []
    numbers: list[Array] = []
    for fold in leave_one_out([each.target for each in targets]):
        share = most_likely_share([each for each, fit in zip(targets, fold.fit, strict=True) if fit])
        for target in (each for each, judge in zip(targets, fold.judge, strict=True) if judge):
            found = _numbers(target, share)
            numbers.append(found)
            lines.append([target.target, len(target.off), *_cells(found), f"{share:.3f}"])
    lines.append(["mean", sum(len(each.off) for each in targets), *_cells(np.mean(numbers, axis=0)), ""])
    return lines


def _numbers(target: Errors, left_out: float) -> Array:
    """(7, 2) the numbers of the columns, to the right and down."""
    used = SHARED_LATERAL_ERROR
    return np.array(
        [
            1000 * np.sqrt(np.mean(target.off**2, axis=0)),
            1000 * np.median(target.deviations(used), axis=0),
            target.within(0.0, 2),
            *(target.within(share, times) for share, times in product((used, left_out), (1, 2))),
        ]
    )


def _cells(numbers: Array) -> list[str]:
    millimeters = [f"{right:.0f}, {down:.0f}" for right, down in numbers[:2]]
    without, *within = (f"{right:.2f}, {down:.2f}" for right, down in numbers[2:])
    return [*millimeters, without, "; ".join(within[:2]), "; ".join(within[2:])]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = bare_parser("lateral_errors", __doc__)
    add_dataset(made, "rgbd")
    made.add_argument("--shift", type=float, default=0.0, metavar="M", help="meters, default 0")
    made.add_argument("--seeds", type=seeds, default=seeds("0:2"), metavar="A:B", help="default 0:2")
    add_output(made)
    options = made.parse_args(arguments)
    try:
        tasks = find_tasks([], options.dataset, find=find_targets)
        recorded = run_parallel(partial(measure_recording, shift=options.shift), tasks, options.jobs)
        people = run_parallel(measure_people, product(PEOPLE, options.seeds), options.jobs)
        rooms = run_parallel(measure_room, product(ROOM_KINDS, options.seeds), options.jobs)
        targets = pool([each for each in (*recorded, *people, *rooms) if each])
        lines = rows(targets)
    except (OSError, ValueError) as error:
        made.error(str(error))
    print(f"most likely share: {most_likely_share(targets):.3f}\n\n{markdown(HEAD, lines)}")
    write_csv(options.csv, HEAD, lines)
    return 0


if __name__ == "__main__":
    sys.exit(main())
