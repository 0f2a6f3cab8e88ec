# SPDX-License-Identifier: MIT
"""A camera that follows its target: the angles of both, and how well the target stays in the middle."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Flags, Floats
from tricue.camera.box import Box
from tricue.papers import tables
from tricue.papers.curves import MIN_OVERLAP, OcclusionCurve

SETTLING_FRAMES = 15
"""Frames at the start, while the head turns to the target; they aren't counted."""

COLUMNS = (
    *("scene", "tracker", "in the middle third: mean", "minimum", "pan error deg: median", "95 %"),
    *("tilt error deg: median", "95 %", "IoU > 0.5", "in the image at the end", "runs"),
)
CSV_COLUMNS = (
    *("model", "scene", "seed", "frame", "pan_deg", "target_pan_deg", "tilt_deg", "target_tilt_deg"),
    *("in_middle", "iou", "visible", "status"),
)


class SeenFrame(NamedTuple):
    """A frame of the figure: the left image (H, W, 3), the tracker's box, and the true one."""

    image: NDArray[np.uint8]
    box: Box
    truth: Box


@dataclass(frozen=True, slots=True, eq=False)
class FollowCurve(OcclusionCurve):
    """One tracker in one scene, with the camera that it turns."""

    angles: Floats
    """(M, 2) pan and tilt of the camera, radians."""
    directions: Floats
    """(M, 2) pan and tilt toward the target."""
    in_middle: Flags
    """(M,) whether the center of the true box is in the middle third of the image's width and height."""
    in_image: Flags
    """(M,) whether that center is in the image."""
    rate: float
    """Frames per second."""
    frames: dict[int, SeenFrame]
    """Some frames, by number."""

    @property
    def errors(self) -> Floats:
        """The absolute pointing errors (M, 2) of the camera, degrees."""
        return np.asarray(np.abs(np.degrees(self.directions - self.angles)))

    @property
    def settled(self) -> slice:
        """The counted frames."""
        return slice(SETTLING_FRAMES, None)


def summarize(curves: Sequence[FollowCurve]) -> str:
    """Markdown, a line per scene and tracker: COLUMNS."""
    return "\n".join(tables.scene_table(curves, COLUMNS, _cells))


def write_csv(path: Path, curves: Iterable[FollowCurve]) -> None:
    """A line per tracker, scene, seed and frame: CSV_COLUMNS."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _frames(curve: FollowCurve) -> Iterator[list[object]]:
    for index, status in enumerate(curve.statuses):
        (pan, tilt), (target_pan, target_tilt) = np.degrees([curve.angles[index], curve.directions[index]])
        values = [pan, target_pan, tilt, target_tilt]
        yield [
            *(tables.csv_number(each) for each in values),
            int(curve.in_middle[index]),
            tables.csv_number(curve.overlaps[index]),
            tables.csv_number(curve.visible[index]),
            status,
        ]


def _cells(runs: Sequence[FollowCurve]) -> list[str]:
    middle = [_mean(run.in_middle[run.settled]) for run in runs]
    errors = np.concatenate([run.errors[run.settled] for run in runs])
    overlaps = np.concatenate(
        [(run.overlaps > MIN_OVERLAP)[run.settled][run.counted[run.settled]] for run in runs]
    )
    return [
        tables.percent(middle, 1),
        tables.percent([min(middle)]),
        *(tables.number(each, 2) for axis in errors.T for each in tables.percentiles(axis, 50, 95)),
        tables.percent(overlaps),
        tables.percent([run.in_image[-1] for run in runs]),
        f"{len(runs)}",
    ]


def _mean(flags: Flags) -> float:
    return float(flags.mean()) if flags.size else float("nan")
