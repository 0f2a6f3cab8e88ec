# SPDX-License-Identifier: MIT
"""Trackers on one stress scene: what they found, and what they did at its events."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.evaluation import metrics, one_pass
from tricue.evaluation.one_pass import Run
from tricue.scenes.stress.scene import StressScene, stress_scene
from tricue.track.base.track import Status

from benchmarks.quality.fused.status_metrics import GOOD, Array, Flags, Said
from benchmarks.quality.fused.variants import Offered, Participant

SEEN = 0.5
"""Share of the target's pixels from which on a frame counts for overlaps and positions."""
WHOLE = 0.95
"""Share from which on the target is wholly visible, but for its border's pixels."""
AGAIN = 10
"""Frames in which a target that is wholly visible again has to be found."""
PROMPT = 3
"""Frames of something else in which LOST has to be said."""
PATIENCE = 5
"""Frames in a row on a look-alike that are forgiven."""
OTHER, NOT_TARGET = 0.3, 0.1
"""Above this overlap with a look-alike, and below that with the target, a box is on the look-alike."""


class Task(NamedTuple):
    """A scene, and who is to follow its target."""

    kind: str
    seed: int
    channels: str
    participants: Sequence[Participant]


class Followed(NamedTuple):
    """What a tracker made of a scene with N frames. Events that the scene doesn't have are NaN.

    errors: (N,) metres between the positions, NaN where one isn't known. seen: (N,) whether at least half of
    the target is visible. found: share of the times away or hidden after which it was found again. faithful:
    whether it was never TRACKED on a look-alike for long. told: whether LOST was said soon where the picture
    was black or of another scene. trouble: the error that ended the tracker, or "".
    """

    tracker: str
    kind: str
    seed: int
    channels: str
    said: Said
    errors: Array
    seen: Flags
    found: float
    faithful: float
    told: float
    trouble: str = ""


def perform(task: Task) -> list[Followed]:
    """Draw the scene once and let all follow; those that can't see it are left out."""
    offer = Offered(channels_of(task.channels))
    able = [each for each in task.participants if not each.refuses(offer)]
    if not able:
        return []
    scene = stress_scene(task.kind, task.seed, channels=task.channels)
    return [follow(each, scene, task.channels) for each in able]


def channels_of(name: str) -> tuple[str, ...]:
    """The frames' channels in a scene of "color", "rgbd", "stereo" or "depth"."""
    return {"rgbd": ("color", "depth"), "stereo": ("color", "right")}.get(name, (name,))


def follow(participant: Participant, scene: StressScene, channels: str) -> Followed:
    """One tracker from the first true box on."""
    names = channels_of(channels)
    depth = scene.intrinsics if "depth" in names else None
    offer = Offered(names, depth, scene.rig)
    tracker = participant.contender(offer)
    frames = map(participant.view(offer), scene.frames)
    run = one_pass.run(tracker, frames, Box(*scene.boxes[0].tolist()))
    return Followed(
        participant.label,
        scene.kind,
        scene.seed,
        channels,
        Said.of(run, run.boxes, scene.boxes, scene.visible <= 0),
        metrics.position_errors(run.positions, scene.positions),
        scene.visible >= SEEN,
        found_again(run, scene),
        faithful(run, scene),
        told(run, scene),
        tracker.trouble,
    )


def found_again(run: Run, scene: StressScene) -> float:
    """Share of the events "leaving" and "hidden" after which the overlap is above 0.5 in one of the first
    AGAIN frames in which the target is wholly visible again; NaN without such an event.
    """
    overlaps = metrics.overlaps(run.boxes, scene.boxes)
    known = []
    for name in ("leaving", "hidden"):
        back = _back(scene, name)
        if back is not None:
            known.append(bool((overlaps[back : back + AGAIN] > GOOD).any()))
    return float(np.mean(known)) if known else float("nan")


def _back(scene: StressScene, event: str) -> int | None:
    """The first frame after an event's last one without the target in which it is whole; None without."""
    span = scene.spans.get(event, range(0))
    gone = [index for index in span if scene.visible[index] <= 0]
    if not gone:
        return None
    whole = np.flatnonzero(scene.visible[gone[-1] + 1 :] >= WHOLE)
    return None if not whole.size else gone[-1] + 1 + int(whole[0])


def faithful(run: Run, scene: StressScene) -> float:
    """1 where it was never TRACKED on a look-alike for more than PATIENCE frames in a row, else 0; NaN
    without look-alikes.
    """
    if "lookalike" not in scene.spans:
        return float("nan")
    others = np.nan_to_num([metrics.overlaps(run.boxes, boxes) for boxes in scene.lookalikes]).max(axis=0)
    target = np.nan_to_num(metrics.overlaps(run.boxes, scene.boxes))
    tracked = np.array([status is Status.TRACKED for status in run.statuses])
    return float(longest(tracked & (others > OTHER) & (target < NOT_TARGET)) <= PATIENCE)


def longest(flags: NDArray[np.bool_]) -> int:
    """The most flags in a row."""
    most = now = 0
    for flag in flags.tolist():
        now = now + 1 if flag else 0
        most = max(most, now)
    return most


def told(run: Run, scene: StressScene) -> float:
    """1 where LOST was said in one of the first PROMPT frames of the event "blank" without the target, else
    0; NaN without the event.
    """
    gone = [index for index in scene.spans.get("blank", range(0)) if scene.visible[index] <= 0]
    if not gone:
        return float("nan")
    return float(Status.LOST in run.statuses[gone[0] : gone[0] + PROMPT])
