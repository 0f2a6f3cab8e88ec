# SPDX-License-Identifier: MIT
"""Trackers on one recorded sequence in which the target is hidden for a while: their behavior then and after.

In a run, the target is first visible, then hidden, then visible again. Sequences that are too short are
repeated in alternating directions.
"""

from collections.abc import Iterable, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics
from tricue.evaluation.dataset import OpenedSequence
from tricue.track.base.track import Status, Track

from benchmarks.quality.common.confidence_summary import ON_TARGET_OVERLAP
from benchmarks.quality.common.covering import cover_target
from benchmarks.quality.common.frame_results import GOOD_OVERLAP, Array, Flags
from benchmarks.quality.common.scene_runs import longest_run
from benchmarks.quality.common.sequence_runs import SequenceTask
from benchmarks.quality.common.variants import Inputs, Variant

LENGTHS = 30, 100, 300
"""Numbers of frames in which the target is hidden."""
COVERED, EMPTY = "covered", "empty"
"""The video continues while the moving target is covered; or one frame with it covered is repeated."""
MAX_SEEN_FRAMES = 60
"""Frames in which the target is visible before it is hidden; half of the sequence, if that is less."""
MAX_RECOVERY_FRAMES = 30
"""Frames within which a visible target must be found again."""
COLOR = Inputs(("color",))


class Hiding(NamedTuple):
    """How a target is hidden: COVERED or EMPTY, for how many frames, in the sequence or its reverse."""

    kind: str
    frames: int
    backward: bool


class HiddenResult(NamedTuple):
    """One tracker on a sequence with a hidden target.

    taken_up: whether it was TRACKED, with an overlap above 0.3, in one of the first frames after it was
    hidden. wrong_frames: the longest run of frames in which something else was TRACKED while it was hidden.
    """

    tracker: str
    sequence: str
    hiding: Hiding
    taken_up: bool
    wrong_frames: int


HIDINGS = tuple(Hiding(*each) for each in product((COVERED, EMPTY), LENGTHS, (False, True)))


def run_sequence(task: SequenceTask) -> list[HiddenResult]:
    """All trackers that can use color, with all ways of hiding; without runs that lost the target before.

    Frames without a true box are left out of the sequence.
    """
    able = [each for each in task.variants if not each.unsupported(COLOR)]
    opened = task.entry.open()
    if not able or opened.channel != "color":
        return []
    decoded = list(opened.source)
    truth = opened.truth(len(decoded))
    known = np.flatnonzero(~np.isnan(truth).any(axis=1))
    if len(known) < 4:  # two before the target is hidden, and two others
        return []
    frames = [Frame(decoded[number].color) for number in known]
    runs = [
        run_hidden(variant, opened, frames, truth[known], hiding) for variant in able for hiding in HIDINGS
    ]
    return [each for each in runs if each is not None]


def run_hidden(
    variant: Variant, opened: OpenedSequence, frames: Sequence[Frame], truth: Array, hiding: Hiding
) -> HiddenResult | None:
    """One tracker on N frames with true boxes, (N, 4); None if it lost the target before this was hidden."""
    seen = min(MAX_SEEN_FRAMES, len(frames) // 2)
    numbers = to_and_fro(len(frames), seen + hiding.frames + MAX_RECOVERY_FRAMES, hiding.backward)
    before, hidden, after = np.split(numbers, [seen, seen + hiding.frames])
    tracker = variant.make(COLOR)
    tracker.init(frames[before[0]], Box(*truth[before[0]].tolist()))
    tracks = [tracker.update(frames[number]) for number in before[1:]]
    if not _overlaps(tracks, truth[before[1:]], opened)[-1] >= GOOD_OVERLAP:
        return None
    if hiding.kind == EMPTY:
        hidden = np.full_like(hidden, hidden[0])
    wrong = _tracked(tracker.update(cover_target(frames[number], truth[number])) for number in hidden)
    tracks = [tracker.update(frames[number]) for number in after]
    right = _tracked(tracks) & (_overlaps(tracks, truth[after], opened) > ON_TARGET_OVERLAP)
    return HiddenResult(variant.label, opened.entry.name, hiding, bool(right.any()), longest_run(wrong))


def to_and_fro(frames: int, count: int, backward: bool) -> NDArray[np.intp]:
    """(count,) frame numbers of a sequence that is repeated, turning around at its ends."""
    way = np.arange(frames)[:: -1 if backward else 1]
    return np.resize(np.concatenate([way, way[-2:0:-1]]), count)


def _tracked(tracks: Iterable[Track]) -> Flags:
    return np.array([track.status is Status.TRACKED for track in tracks], np.bool_)


def _overlaps(tracks: Sequence[Track], truth: Array, opened: OpenedSequence) -> Array:
    return metrics.overlaps(opened.clip(np.array([track.box for track in tracks])), truth)
