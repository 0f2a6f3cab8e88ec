# SPDX-License-Identifier: MIT
"""The VOT toolkit itself runs our trackers, in color and in color with depth, without a network.

It exits with 0 whatever happens, so that its words and its numbers are what is looked at.
"""

import json
import os
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tricue
from numpy.typing import NDArray
from tricue import Box, Frame
from tricue.cli import main
from tricue.data.open_source import open_source
from tricue.evaluation import one_pass
from tricue.scenes import face_over_clutter, overtaking

pytest.importorskip("trax")
pytest.importorskip("skimage")

EXPERIMENTS = ("longterm", "baseline", "supervised")
SHARE = 0.1  # of the target that is visible at least where the true box is given
SPOKEN = 8.1e-5  # pixels: half of the protocol's fourth decimal, and twice half a step of float32 below 512


@dataclass(frozen=True)
class Trial:
    """A workspace in which the toolkit has run: its folder, what it said, and its numbers."""

    folder: Path
    tracker: str
    sequence: str
    evaluate: str
    analysis: str

    @property
    def numbers(self) -> dict[str, Any]:
        """The results of the analyses by experiment."""
        found = json.loads((self.folder / "analysis" / "all.json").read_text())
        return {name: found["results"][name]["results"] for name in EXPERIMENTS}

    def result(self, experiment: str, name: str) -> list[str]:
        """The lines of a file of results."""
        path = self.folder / "results" / self.tracker / experiment / self.sequence / f"{self.sequence}_{name}"
        return path.read_text().splitlines()

    def trajectory(self, experiment: str = "longterm", name: str = "001.txt") -> NDArray[np.float64]:
        """(M - 1, 4): the boxes after the first frame, in which the toolkit only notes the start."""
        lines = self.result(experiment, name)
        assert lines[0] == "1"
        return np.array([[float(word) for word in line.split(",")] for line in lines[1:]])


def write_recording(folder: Path, frames: Sequence[Frame], boxes: Sequence[Box | None]) -> None:
    """A sequence folder: color/, depth/ in millimeters if there is depth, and the true boxes."""
    for index, frame in enumerate(frames, 1):
        for channel in frame.channels:
            (folder / channel).mkdir(parents=True, exist_ok=True)
            image = getattr(frame, channel)
            units = np.rint(np.nan_to_num(1000 * image)).astype(np.uint16) if channel == "depth" else image
            cv2.imwrite(str(folder / channel / f"{index:08}.png"), units)
    lines = ["nan,nan,nan,nan" if box is None else ",".join(map(str, box)) for box in boxes]
    (folder / "groundtruth.txt").write_text("\n".join(lines))


def said_by(venv: Path, *words: str) -> str:
    """All that the toolkit prints; binary results and an interpreter for trackers are its own business."""
    done = subprocess.run(
        [str(venv / "bin" / "vot"), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        timeout=300,
        env={**os.environ, "VOT_RESULTS_BINARY": "false", "no_proxy": "*"},
    )
    return done.stdout


def run_toolkit(venv: Path, folder: Path, tracker: str) -> Trial:
    """Write the workspace of the recordings in ``folder``, evaluate and analyze."""
    place = folder / "workspace"
    data = folder / "recordings"
    assert main(["vot-workspace", str(place), "--trackers", tracker, "--sequences", str(data)]) == 0
    (sequence,) = data.iterdir()
    evaluate = said_by(venv, "evaluate", "--workspace", str(place), tracker)
    analysis = said_by(
        venv, "analysis", "--workspace", str(place), "--format", "json", "--name", "all", tracker
    )
    return Trial(place, tracker, sequence.name, evaluate, analysis)


@pytest.fixture(scope="module")
def face(vot_venv: Path, tmp_path_factory: pytest.TempPathFactory) -> Trial:
    """A slow face over clutter, in color."""
    folder = tmp_path_factory.mktemp("color")
    scene = face_over_clutter(0, 60, max_speed=6.0, brightness=(0.9, 1.1))
    write_recording(folder / "recordings" / "face", scene.frames, scene.boxes)
    return run_toolkit(vot_venv, folder, "color-particle")


@pytest.fixture(scope="module")
def walk(vot_venv: Path, tmp_path_factory: pytest.TempPathFactory) -> Trial:
    """A walker who is hidden for a while, absent for VOT, before a color and depth camera."""
    folder = tmp_path_factory.mktemp("depth")
    scene = overtaking(0, 60, depth=True)
    boxes = [box if seen >= SHARE else None for box, seen in zip(scene.boxes, scene.visible, strict=True)]
    assert sum(box is None for box in boxes) > 10
    write_recording(folder / "recordings" / "walk", scene.frames, boxes)
    return run_toolkit(vot_venv, folder, "flow-depth")


@pytest.fixture(params=["face", "walk"])
def trial(request: pytest.FixtureRequest) -> Trial:
    """Each of the two."""
    found: Trial = request.getfixturevalue(request.param)
    return found


def numbers_in(value: Any) -> list[float]:
    """All numbers of nested lists."""
    if isinstance(value, list):
        return [number for each in value for number in numbers_in(each)]
    return [float(value)]


def own_run(trial: Trial) -> tuple[one_pass.Run, NDArray[np.float64]]:
    """Our own evaluation's run on the workspace's images, and the true boxes.

    The protocol tells no times, so that the frames have none here either.
    """
    source = open_source(trial.folder / "sequences" / trial.sequence)
    frames = [Frame(frame.color, frame.depth) for frame in source]
    assert source.truth is not None
    assert source.first_box is not None
    return one_pass.run(tricue.create(trial.tracker, seed=0), frames, source.first_box), source.truth


def test_the_toolkit_says_that_it_worked(trial: Trial) -> None:
    """It proves that evaluation and analysis end with the toolkit's own words of success."""
    assert "Evaluation concluded successfuly" in trial.evaluate, trial.evaluate
    assert "Analysis successful" in trial.analysis, trial.analysis


def test_every_number_is_there_and_finite(trial: Trial) -> None:
    """It proves that the three experiments have all their results: accuracy, precision, recall, F, accuracy
    and robustness with their plots, expected overlap, and those of the supervised run.
    """
    counts = {name: [len(numbers_in(each)) for each in found] for name, found in trial.numbers.items()}
    assert counts == {"longterm": [1, 3], "baseline": [6, 1], "supervised": [5]}
    assert np.isfinite([number for found in trial.numbers.values() for number in numbers_in(found)]).all()


def test_the_trajectory_is_that_of_our_own_evaluation(trial: Trial) -> None:
    """It proves that neither channel order, depth unit, box convention nor seed differ between the toolkit's
    run and ours: boxes agree to the protocol's decimals, confidences are the scores.
    """
    run, _ = own_run(trial)
    np.testing.assert_allclose(trial.trajectory(), run.boxes[1:], rtol=0, atol=SPOKEN)
    confidences = [float(line) for line in trial.result("longterm", "001_confidence.value")[1:]]
    np.testing.assert_allclose(confidences, np.clip(run.scores[1:], 0, 1), rtol=0, atol=1e-6)
    assert np.ptp(confidences) > 1e-3  # they are not one and the same number


def test_the_toolkit_s_accuracy_is_the_mean_overlap(trial: Trial) -> None:
    """It proves that the toolkit reads our true boxes as we do: its accuracy is the mean overlap over the
    frames with a true box but the first, up to its counting of whole pixels.
    """
    run, truth = own_run(trial)
    visible = [index for index in range(1, len(truth)) if np.isfinite(truth[index]).all()]
    overlaps = [Box(*run.boxes[index]).iou(Box(*truth[index])) for index in visible]
    accuracy = trial.numbers["longterm"][0][0][0]
    assert accuracy == pytest.approx(np.mean(overlaps), abs=0.02)


def centers(boxes: NDArray[np.float64]) -> NDArray[np.float64]:
    """(M, 2) of (M, 4)."""
    return boxes[:, :2] + boxes[:, 2:] / 2


def test_easy_scenes_are_tracked(face: Trial, walk: Trial) -> None:
    """It proves that the numbers are those of trackers that work: the face all the time, without a failure,
    the walker until somebody comes before it, and again after that.
    """
    (accuracy,), (precision, recall, f_measure) = (each[0] for each in face.numbers["longterm"])
    assert min(accuracy, precision, recall, f_measure) > 0.85
    assert face.numbers["supervised"][0][0][1] == 0  # failures
    found, truth = walk.trajectory(), open_source(walk.folder / "sequences" / "walk").truth
    assert truth is not None
    distances = np.hypot(*(centers(found) - centers(truth[1:])).T)
    assert distances[:12].max() < 5  # pixels, a third of the target's width
    assert distances[-8:].max() < 5


def test_every_start_has_its_run(walk: Trial) -> None:
    """It proves that multistart went both ways from its anchors, and that the supervised run started again
    only on true boxes, after those without.
    """
    assert len(walk.trajectory("baseline", "00000000.txt")) == 59
    assert len(walk.trajectory("baseline", "00000050.txt")) == 50  # backwards to the first frame
    marks = walk.result("supervised", "001.txt")
    starts = [index for index, line in enumerate(marks) if line == "1"]
    absent = (walk.folder / "sequences" / "walk" / "absent.tag").read_text().splitlines()
    assert len(starts) > 1
    assert all(absent[index] == "0" for index in starts)


def test_vot_test_passes(walk: Trial, vot_venv: Path) -> None:
    """It proves that the toolkit's own check of a tracker ends well, on a sequence with depth."""
    registry, sequence = walk.folder / "trackers.ini", walk.folder / "sequences" / "walk"
    said = said_by(vot_venv, "--registry", str(registry), "test", "-s", str(sequence), "flow-depth")
    assert "Test concluded successfuly" in said, said
    assert said.count("@@TRAX:state") == 60


def test_a_failure_is_told_with_the_file(walk: Trial, vot_venv: Path, tmp_path: Path) -> None:
    """It proves that a damaged image ends the evaluation, with its name in the toolkit's log."""
    data = tmp_path / "recordings" / "cut"
    data.mkdir(parents=True)
    for part in ("color", "depth", "groundtruth.txt"):
        (data / part).symlink_to(walk.folder / "sequences" / "walk" / part)
    place = tmp_path / "ws"
    arguments = ["--trackers", "flow-depth", "--sequences", str(tmp_path / "recordings")]
    assert main(["vot-workspace", str(place), *arguments]) == 0
    damaged = place / "sequences" / "cut" / "depth" / "00000004.png"
    damaged.unlink()
    damaged.write_bytes(b"no picture")
    words = ["evaluate", "--workspace", str(place), "--experiments", "longterm", "flow-depth"]
    said = said_by(vot_venv, *words)
    assert "Evaluation concluded successfuly" not in said
    logs = "".join(path.read_text() for path in (place / "logs").iterdir())
    assert f"{damaged}: expected an image" in said + logs
