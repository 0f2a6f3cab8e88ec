# SPDX-License-Identifier: MIT
import json
import subprocess

import numpy as np
import pytest
from tricue.evaluation import long_term, metrics
from tricue.evaluation.long_term import Frames

NO_BOX = [np.nan] * 4
BOX = [10.0, 10.0, 20.0, 20.0]

# The toolkit's own functions, from regions to the reported numbers, run in its own environment. Only the
# sequence is a stand-in: it has the two things that compute_tpr_curves asks of it. What runs and files would
# add is added as UnsupervisedExperiment does: a special region without confidence in the first frame.
TOOLKIT = """
import itertools, json, sys
from vot.analysis.longterm import (
    FScoreCurve, PrecisionRecall, PrecisionRecallCurve, compute_tpr_curves, determine_thresholds)
from vot.region import Rectangle, Special, calculate_overlaps
from vot.tracker import Trajectory

class Sequence:
    size = (320, 240)
    def __init__(self, truth):
        self.truth = truth
    def groundtruth(self):
        return self.truth

def region(box):
    return Special(Trajectory.UNKNOWN) if box is None else Rectangle(*box)

given = json.load(sys.stdin)
truths = [[region(box) for box in each["truth"]] for each in given]
boxes = [[region(box) for box in each["boxes"]] for each in given]
overlaps = [calculate_overlaps(a, b, Sequence.size) for a, b in zip(boxes, truths)]
for each, result in zip(given, boxes):
    result[0], each["scores"][0] = Special(Trajectory.INITIALIZATION), 0
limits = determine_thresholds(itertools.chain(*(each["scores"] for each in given)), 100)
curves = []
for each, result, truth in zip(given, boxes, truths):
    curve = compute_tpr_curves(result, each["scores"], Sequence(truth), limits)
    curves.append((list(zip(*curve)), limits))
mean = PrecisionRecallCurve().aggregate(None, given, curves)
f = FScoreCurve().compute(None, [None], given, [[mean]])
best = PrecisionRecall().compute(None, [None], given, [[mean], [f[0, 0]]])[0, 0]
print(json.dumps({
    "overlaps": overlaps, "thresholds": limits[1:-1], "best": [float(value) for value in best],
    "recall": [float(point[0]) for point in mean[0]], "precision": [float(point[1]) for point in mean[0]],
    "f": [float(value) for value in f[0, 0][0]]}))
"""


def outing(rng, frames):
    """Boxes of whole pixels inside 320x240: a truth with absences, a result that is near, far or missing, and
    scores with ties that are better than chance.
    """
    truth = np.column_stack([rng.integers(20, 180, (frames, 2)), rng.integers(8, 50, (frames, 2))]).astype(
        float
    )
    boxes = truth + rng.integers(-8, 9, (frames, 4)) * rng.integers(0, 2, (frames, 1))
    boxes[:, 2:] = np.maximum(boxes[:, 2:], 2)
    boxes[rng.random(frames) < 0.2] = [2, 3, 10, 12]
    scores = np.round(np.clip(metrics.overlaps(boxes, truth) * 0.7 + rng.uniform(0, 0.4, frames), 0, 1), 2)
    absent = rng.random(frames) < 0.25
    boxes[rng.random(frames) < 0.1] = np.nan
    absent[0], boxes[0] = False, truth[0]
    truth[absent] = np.nan
    return boxes, truth, scores, absent


def rows(boxes):
    """Lists for JSON, None for a row of NaN."""
    return [None if np.isnan(box).any() else box.tolist() for box in boxes]


@pytest.fixture(scope="module", params=[20, 90], ids=["all-scores", "100-thresholds"])
def judged(request, vot_venv):
    """Three results, and what the toolkit says of them; fewer scores than thresholds, and more."""
    rng = np.random.default_rng(request.param)
    results = [outing(rng, request.param + index) for index in range(3)]
    given = [{"boxes": rows(b), "truth": rows(t), "scores": s.tolist()} for b, t, s, _ in results]
    said = subprocess.run(
        [vot_venv / "bin" / "python", "-c", TOOLKIT],
        input=json.dumps(given),
        capture_output=True,
        text=True,
        check=False,
    )
    assert said.returncode == 0, said.stderr
    return results, json.loads(said.stdout)


def test_overlaps_are_the_vot_toolkits(judged):
    """On boxes of whole pixels inside the image our areas give what the toolkit counts in pixels."""
    results, toolkit = judged
    for (boxes, truth, _, absent), theirs in zip(results, toolkit["overlaps"], strict=True):
        np.testing.assert_allclose(
            metrics.overlaps(boxes, truth)[~absent], np.array(theirs)[~absent], rtol=0, atol=1e-12
        )


def test_precision_recall_and_f_are_the_vot_toolkits(judged):
    """From the same boxes and scores, absent frames and missing boxes among them, come the toolkit's own
    thresholds, mean curves, and the three numbers that it reports.
    """
    results, toolkit = judged
    curve = long_term.precision_recall([long_term.vot_frames(*result) for result in results])
    np.testing.assert_array_equal(curve.thresholds[1:-1], toolkit["thresholds"])
    for name in ("precision", "recall", "f"):
        theirs = np.nan_to_num(toolkit[name])  # its F is 0 / 0 where precision and recall are 0
        np.testing.assert_allclose(getattr(curve, name), theirs, rtol=0, atol=1e-12)
    np.testing.assert_allclose(curve.best[:3], toolkit["best"], rtol=0, atol=1e-12)
    assert 0.3 < curve.best.f < 0.9


def test_f_has_its_closed_form():
    """Two sure hits of overlap 0.8, two unsure misses, one sure hallucination: by hand at every threshold."""
    one = Frames(
        np.array([0.8, 0.8, 0.0, 0.0, 0.0]),
        np.array([0.9, 0.9, 0.2, 0.2, 0.5]),
        np.array([True, True, True, True, False]),
    )
    curve = long_term.precision_recall([one])
    np.testing.assert_array_equal(curve.thresholds, [np.inf, 0.9, 0.9, 0.5, 0.2, 0.2, -np.inf])
    np.testing.assert_allclose(curve.precision, [1, 0.8, 0.8, 1.6 / 3, 0.32, 0.32, 0.32])
    np.testing.assert_allclose(curve.recall, [0, *[0.4] * 6])
    assert curve.best == pytest.approx((0.8, 0.4, 0.64 / 1.2, 0.9))


def test_curves_are_averaged_over_sequences():
    """A long sequence weighs no more than a short one: the mean of the curves, at common thresholds."""
    long = Frames(np.full(50, 0.5), np.full(50, 0.7), np.ones(50, bool))
    short = Frames(np.array([1.0]), np.array([0.9]), np.ones(1, bool))
    best = long_term.precision_recall([long, short]).best
    assert (best.precision, best.recall, best.threshold) == (0.75, 0.75, 0.7)


def test_nothing_found_is_f_0():
    """Without any overlap F is 0 and not 0 / 0."""
    curve = long_term.precision_recall([Frames(np.zeros(3), np.full(3, 0.5), np.ones(3, bool))])
    np.testing.assert_array_equal(curve.f, np.zeros(5))


def test_vot_frames_add_what_the_toolkit_adds():
    """The start counts as a visible frame that was missed at score 0; an absent frame is right only without a
    box; a frame of unknown truth isn't there, and neither argument is changed.
    """
    scores = np.array([0.9, 0.8, 0.7, 0.6, 0.5])
    truth = [BOX, BOX, NO_BOX, NO_BOX, NO_BOX]
    frames = long_term.vot_frames(
        [BOX, BOX, BOX, NO_BOX, BOX], truth, scores, np.array([0, 0, 1, 1, 0], bool)
    )
    np.testing.assert_array_equal(frames.overlaps, [0, 1, 0, 1])
    np.testing.assert_array_equal(frames.scores, [0, 0.8, 0.7, 0.6])
    np.testing.assert_array_equal(frames.visible, [True, True, False, False])
    assert scores[0] == 0.9


def test_thresholds_cut_the_scores_into_equal_shares():
    """Of a thousand different scores 98 are taken, ten or eleven apart, falling, between the infinities."""
    limits = long_term.thresholds(np.random.default_rng(0).permutation(1000) / 1000)
    assert limits.size == 100
    assert (limits[0], limits[-1]) == (np.inf, -np.inf)
    steps = -np.diff(limits[1:-1]) * 1000
    assert steps.min() > 9.5
    assert steps.max() < 11.5


def test_rates_are_oxuvas():
    """Present counts with an overlap of 0.5 on: here of four visible frames one is found, one badly, one is
    not reported, one has no box; of three absent frames two are reported; and one frame is unknown.
    """
    half = [10.0, 10.0, 10.0, 20.0]
    found = [half, [28, 10, 20, 20], BOX, NO_BOX, BOX, NO_BOX, BOX, BOX]
    truth = [BOX] * 4 + [NO_BOX] * 4
    said = np.array([1, 1, 0, 1, 0, 0, 1, 1], bool)
    absent = np.array([0, 0, 0, 0, 1, 1, 1, 0], bool)
    rates = long_term.rates(found, truth, said, absent)
    assert rates == (0.25, pytest.approx(2 / 3))


def test_rates_without_their_frames_are_nan():
    """A target that is always there has no true-negative rate, one that never is no true-positive rate."""
    yes, no = np.array([True]), np.array([False])
    np.testing.assert_array_equal(long_term.rates([BOX], [BOX], yes, no), [1, np.nan])
    np.testing.assert_array_equal(long_term.rates([BOX], [NO_BOX], yes, yes), [np.nan, 0])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: long_term.precision_recall([]), "sequences: expected one or more"),
        (
            lambda: long_term.precision_recall([Frames(np.zeros(1), np.zeros(1), np.zeros(1, bool))]),
            r"expected visible frames in each, got none in sequences\[0\]",
        ),
        (lambda: long_term.thresholds([0.5], 2), "resolution: expected 3 or more"),
        (lambda: long_term.rates([BOX], [BOX], [1], [False]), "reported_present: expected bool"),
        (lambda: long_term.rates([BOX], [BOX], [True], [False] * 2), "absent: expected bool of shape"),
        (lambda: long_term.vot_frames([BOX], [BOX], [[0.5]], [False]), "scores: expected an array of shape"),
        (lambda: long_term.vot_frames([BOX] * 2, [BOX], [0.5], [False]), "boxes: expected as many rows"),
    ],
)
def test_bad_input_is_named(call, words):
    """Every malformed argument is refused by name."""
    with pytest.raises(ValueError, match=words):
        call()
