# SPDX-License-Identifier: MIT
"""Curves of a walker who is overtaken and passes somebody: what is held, and when hiding is said."""

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.papers.depth_curves import HALF
from tricue.scenes import Events
from tricue.track.base.track import Status

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

HELD = 0.5  # of overlap: on the target above it
LATE = 4  # frames after less than a tenth is visible, until OCCLUDED is said
EARLY, SOON = 4, 8  # frames before and after a fifth is visible again, when TRACKED is said again
LASTING = 5  # frames on end
BLIND = 0.3  # share of the frames in which nothing is visible, that may be TRACKED
NEAR, APART = 6, 10  # frames before and after the pass in which one is before the other
CLEAR = 0.9  # visible share, from which a target is started on

COLUMNS = (
    *("scene", "cues", "IoU > 0.5: mean", "least"),
    *("before the overtaking", "after it", "after the pass"),
    *("started after it: before the pass", "then after it"),
    *("occlusion said", "taken up", "both", "error m", "% of distance", "runs"),
)
CSV_COLUMNS = ("model", "scene", "seed", "frame", "error_m", "iou", "visible", "status")


PASS = "before_pass", "after_pass"  # parts of a curve


class Shot(NamedTuple):
    """What the tracker showed in one frame: the target's pixels (H, W), 255 or 0, and its blocks."""

    mask: NDArray[np.uint8] | None
    targets: tuple[Box, ...]
    occluded: tuple[Box, ...]


@dataclass(frozen=True, slots=True, eq=False)
class WalkCurve:
    """One set of cues in one scene."""

    model: str
    scene: str
    seed: int
    errors: Floats
    """(M,) distances from the true positions, metres; NaN without a position."""
    distances: Floats
    """(M,) true ones from the camera, metres."""
    overlaps: Floats
    """(M,) intersection over union with the box round the whole body."""
    visible: Floats
    """(M,) share of the target that nothing hides."""
    statuses: tuple[Status, ...]
    events: Events
    between: Floats
    """(M,) overlaps of another run that starts on the true box once the target is clear of who overtakes;
    NaN up to then, everywhere where the scene ends sooner."""
    shots: dict[int, Shot]
    """Of some frames, by their number."""

    @property
    def seen(self) -> Flags:
        """(M,) where at least half of the target is visible."""
        return np.asarray(self.visible >= HALF)

    @property
    def held(self) -> float:
        """Share of the frames with at least half of the target visible, in which the box is on it."""
        return _share_of(self.overlaps > HELD, self.seen)

    @property
    def before_overtaking(self) -> Flags:
        """(M,) frames before less than 60 % are visible, without the first one, whose box is given."""
        return self._frames(1, self.events.hiding)

    @property
    def before_pass(self) -> Flags:
        """(M,) frames after the overtaking, with time to take the target up, and before the pass."""
        back, passing = self.events.back, self.events.passing
        return self._frames(
            None if back is None else back + SOON, None if passing is None else passing - NEAR
        )

    @property
    def after_pass(self) -> Flags:
        """(M,) frames after the pass."""
        passing = self.events.passing
        return self._frames(None if passing is None else passing + APART, len(self.overlaps))

    @property
    def said(self) -> bool | None:
        """Whether OCCLUDED is first said while less than 60 % are visible, and at most LATE frames after
        less than 10 % are; None where the scene ends before.
        """
        hiding, hidden = self.events.hiding, self.events.hidden
        if hiding is None or hidden is None or Status.OCCLUDED not in self.statuses:
            return None if hidden is None else False
        return hiding <= self.statuses.index(Status.OCCLUDED) <= hidden + LATE

    @property
    def retaken(self) -> bool | None:
        """Whether TRACKED isn't said while nothing is visible, and is said for good by SOON frames after a
        fifth is; None where the scene ends before.
        """
        hidden, back = self.events.hidden, self.events.back
        if hidden is None or back is None:
            return None
        tracked = np.array([status is Status.TRACKED for status in self.statuses])
        blind = tracked[hidden + LATE : back]
        again = (tracked[first : first + LASTING].all() for first in range(back - EARLY, back + SOON + 1))
        return bool((not blind.size or blind.mean() <= BLIND) and any(again))

    def _frames(self, first: int | None, last: int | None) -> Flags:
        """(M,) from a first up to a last one, without it; none where one of them is None."""
        index = np.arange(len(self.overlaps))
        known = first is not None and last is not None
        return np.asarray((index >= (first or 0)) & (index < (last or 0)) & known)


def start_between(events: Events, visible: Floats) -> int | None:
    """The frame after the overtaking in which the target is clear; None where the scene ends before."""
    clear = np.flatnonzero(visible >= CLEAR)
    later = clear[clear > events.back] if events.back is not None else clear[:0]
    return int(later[0]) if later.size else None


def summarize(curves: Sequence[WalkCurve]) -> str:
    """Markdown, a line per scene and set of cues: COLUMNS."""
    lines = [f"| {' | '.join(COLUMNS)} |", "| --- " * len(COLUMNS) + "|"]
    scenes, models = (list(dict.fromkeys(getattr(c, name) for c in curves)) for name in ("scene", "model"))
    for scene, model in product(scenes, models):
        runs = [curve for curve in curves if (curve.scene, curve.model) == (scene, model)]
        lines.append(f"| {scene} | {model} | {' | '.join(_numbers(runs))} |")
    return "\n".join(lines)


def write_csv(path: Path, curves: Iterable[WalkCurve]) -> None:
    """A line per set of cues, scene, seed and frame; without a position the error is empty."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(CSV_COLUMNS)
        for curve in curves:
            columns = (curve.errors, curve.overlaps, curve.visible, curve.statuses)
            for frame, (error, overlap, visible, status) in enumerate(zip(*columns, strict=True)):
                off = "" if np.isnan(error) else f"{error:.4f}"
                names = [curve.model, curve.scene, curve.seed, frame]
                writer.writerow([*names, off, f"{overlap:.4f}", f"{visible:.4f}", status])


def _numbers(runs: Sequence[WalkCurve]) -> list[str]:
    held = [run.held for run in runs]
    answers = [(run.said, run.retaken) for run in runs if run.said is not None and run.retaken is not None]
    errors = np.concatenate([run.errors[run.seen] for run in runs])
    shares = np.concatenate([(run.errors / run.distances)[run.seen] for run in runs])
    return [
        f"{np.mean(held):.1%}",
        f"{min(held):.0%}",
        *(_percent(_held(runs, "overlaps", part)) for part in ("before_overtaking", *PASS)),
        *(_percent(_held(runs, "between", part)) for part in PASS),
        _percent([said for said, _ in answers]),
        _percent([retaken for _, retaken in answers]),
        _percent([said and retaken for said, retaken in answers]),
        _median(errors, "{:.2f}"),
        _median(100 * shares, "{:.1f}"),
        f"{len(runs)}",
    ]


def _held(runs: Sequence[WalkCurve], overlaps: str, part: str) -> list[float]:
    """Of each run that has it, the share of a part's frames in which the box is on the target."""
    pairs = [(getattr(run, overlaps), getattr(run, part)) for run in runs]
    known = [(values, frames & ~np.isnan(values)) for values, frames in pairs]
    return [_share_of(values > HELD, frames) for values, frames in known if frames.any()]


def _share_of(answers: Flags, frames: Flags) -> float:
    return float(answers[frames].mean()) if frames.any() else float("nan")


def _percent(shares: Sequence[float]) -> str:
    return f"{np.mean(shares):.0%}" if shares else "-"


def _median(values: Floats, form: str) -> str:
    known = values[~np.isnan(values)]
    return form.format(np.median(known)) if known.size else "-"
