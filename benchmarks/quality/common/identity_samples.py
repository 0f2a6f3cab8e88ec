# SPDX-License-Identifier: MIT
"""The identity features of the fused tracker on a recorded sequence, at the target and at other places.

The tracker follows and learns whatever it finds, so that it also loses the target. At random, a copy of the
tracker is shown some frames in which the target is covered; the tracker itself doesn't see these.
"""

import copy
from collections.abc import Iterator
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue import kernels
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics
from tricue.evaluation.confidence import LOST_OVERLAP
from tricue.track.fused.identity import IdentityFeatures
from tricue.track.fused.localize import LocalizationModel, localize
from tricue.track.fused.measure import Match, measure_candidate
from tricue.track.fused.prepared_frame import prepare_frame
from tricue.track.fused.proposals import LostTarget, propose_windows
from tricue.track.fused.state import FusedState
from tricue.track.fused.tracker import FusedTracker
from tricue.track.fused.verify import running_mean_rate
from tricue.track.fused.window import extract_windows

from benchmarks.quality.common.confidence_summary import ON_TARGET_OVERLAP
from benchmarks.quality.common.covering import cover_target
from benchmarks.quality.common.frame_results import Array
from benchmarks.quality.common.protocols import ORDERS
from benchmarks.quality.common.sequence_runs import SequenceTask

MIN_FRAMES = 20
"""Of a run."""
FRAMES_BEFORE_COVER = 15
COVER_CHANCE = 1 / 50
"""Per frame."""
COVERED_FRAMES = 3, 25
"""The minimum, and one more than the maximum."""
ELSEWHERE_EVERY, COVERED_ELSEWHERE_EVERY = 8, 3
"""Frames from one in which places elsewhere are measured to the next."""
ELSEWHERE_PLACES = 3
"""Per frame: those with the most evidence."""
MISSED_FRAMES = 10
"""Of the search that proposes places elsewhere."""


class Kind(IntEnum):
    """What a sample shows.

    GOOD: the target, where it was tracked. COVERED: the same place while the target is covered. LOST: a
    tracked place without the target. ELSEWHERE: a place without the target that a search finds.
    """

    GOOD = 0
    COVERED = 1
    LOST = 2
    ELSEWHERE = 3


class Samples(NamedTuple):
    """N samples of one sequence.

    features: (N, 8) the IdentityFeatures, and their differences from the running means over good frames.
    """

    kinds: NDArray[np.intp]
    features: Array


class _Sample(NamedTuple):
    kind: Kind
    features: IdentityFeatures
    typical: IdentityFeatures


def collect(task: SequenceTask) -> Samples:
    """The samples of all runs on a color sequence. Frames without a true box are left out."""
    opened = task.entry.open()
    decoded = list(opened.source)
    truth = opened.truth(len(decoded))
    known = np.flatnonzero(~np.isnan(truth).any(axis=1))
    frames = [Frame(decoded[number].color) for number in known]
    rng = np.random.default_rng(0)
    found: list[_Sample] = []
    for order in ORDERS:
        numbers = order.numbers(len(frames))
        if len(numbers) > MIN_FRAMES:
            found += _run([frames[number] for number in numbers], truth[known[numbers]], rng)
    kinds = np.array([each.kind for each in found], np.intp)
    features = np.array([each.features for each in found]).reshape(-1, len(IdentityFeatures._fields))
    typical = np.array([each.typical for each in found]).reshape(features.shape)
    return Samples(kinds, np.concatenate([features, features - typical], axis=1))


def _run(frames: list[Frame], truth: Array, rng: np.random.Generator) -> Iterator[_Sample]:
    """The samples of one run; truth: (N, 4)."""
    tracker = FusedTracker(min_score=0, min_score_to_move=0)
    tracker.init(frames[0], Box(*truth[0].tolist()))
    typical: IdentityFeatures | None = None
    good_frames = covered_frames = 0
    for step, (frame, box) in enumerate(zip(frames[1:], truth[1:], strict=True)):
        if not covered_frames and step > FRAMES_BEFORE_COVER and rng.random() < COVER_CHANCE:
            covered_frames = int(rng.integers(*COVERED_FRAMES))
        covered = covered_frames > 0
        covered_frames -= covered
        seen, follower = (cover_target(frame, box), copy.copy(tracker)) if covered else (frame, tracker)
        track = follower.update(seen)
        kind = Kind.COVERED if covered else _kind(track.box, box)
        state = _state(follower)
        features = state.features
        assert features is not None, "a frame was tracked"
        if kind is not None:
            yield _Sample(kind, features, typical or features)
        if kind is Kind.GOOD:
            good_frames += 1
            rate = running_mean_rate(good_frames, state.seconds)
            typical = features if typical is None else typical.blend(features, rate)
        every = COVERED_ELSEWHERE_EVERY if covered else ELSEWHERE_EVERY
        if step % every == 0:
            for match in _elsewhere(tracker, seen, step, rng):
                if covered or _kind(match.target.box, box) is Kind.LOST:
                    elsewhere = match.candidate.features
                    yield _Sample(Kind.ELSEWHERE, elsewhere, typical or elsewhere)


def _elsewhere(tracker: FusedTracker, frame: Frame, step: int, rng: np.random.Generator) -> list[Match]:
    """The places with the most evidence, in a random window and in those that a search proposes."""
    state, p = _state(tracker), tracker.params
    k = kernels.load(tracker.kernels)
    prepared = prepare_frame(frame, state.shape, (None, None), False)
    observation = prepared.for_target(k, None)
    appearance = state.models[observation.kind]
    model = LocalizationModel(appearance, None, state.first_side, state.typical, p)
    height, width = state.shape
    random = state.target._replace(x=rng.uniform(0, width), y=rng.uniform(0, height))
    windows = extract_windows(observation, [random], p.context)
    windows += propose_windows(model, observation, LostTarget(state.target, None, MISSED_FRAMES, step))
    candidates = sorted((localize(model, each) for each in windows), key=lambda each: -each.evidence)
    return [measure_candidate(model, each) for each in candidates[:ELSEWHERE_PLACES]]


def _state(tracker: FusedTracker) -> FusedState:
    """A tracker's state, which has the features of its last match."""
    state = tracker._state
    assert state is not None, "the tracker was initialized"
    return state


def _kind(box: Box, truth: Array) -> Kind | None:
    """The kind of a tracked place; None between good and lost."""
    overlap = metrics.overlaps(np.array([box]), truth[None])[0]
    return Kind.GOOD if overlap > ON_TARGET_OVERLAP else Kind.LOST if overlap < LOST_OVERLAP else None
