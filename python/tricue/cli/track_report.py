# SPDX-License-Identifier: MIT
"""The final report of ``tricue track``, and the plot of the path."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.cli.outputs import Step
from tricue.cli.starts import BOX_HINT
from tricue.cli.steps import RunClock
from tricue.cli.track_preparation import TrackRun
from tricue.data.streams import Images
from tricue.export.lost_ranges import LostRanges
from tricue.track.base.track import Status, Track

MIN_CONTRAST = 8  # gray levels in the first box; a compressed black frame has fewer


@dataclass
class RunRecord:
    """The tracks of each target by frame, and the ranges in which it is lost. fps: of the source.

    plain: the frames in which the box to start on shows a single color.
    """

    fps: float
    tracks: dict[int, dict[int, Track]] = field(default_factory=dict)
    lost: dict[int, LostRanges] = field(default_factory=dict)
    plain: set[int] = field(default_factory=set)

    def add(self, step: Step) -> None:
        """Record the tracks of one more frame."""
        for target, track in step.targets.items():
            if target not in self.tracks and _is_plain(step.frame, track.box):
                self.plain.add(step.number)
            self.tracks.setdefault(target, {})[step.number] = track
            self.lost.setdefault(target, LostRanges()).add(step.number, step.time(self.fps), track.status)

    @property
    def notes(self) -> list[str]:
        """What to do about such boxes."""
        return [
            f"the box in frame {number} shows a single color; "
            "give one in a frame that shows the target, --box FRAME:x,y,width,height"
            for number in sorted(self.plain)
        ]


def _is_plain(frame: Frame, box: Box) -> bool:
    """Whether a box shows a single color, and the frame has nothing else to follow."""
    if frame.color is None or frame.depth is not None or frame.right is not None:
        return False
    rows, columns = frame.color.shape[:2]
    left, top, right, bottom = (round(edge) for edge in box.clip(columns, rows).xyxy)
    part = frame.color[top:bottom, left:right]
    return part.size > 0 and int(np.ptp(part, axis=(0, 1)).max()) < MIN_CONTRAST


def report(run: TrackRun, clock: RunClock, record: RunRecord, interrupted: bool) -> None:
    """Print how many frames were tracked and lost, where, how fast, and how close to the true boxes."""
    tracks, lost = record.tracks, record.lost
    frames = f"{run.source.name}: {_frames(clock.decoded)}{' until interrupted' if interrupted else ''}"
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
        if run.mismatch:
            print(f"not compared with the true boxes: {run.mismatch}")
        elif _starts_on_another(truth, found):
            print("not compared with the true boxes: the first box doesn't touch the true one of its frame")
        else:
            print(_score(truth, found, run.first, clock.decoded))


def not_started(run: TrackRun, clock: RunClock) -> str:
    """Why no frame was tracked, and what to do."""
    if run.first and not clock.decoded:
        length = run.source.length
        has = "ends before it" if length is None else f"has {length}"
        return f"frame {run.first}: expected a frame to start in; {run.source.name} {has}"
    if clock.not_found_reason:
        reason = f"the tracker started in none of {_frames(clock.decoded)}: {clock.not_found_reason}"
    else:
        reason = f"found no face in {_frames(clock.decoded)}"
    return f"{run.source.name}: {reason}; {BOX_HINT}"


def changed_size(run: TrackRun, clock: RunClock) -> str:
    """Which frame's image isn't as large as the first one's, and both sizes. Trackers can't go on with it."""
    number = run.first + clock.decoded - 1
    stream = run.source.channels.get("color") or run.source.channels["depth"]
    place = stream.paths[number] if isinstance(stream, Images) else f"frame {number}"
    first, last = ("x".join(map(str, size)) for size in (clock.start_size, clock.last_size))
    return f"{place}: expected the first frame's size, {first}, got {last} px; all images must have the same"


def require_all_started(run: TrackRun, clock: RunClock) -> None:
    """ValueError if the frame of a target's box was never reached."""
    end = run.first + clock.decoded
    if left := [number for number, _ in run.boxes if number >= end]:
        raise ValueError(f"--box {left[0]}:...: expected a frame from {run.first} to {end - 1}")


def plot(path: Path, run: TrackRun, tracks: Mapping[int, Track]) -> str:
    """Write the path seen from above; a note about the result.

    Without a path, an earlier run's picture is removed, because it would be mistaken for this one's.
    """
    from tricue.draw.paths import save_path

    if all(track.position is None for track in tracks.values()):
        earlier = path.is_file()
        if earlier:
            path.unlink()
        removed = "; removed that of an earlier run" if earlier else ""
        return f"{path}: not written, no track has a position in meters{removed}; --csv has it in pixels"
    save_path(path, tracks.values(), run.intrinsics)
    return f"wrote {path}{', in assumed meters' if run.assumed else ''}"


def _frames(count: int) -> str:
    return f"{count} frame{'' if count == 1 else 's'}"


def _counts(statuses: Mapping[Status, int]) -> str:
    return ", ".join(f"{statuses[status]} {status}" for status in Status)


def _starts_on_another(truth: Any, tracks: Mapping[int, Track]) -> bool:
    """Whether the first box doesn't touch the frame's true box, because it was detected or drawn on another
    target.
    """
    from tricue.evaluation import metrics

    first = min(tracks, default=len(truth))
    if first >= len(truth) or not np.isfinite(truth[first]).all():
        return False
    return bool(metrics.overlaps(np.array([tracks[first].box]), truth[first : first + 1])[0] == 0)


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
