# SPDX-License-Identifier: MIT
"""Trackers on one rendered scene: overlaps, position errors, and their behavior at the scene's events."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from tricue.camera.box import Box
from tricue.evaluation import metrics, one_pass
from tricue.evaluation.one_pass import Run
from tricue.scenes.rooms.scene import RoomScene
from tricue.scenes.stress.scene import StressScene, stress_scene
from tricue.track.base.track import Status

from benchmarks.quality.common.frame_results import GOOD_OVERLAP, Array, Flags, FrameResults
from benchmarks.quality.common.variants import Inputs, Variant

MIN_COUNTED_VISIBLE = 0.5
"""Smallest visible share of the target with which a frame counts for overlaps and positions."""
MIN_WHOLE_VISIBLE = 0.95
"""Smallest visible share with which the target counts as fully visible, apart from border pixels."""
MAX_RECOVERY_FRAMES = 10
"""Frames within which a target that is fully visible again must be found."""
MAX_LOST_DELAY = 3
"""Frames without the target within which LOST must be reported."""
MAX_WRONG_FRAMES = 5
"""Frames in a row in which TRACKED on something else is tolerated."""
MIN_LOOKALIKE_OVERLAP, MAX_TARGET_OVERLAP = 0.3, 0.1
"""A box is on a look-alike if its overlap with it is above this, and that with the target below this."""


class SceneTask(NamedTuple):
    """A scene, and the trackers to run on it."""

    kind: str
    seed: int
    channels: str
    variants: Sequence[Variant]
    away: int | None = None  # frames, as in stress_scene


class SceneResult(NamedTuple):
    """One tracker on a scene with N frames. Numbers of events that the scene doesn't have are NaN.

    errors: (N,) distances between tracked and true positions, meters, NaN where one is unknown. counted: (N,)
    whether at least half of the target is visible. recovered: share of the absences and occlusions after
    which the target was found again. faithful: 1 if nothing but the target was TRACKED for long, else 0.
    reported_lost: 1 if LOST was reported in time when images were black or showed another scene, else 0.
    trouble: the error that ended the tracker, or "".
    """

    tracker: str
    kind: str
    seed: int
    channels: str
    frames: FrameResults
    errors: Array
    counted: Flags
    recovered: float
    faithful: float
    reported_lost: float
    trouble: str = ""


def run_scene(task: SceneTask) -> list[SceneResult]:
    """Render the scene once, and run all trackers that can use its channels."""
    inputs = Inputs(channels_of(task.channels))
    able = [each for each in task.variants if not each.unsupported(inputs)]
    if not able:
        return []
    scene = stress_scene(task.kind, task.seed, channels=task.channels, away=task.away)
    return [run_variant(each, scene, task.channels) for each in able]


def channels_of(name: str) -> tuple[str, ...]:
    """The frames' channels in a scene of "color", "rgbd", "stereo" or "depth"."""
    return {"rgbd": ("color", "depth"), "stereo": ("color", "right")}.get(name, (name,))


def run_variant(variant: Variant, scene: StressScene | RoomScene, channels: str) -> SceneResult:
    """One tracker from the first true box on."""
    names = channels_of(channels)
    inputs = Inputs(names, scene.intrinsics if "depth" in names else None, scene.rig)
    tracker = variant.make(inputs)
    run = one_pass.run(tracker, map(variant.view(inputs), scene.frames), Box(*scene.boxes[0].tolist()))
    return SceneResult(
        variant.label,
        scene.kind,
        scene.seed,
        channels,
        FrameResults.of(run, run.boxes, scene.boxes, scene.visible <= 0),
        metrics.position_errors(run.positions, scene.positions),
        scene.visible >= MIN_COUNTED_VISIBLE,
        recovered(run, scene),
        faithful(run, scene),
        reported_lost(run, scene),
        tracker.error,
    )


def recovered(run: Run, scene: StressScene | RoomScene) -> float:
    """The share of the events "leaving" and "hidden" after which the target is recovered; NaN without any.

    Recovered: the overlap is above 0.5 in one of the first MAX_RECOVERY_FRAMES with the target fully visible.
    """
    overlaps = metrics.overlaps(run.boxes, scene.boxes)
    answers = []
    for event in ("leaving", "hidden"):
        back = _first_whole(scene, event)
        if back is not None:
            answers.append(bool((overlaps[back : back + MAX_RECOVERY_FRAMES] > GOOD_OVERLAP).any()))
    return float(np.mean(answers)) if answers else float("nan")


def _first_whole(scene: StressScene | RoomScene, event: str) -> int | None:
    """The first frame with the whole target after an event's last frame without it; None if there is none."""
    gone = _absent(scene, event)
    if not gone:
        return None
    whole = np.flatnonzero(scene.visible[gone[-1] + 1 :] >= MIN_WHOLE_VISIBLE)
    return None if not whole.size else gone[-1] + 1 + int(whole[0])


def faithful(run: Run, scene: StressScene | RoomScene) -> float:
    """1 if nothing wrong was TRACKED for more than MAX_WRONG_FRAMES in a row, else 0.

    Wrong: a look-alike, or anything while the target isn't visible. NaN if there is no look-alike and the
    target is always visible.
    """
    wrong = scene.visible <= 0
    if "lookalike" in scene.spans:
        others = np.nan_to_num([metrics.overlaps(run.boxes, boxes) for boxes in scene.lookalikes])
        target = np.nan_to_num(metrics.overlaps(run.boxes, scene.boxes))
        wrong = wrong | ((others.max(axis=0) > MIN_LOOKALIKE_OVERLAP) & (target < MAX_TARGET_OVERLAP))
    elif not wrong.any():
        return float("nan")
    tracked = np.array([status is Status.TRACKED for status in run.statuses])
    return float(longest_run(wrong & tracked) <= MAX_WRONG_FRAMES)


def longest_run(flags: Flags) -> int:
    """The largest number of set flags in a row."""
    most = length = 0
    for flag in flags.tolist():
        length = length + 1 if flag else 0
        most = max(most, length)
    return most


def reported_lost(run: Run, scene: StressScene | RoomScene) -> float:
    """1 if LOST was reported in one of the first MAX_LOST_DELAY frames of the event "blank" without the
    target, else 0; NaN without the event.
    """
    gone = _absent(scene, "blank")
    if not gone:
        return float("nan")
    return float(Status.LOST in run.statuses[gone[0] : gone[0] + MAX_LOST_DELAY])


def _absent(scene: StressScene | RoomScene, event: str) -> list[int]:
    """The frames of an event in which nothing of the target is visible."""
    return [index for index in scene.spans.get(event, range(0)) if scene.visible[index] <= 0]
