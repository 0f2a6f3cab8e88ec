# SPDX-License-Identifier: MIT
import warnings

import numpy as np
import pytest
from tricue.evaluation import metrics

matplotlib = pytest.importorskip("matplotlib", reason="got10k plots: pip install tricue[got10k,evaluate]")
matplotlib.use("Agg")
pytest.importorskip("got10k", reason="the toolkit we are compared with: pip install tricue[got10k]")

FRAMES = 160
RESULTS = (
    "perfect",
    "drifting",
    "jittered",
    "shrunk",
    "whole",
    "off",
    "overlap",
    "center",
    "decimal",
    "missing",
)
# Only names of OTB's own sequences are seen, and some of those have fixed lengths.
NAMES = ("Basketball", "Biker", "Bolt", "Boy", "Car4", "Coke", "Deer", "Dudek", "Walking", "Woman")


def truth_of(kind, rng):
    """Boxes of whole pixels, or of tenths, some over the image's edge; sizes that twentieths divide."""
    corner = rng.integers(-20, 200, (FRAMES, 2))
    size = 20 * rng.integers(1, 6, (FRAMES, 2))
    boxes = np.hstack([corner, size]).astype(np.float64)
    return boxes / 10 + [0.3, 0.7, 0, 0] if kind == "decimal" else boxes


def result_of(kind, truth, rng):
    """What a tracker might have said, each kind with another way to be wrong."""
    steps = np.arange(FRAMES)
    found = truth.copy()
    if kind == "drifting":
        found[:, 0] += 0.731 * steps
    elif kind == "jittered":
        found += rng.normal(0, 6, found.shape)
        found[:, 2:] = np.maximum(found[:, 2:], 1)
    elif kind == "shrunk":
        found += truth[:, [2, 3, 2, 3]] * [0.21, 0.21, -0.42, -0.42]
    elif kind == "whole":
        found += rng.integers(-9, 10, found.shape)
    elif kind == "off":
        found[FRAMES // 2 :, 0] = -500
    elif kind == "overlap":  # n / 20 of the true box: overlaps on the thresholds
        found[:, 2] *= (1 + steps % 20) / 20
    elif kind == "center":  # 3 : 4 : 5, errors of whole pixels, 20 and 50 px among them
        found[:, :2] += np.outer(steps % 11, [3, 4]) * rng.choice([-1, 1], (FRAMES, 2))
    elif kind == "decimal":  # both, but only nearly on the thresholds, as decimals aren't exact
        found[:80, 2] *= (1 + steps[:80] % 20) / 20
        found[80:, :2] += np.outer(steps[80:] % 21, [0.6, 0.8]) * rng.choice([-1, 1], (80, 2))
    elif kind == "missing":
        found[rng.random(FRAMES) < 0.3] = np.nan
    return found


@pytest.fixture(scope="module")
def evaluated(tmp_path_factory):
    """The true boxes and results as read from the files, and got10k's report on the same files."""
    from got10k.datasets import OTB
    from got10k.experiments import ExperimentOTB

    class LocalOTB(ExperimentOTB):
        """The experiment, without the download that its constructor asks for."""

        def __init__(self, folder):
            self.dataset = OTB(str(folder / "OTB"), version=2015, download=False)
            self.result_dir, self.report_dir = str(folder / "results"), str(folder / "reports")
            self.nbins_iou, self.nbins_ce = 21, 51

    folder = tmp_path_factory.mktemp("got10k")
    for index, (name, kind) in enumerate(zip(NAMES, RESULTS, strict=True)):
        rng = np.random.default_rng(index)
        truth = truth_of(kind, rng)
        write_sequence(folder, name, truth, result_of(kind, truth, rng))
    with warnings.catch_warnings(), matplotlib.rc_context():  # the report changes fonts
        warnings.simplefilter("ignore")
        report = LocalOTB(folder).report(["ours"])["ours"]
    matplotlib.pyplot.close("all")
    return {kind: read_sequence(folder, name) for kind, name in zip(RESULTS, NAMES, strict=True)}, report


def write_sequence(folder, name, truth, found):
    """A sequence and a result as OTB and got10k lay them out; images are counted but not opened."""
    images = folder / "OTB" / name / "img"
    images.mkdir(parents=True)
    for index in range(FRAMES):
        (images / f"{index + 1:04d}.jpg").touch()
    np.savetxt(images.parent / "groundtruth_rect.txt", truth, fmt="%.3f", delimiter=",")
    (folder / "results" / "ours").mkdir(parents=True, exist_ok=True)
    np.savetxt(folder / "results" / "ours" / f"{name}.txt", found, fmt="%.3f", delimiter=",")


def read_sequence(folder, name):
    """The result, in its first row the true box, as got10k's report has it; and the truth."""
    truth = np.loadtxt(folder / "OTB" / name / "groundtruth_rect.txt", delimiter=",")
    found = np.loadtxt(folder / "results" / "ours" / f"{name}.txt", delimiter=",")
    found[0] = truth[0]
    return found, truth


@pytest.mark.parametrize("kind", RESULTS)
def test_numbers_are_got10ks(evaluated, kind):
    """From the same result file, AUC, precision at 20 px, success at 0.5 and both curves are those of
    got10k's own report, also where every frame lies on a threshold.
    """
    files, report = evaluated
    theirs = report["seq_wise"][NAMES[RESULTS.index(kind)]]
    ours = metrics.score(*files[kind])
    assert ours.auc == pytest.approx(theirs["success_score"], rel=0, abs=1e-12)
    assert ours.precision == theirs["precision_score"]
    assert ours.success == theirs["success_rate"]
    overlap, error = metrics.overlaps(*files[kind]), metrics.center_errors(*files[kind])
    np.testing.assert_array_equal(metrics.success_curve(overlap), theirs["success_curve"])
    np.testing.assert_array_equal(metrics.precision_curve(error), theirs["precision_curve"])


def test_means_over_sequences_are_got10ks(evaluated):
    """got10k's overall numbers are the means of ours over the ten sequences."""
    files, report = evaluated
    scores = [metrics.score(*pair) for pair in files.values()]
    for ours, theirs in (("auc", "success"), ("precision", "precision")):
        mean = np.mean([getattr(score, ours) for score in scores])
        assert mean == pytest.approx(report["overall"][f"{theirs}_score"], rel=0, abs=1e-12)


def test_the_files_try_what_they_should(evaluated):
    """The files differ in their numbers, and do hold overlaps and errors that lie on thresholds."""
    files, _ = evaluated
    assert len({metrics.score(*pair).auc for pair in files.values()}) == len(RESULTS)
    on_overlap = np.isin(metrics.overlaps(*files["overlap"]), np.arange(21) / 20)
    on_error = np.isin(metrics.center_errors(*files["center"]), metrics.PRECISION_THRESHOLDS)
    assert on_overlap.all()
    assert on_error.all()
