# SPDX-License-Identifier: MIT
"""Raw results: what others read in the files is what the trackers said."""

import json
import shutil
import subprocess
from pathlib import Path

import cv2
import numpy as np
import pytest
import tricue
from tricue.cli import main
from tricue.evaluation import evaluate as evaluation
from tricue.evaluation import raw_results, tables
from tricue.evaluation.metrics import score
from tricue.evaluation.record import Record

FRAMES = {"there": 20, "back": 20, "gap": 14}
SEEDS = 2


@pytest.fixture(scope="module")
def finished(folders, tmp_path_factory):
    """An evaluation by several protocols, and the folder of its raw results, which are of one."""
    place = tmp_path_factory.mktemp("evaluation")
    options = evaluation.Options(
        trackers=("color-particle", "still-box"), seeds=SEEDS, restarts=False, protocols=("every-3",)
    )
    done = evaluation.evaluate(folders, place, options)
    manifest = raw_results.write_raw(
        done, place, place / "raw", tables.settings(done, dataset="secret"), "MIT"
    )
    return done, place, manifest.parent


def boxes_of(place: Path, tracker: str, sequence: str, seed: int = 0) -> np.ndarray:
    """The boxes that a run stored."""
    path = place / "runs" / "one-pass" / tracker / sequence / f"seed-{seed}.json"
    return Record.from_json(path.read_text()).run.boxes


def read(path: Path) -> np.ndarray:
    """A file's numbers, by a reader that isn't ours."""
    return np.loadtxt(path, delimiter=",", ndmin=2)


@pytest.mark.parametrize("sequence", FRAMES)
def test_each_form_has_the_boxes_of_the_run(finished, sequence):
    """A line a frame, to a ten-thousandth of a pixel, of each seed where the form has repetitions."""
    _, place, raw = finished
    for seed in range(SEEDS):
        true = boxes_of(place, "color-particle", sequence, seed)
        assert len(true) == FRAMES[sequence]
        name = f"{sequence}_{seed + 1:03d}"
        found = read(raw / "got10k" / "color-particle" / sequence / f"{name}.txt")
        np.testing.assert_allclose(found, true, atol=5e-5, rtol=0)
        lines = (raw / "vot/color-particle/longterm" / sequence / f"{name}.txt").read_text().splitlines()
        assert lines[0] == "1"
        rest = np.array([line.split(",") for line in lines[1:]], np.float64)
        np.testing.assert_allclose(rest, true[1:], atol=5e-5, rtol=0)
    first = read(raw / "otb" / "color-particle" / f"{sequence}.txt")
    counted_from_1 = boxes_of(place, "color-particle", sequence) + [1, 1, 0, 0]
    np.testing.assert_allclose(first, counted_from_1, atol=5e-5, rtol=0)


def test_times_have_a_column_a_seed_and_none_for_the_first_frame(finished):
    """They are those of the evaluation's speed, and 0 where nothing was measured."""
    done, _, raw = finished
    times = read(raw / "got10k" / "color-particle" / "there" / "there_time.txt")
    assert times.shape == (20, SEEDS)
    assert not times[0].any()
    assert (times[1:] > 0).all()
    results = [each for each in done.one_pass if each.task.entry.name == "there" and each.task.tracker.ours]
    for column, each in zip(times.T, results, strict=True):
        assert 19 / column.sum() == pytest.approx(each.speed.fps, rel=1e-3)


def test_the_score_of_the_files_is_that_of_the_evaluation(finished):
    """Whoever evaluates the files anew gets our AUC."""
    done, _, raw = finished
    for each in done.one_pass:
        opened = next(known for known in done.opened if known.entry == each.task.entry)
        name = f"{each.row.sequence}_{each.row.seed + 1:03d}.txt"
        found = read(raw / "got10k" / each.row.tracker / each.row.sequence / name)
        assert score(found, opened.truth(len(found))).auc == pytest.approx(each.row.auc, abs=1e-6)


def test_the_manifest_says_what_made_them(finished):
    """Versions, parameters, sequences and conventions, and no path of the user's."""
    _, _, raw = finished
    text = (raw / "manifest.json").read_text()
    manifest = json.loads(text)
    assert manifest["tricue"] == tricue.__version__
    assert manifest["license"] == "MIT"
    assert manifest["parameters"]["color-particle"]["particles"] == 100
    assert manifest["seeds"] == SEEDS
    assert {name: each["frames"] for name, each in manifest["sequences"].items()} == FRAMES
    assert len({each["digest"] for each in manifest["sequences"].values()}) == 3
    assert {"opencv", "numpy", "machine", "code", "commit"} <= set(manifest)
    assert "(0, 0) is the top-left corner" in manifest["conventions"]["boxes"]
    assert "secret" not in text


def test_the_vot_toolkit_reads_its_form(finished, vot_venv):
    """Its own reader finds boxes and confidences."""
    _, place, raw = finished
    code = f"""
from vot.tracker.results import Results, Trajectory
from vot.workspace.storage import LocalStorage
storage = LocalStorage({str(raw / "vot/color-particle/longterm/there")!r})
found = Trajectory.read(Results(storage), "there_001")
assert len(found) == 20 and found.region(0).code == 1, found.region(0)
assert set(found.properties()) == {{"confidence", "time"}}
for index in range(1, 20):
    region = found.region(index)
    print(region.x, region.y, region.width, region.height)
"""
    run = subprocess.run(
        [vot_venv / "bin" / "python", "-c", code], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    found = np.array([line.split() for line in run.stdout.splitlines()], np.float64)
    np.testing.assert_allclose(found, boxes_of(place, "color-particle", "there")[1:], atol=1e-3)


def test_a_frame_without_a_box_is_told(tmp_path, finished):
    """Before a late start, and after an error, which the manifest names."""
    done, place, _ = finished
    result = next(each for each in done.results if each.row.sequence == "gap" and each.task.tracker.ours)
    path = place / "runs" / "one-pass" / "color-particle" / "gap" / f"seed-{result.task.seed}.json"
    kept = path.read_text()
    values = json.loads(kept)
    values["boxes"] = [None, None, *values["boxes"][2:-1], None]
    values["starts"], values["seconds"] = [2], values["seconds"][2:]
    path.write_text(json.dumps(values))
    try:
        raw = raw_results.write_raw(done, place, tmp_path / "raw", tables.settings(done)).parent
    finally:
        path.write_text(kept)
    number = result.task.seed + 1
    boxes = read(raw / "got10k" / "color-particle" / "gap" / f"gap_{number:03d}.txt")
    assert np.isnan(boxes[[0, 1, -1]]).all()
    assert not np.isnan(boxes[2:-1]).any()
    lines = (raw / "vot/color-particle/longterm/gap" / f"gap_{number:03d}.txt").read_text().splitlines()
    assert [lines[0], lines[1], lines[2], lines[-1]] == ["0", "0", "1", "0"]
    times = read(raw / "got10k" / "color-particle" / "gap" / "gap_time.txt")[:, number - 1]
    assert list(np.flatnonzero(times)) == list(range(3, 14))


def test_the_command_writes_them_and_replaces_only_its_own(folders, tmp_path, capsys):
    """A second run replaces what the first wrote; a folder of something else is refused before any run."""
    command = [
        "evaluate",
        str(folders),
        "--trackers",
        "still-box",
        "--no-restarts",
        "--output",
        str(tmp_path / "e"),
    ]
    raw = tmp_path / "raw"
    assert main([*command, "--raw", str(raw)]) == 0
    assert str(raw / "manifest.json") in capsys.readouterr().out
    (raw / "otb" / "stale.txt").write_text("1,2,3,4\n")
    assert main([*command, "--raw", str(raw)]) == 0
    assert not (raw / "otb" / "stale.txt").exists()
    assert sorted(path.name for path in (raw / "otb" / "still-box").glob("*.txt")) == sorted(
        f"{name}.txt" for name in FRAMES
    )
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "thesis.tex").write_text("years of work")
    capsys.readouterr()
    assert main([*command, "--raw", str(mine), "--fresh"]) == 2
    assert "expected a new or empty folder" in capsys.readouterr().err
    assert (mine / "thesis.tex").read_text() == "years of work"


@pytest.mark.parametrize(
    ("names", "files"),
    [
        ({"color/David": "David", "rgbd/mug": "mug"}, ["David", "mug"]),
        ({"a/one": "one", "b/one": "one", "two": "two"}, ["a-one", "b-one", "two"]),
        ({"x/kitti/Car 0": "kitti/Car 0", "mine:Tracker": "mine:Tracker"}, ["kitti-Car_0", "mine_Tracker"]),
        ({"a b": "a b", "a:b": "a:b", "a_b": "a_b"}, ["a_b", "a_b-2", "a_b-3"]),
        ({"..": "..", "../../x": "../../x"}, ["_", "x"]),
    ],
)
def test_files_have_short_names_of_their_own(names, files):
    """Names that end alike are told apart, and none leaves the folder."""
    assert list(raw_results.file_names(names).values()) == files


def test_what_the_evaluation_did_not_run_is_left_out(finished, tmp_path):
    """As of results that others ran: there is no run of them in its folder."""
    done, place, _ = finished
    (tmp_path / "runs" / "one-pass").mkdir(parents=True)
    shutil.copytree(place / "runs/one-pass/still-box", tmp_path / "runs/one-pass/still-box")
    raw = raw_results.write_raw(done, tmp_path, tmp_path / "raw", tables.settings(done)).parent
    assert [path.name for path in (raw / "got10k").iterdir()] == ["still-box"]
    assert list(json.loads((raw / "manifest.json").read_text())["trackers"]) == ["still-box"]


def test_a_sequence_of_otb_ends_with_its_true_boxes(tmp_path):
    """Football1 has 81 images and 74 true boxes: the GOT-10k toolkit takes OTB's form only with 74 lines. The
    other forms have all frames.
    """
    images = tmp_path / "OTB" / "Football1" / "img"
    images.mkdir(parents=True)
    for index in range(1, 82):
        cv2.imwrite(str(images / f"{index:04d}.jpg"), np.full((24, 32, 3), index, np.uint8))
    (images.parent / "groundtruth_rect.txt").write_text("9,9,8,8\n" * 74)
    place = tmp_path / "evaluation"
    options = evaluation.Options(trackers=("still-box",), restarts=False)
    done = evaluation.evaluate(tmp_path / "OTB", place, options)
    raw = raw_results.write_raw(done, place, tmp_path / "raw", tables.settings(done)).parent
    boxes = read(raw / "otb" / "still-box" / "Football1.txt")
    assert len(boxes) == len(read(raw / "otb" / "still-box" / "times" / "Football1_time.txt")) == 74
    assert len(read(raw / "got10k" / "still-box" / "Football1" / "Football1_001.txt")) == 81
    toolkit = pytest.importorskip("got10k.datasets", reason="the toolkit that reads it: tricue[got10k]")
    _, truth = toolkit.OTB(str(tmp_path / "OTB"), version=2015, download=False)["Football1"]
    np.testing.assert_array_equal(boxes, truth)
