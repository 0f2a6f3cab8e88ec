# SPDX-License-Identifier: MIT
"""A walker is overtaken and passes somebody: overlaps per part, reported occlusion, recovery."""

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
from tricue.scenes import Events
from tricue.track.base.track import Status

MAX_WALKER_OCCLUDED_DELAY = 4
"""Frames, after less than a tenth is visible, within which OCCLUDED must be reported."""
MAX_WALKER_RECOVERY_LEAD, MAX_WALKER_RECOVERY_DELAY = 4, 8
"""Frames before and after a fifth is visible again, between which TRACKED must be reported again."""
MIN_WALKER_RECOVERY_FRAMES = 5
"""Consecutive frames that must be TRACKED then."""
MAX_TRACKED_HIDDEN = 0.3
"""Share of the frames with nothing visible that may be TRACKED."""
FRAMES_BEFORE_PASS, FRAMES_AFTER_PASS = 6, 10
"""Frames before and after the pass in which one person may hide the other."""
MIN_VISIBLE_AT_RESTART = 0.9
"""Visible share of the target from which on the second run starts."""

COLUMNS = (
    *("scene", "tracker", "IoU > 0.5: mean", "minimum"),
    *("before the overtaking", "after it", "after the pass"),
    *("started after it: before the pass", "then after it"),
    *("OCCLUDED in time", "recovered in time", "both", "error m", "% of distance", "runs"),
)
CSV_COLUMNS = ("model", "scene", "seed", "frame", "error_m", "iou", "visible", "status")

AROUND_PASS = "before_pass", "after_pass"  # parts of a curve


class Snapshot(NamedTuple):
    """The tracker's target in one frame: pixels (H, W), 255 or 0, blocks, and box."""

    mask: NDArray[np.uint8] | None
    targets: tuple[Box, ...]
    occluded: tuple[Box, ...]
    box: Box


@dataclass(frozen=True, slots=True, eq=False)
class WalkCurve(OcclusionCurve):
    """One tracker in one scene."""

    errors: Floats
    """(M,) distances from the true positions, meters; NaN without a position."""
    distances: Floats
    """(M,) true distances from the camera, meters."""
    events: Events
    restarted_overlaps: Floats
    """(M,) overlaps of a second run, which starts on the true box once the overtaking is over; NaN before its
    first update, and in all frames if the scene ends sooner.
    """
    snapshots: dict[int, Snapshot]
    """Snapshots of some frames, by number."""

    @property
    def success(self) -> float:
        """Share of the frames with at least half of the target visible, in which the box is on it."""
        return _share(self.overlaps > MIN_OVERLAP, self.counted)

    @property
    def before_overtaking(self) -> Flags:
        """Frames (M,) before less than 60 % are visible, without the first, whose box is given."""
        return self._frames(1, self.events.hiding)

    @property
    def before_pass(self) -> Flags:
        """Frames (M,) between the overtaking, plus time to recover the target, and the pass."""
        back, passing = self.events.back, self.events.passing
        return self._frames(
            None if back is None else back + MAX_WALKER_RECOVERY_DELAY,
            None if passing is None else passing - FRAMES_BEFORE_PASS,
        )

    @property
    def after_pass(self) -> Flags:
        """Frames (M,) after the pass."""
        passing = self.events.passing
        return self._frames(None if passing is None else passing + FRAMES_AFTER_PASS, len(self.overlaps))

    @property
    def occlusion_reported(self) -> bool | None:
        """Whether OCCLUDED is first reported in time: while less than 60 % are visible, and soon after less
        than 10 % are. None if the scene ends before.
        """
        hiding, hidden = self.events.hiding, self.events.hidden
        if hiding is None or hidden is None or Status.OCCLUDED not in self.statuses:
            return None if hidden is None else False
        return hiding <= self.statuses.index(Status.OCCLUDED) <= hidden + MAX_WALKER_OCCLUDED_DELAY

    @property
    def recovered(self) -> bool | None:
        """Whether the status is TRACKED for some frames in a row soon after a fifth is visible again, and is
        hardly ever while nothing is visible. None if the scene ends before.
        """
        hidden, back = self.events.hidden, self.events.back
        if hidden is None or back is None:
            return None
        tracked = self.tracked
        while_hidden = tracked[hidden + MAX_WALKER_OCCLUDED_DELAY : back]
        if while_hidden.size and while_hidden.mean() > MAX_TRACKED_HIDDEN:
            return False
        last = back + MAX_WALKER_RECOVERY_DELAY
        firsts = range(max(back - MAX_WALKER_RECOVERY_LEAD, 0), last + 1)
        runs = (tracked[first : first + MIN_WALKER_RECOVERY_FRAMES] for first in firsts)
        if any(len(run) == MIN_WALKER_RECOVERY_FRAMES and run.all() for run in runs):
            return True
        return False if last + MIN_WALKER_RECOVERY_FRAMES <= len(tracked) else None

    def _frames(self, first: int | None, last: int | None) -> Flags:
        """Frames (M,) from a first to before a last one; none if either is None."""
        index = np.arange(len(self.overlaps))
        known = first is not None and last is not None
        return np.asarray((index >= (first or 0)) & (index < (last or 0)) & known)


def restart_frame(events: Events, visible: Floats) -> int | None:
    """The first frame after the overtaking with enough of the target visible to start on; None without."""
    clear = np.flatnonzero(visible >= MIN_VISIBLE_AT_RESTART)
    later = clear[clear > events.back] if events.back is not None else clear[:0]
    return int(later[0]) if later.size else None


def summarize(curves: Sequence[WalkCurve]) -> str:
    """Markdown, a line per scene and tracker: COLUMNS."""
    return "\n".join(tables.scene_table(curves, COLUMNS, _cells))


def write_csv(path: Path, curves: Iterable[WalkCurve]) -> None:
    """A line per tracker, scene, seed and frame: CSV_COLUMNS; without a position the error is empty."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _frames(curve: WalkCurve) -> Iterator[list[object]]:
    columns = (curve.errors, curve.overlaps, curve.visible, curve.statuses)
    for error, overlap, visible, status in zip(*columns, strict=True):
        yield [*(tables.csv_number(value) for value in (error, overlap, visible)), status]


def _cells(runs: Sequence[WalkCurve]) -> list[str]:
    success = [run.success for run in runs]
    answers = [
        (run.occlusion_reported, run.recovered)
        for run in runs
        if run.occlusion_reported is not None and run.recovered is not None
    ]
    errors = np.concatenate([run.errors[run.counted] for run in runs])
    shares = np.concatenate([(run.errors / run.distances)[run.counted] for run in runs])
    return [
        f"{np.mean(success):.1%}",
        f"{min(success):.0%}",
        *(tables.percent(_success(runs, "overlaps", part)) for part in ("before_overtaking", *AROUND_PASS)),
        *(tables.percent(_success(runs, "restarted_overlaps", part)) for part in AROUND_PASS),
        tables.percent([reported for reported, _ in answers]),
        tables.percent([recovered for _, recovered in answers]),
        tables.percent([reported and recovered for reported, recovered in answers]),
        tables.number(tables.percentiles(errors, 50)[0], 2),
        tables.number(tables.percentiles(100 * shares, 50)[0], 1),
        f"{len(runs)}",
    ]


def _success(runs: Sequence[WalkCurve], overlaps: str, part: str) -> list[float]:
    """For each run that has the part, the share of its frames with the box on the target."""
    measured = [(getattr(run, overlaps), getattr(run, part)) for run in runs]
    known = [(values, frames & ~np.isnan(values)) for values, frames in measured]
    return [_share(values > MIN_OVERLAP, frames) for values, frames in known if frames.any()]


def _share(flags: Flags, frames: Flags) -> float:
    return float(flags[frames].mean()) if frames.any() else float("nan")
