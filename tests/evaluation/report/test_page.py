# SPDX-License-Identifier: MIT
import dataclasses
import re
import shutil
import sys

import cv2
import numpy as np
import pytest
from tricue.cli import program
from tricue.cli.evaluate import chosen_protocols, settings_by_tracker
from tricue.doctor.install import install_extra
from tricue.evaluation import tables
from tricue.evaluation.dataset import ReadOptions
from tricue.evaluation.evaluate import Options, evaluate
from tricue.evaluation.report import page, sequences
from tricue.evaluation.report.page import write_report
from tricue.evaluation.report.setup import command

MAX_BYTES = 5_000_000  # of a report of twenty sequences


def test_the_same_evaluation_gives_the_same_bytes(evaluation, about, report, tmp_path):
    """Nothing of time, memory addresses, hash seeds or the folder is in the file."""
    assert write_report(evaluation, tmp_path, about).read_bytes() == report.read_bytes()


def test_it_needs_nothing_else(report):
    """There is no address in it, no style sheet, no script but its own; links lead to the files beside it."""
    text = report.read_text(encoding="utf-8")
    assert "://" not in text
    assert not re.search(r"<link|<script[^>]|@import|url\((?!#)", text)
    links = set(re.findall(r'href="([^#"]+)"', text))
    files = {tables.ROWS, tables.SUMMARY, tables.INTERVALS, tables.SIGNIFICANCE, tables.SPEEDS, tables.JSON}
    assert links == files
    assert all((report.parent / name).is_file() for name in links)


def test_ids_are_unique(report):
    """Plots of several groups in one page don't share names by which one would take another's parts."""
    ids = re.findall(r' id="([^"]*)"', report.read_text(encoding="utf-8"))
    assert len(ids) == len(set(ids))


def test_twenty_sequences_stay_small(tmp_path):
    """With textured frames of 320x240, twenty sequences and their pictures are under 5 MB."""
    rng = np.random.default_rng(0)
    for number in range(20):
        write_textured(tmp_path / "data" / f"street-{number:02d}", rng)
    options = Options(("color-particle", "meanShift", "still-box"), restarts=False)
    evaluation = evaluate(tmp_path / "data", tmp_path, options)
    text = write_report(evaluation, tmp_path, tables.settings(evaluation)).read_text(encoding="utf-8")
    assert text.count('class="still"') == 20 * (1 + 4)
    assert len(text.encode()) < MAX_BYTES


def write_textured(folder, rng, size=(320, 240), frames=24):
    """A patch with detail at all scales that wanders over such a ground."""
    (folder / "img").mkdir(parents=True)
    ground, patch = texture(rng, size), texture(rng, (48, 64))
    boxes = []
    for index in range(frames):
        x, y = 20 + 8 * index, 30 + 4 * index
        image = np.clip(ground + rng.normal(0, 4, ground.shape), 0, 255).astype(np.uint8)
        image[y : y + 64, x : x + 48] = patch
        cv2.imwrite(str(folder / "img" / f"{index + 1:04d}.jpg"), image)
        boxes.append(f"{x + 1},{y + 1},48,64\n")
    (folder / "groundtruth_rect.txt").write_text("".join(boxes))


def texture(rng, size):
    """Noise at four scales, (H, W, 3) float."""
    coarse = (rng.integers(0, 64, (max(2, size[1] // s), max(2, size[0] // s), 3)) for s in (60, 15, 4, 1))
    return sum(cv2.resize(each.astype(np.float32), size, interpolation=cv2.INTER_LINEAR) for each in coarse)


def test_only_the_worst_have_pictures_where_there_are_many(evaluation, about, tmp_path, monkeypatch):
    """Beyond a number of sequences only the worst have pictures, and the page notes that."""
    for module in (page, sequences):
        monkeypatch.setattr(module, "MAX_PICTURED", 2)
    text = write_report(evaluation, tmp_path, about).read_text(encoding="utf-8")
    assert text.count('class="film"') == 2
    assert f"Of all {len(evaluation.opened)} sequences the 2 worst have pictures" in text
    worst = sequences.worst_first(evaluation)
    assert [each.auc for each in worst] == sorted(each.auc for each in worst)
    assert len(worst) == len(evaluation.opened)


def test_missing_frames_cost_only_their_pictures(folders, tmp_path):
    """A report can be made where the images can't be read any more."""
    shutil.copytree(folders / "there", tmp_path / "data" / "there")
    evaluation = evaluate(tmp_path / "data", tmp_path, Options(("still-box",), restarts=False))
    shutil.rmtree(tmp_path / "data" / "there" / "img")
    text = write_report(evaluation, tmp_path, {}).read_text(encoding="utf-8")
    assert "The images of this sequence can&#x27;t be read: " in text
    assert 'class="film"' not in text


def test_the_best_on_a_sequence_is_in_its_pictures(folders, tmp_path):
    """Also where two others are better on average."""
    for name, sequence, box in (("A", "there", "1,1,300,300"), *((name, "back", "") for name in "BC")):
        truth = (folders / sequence / "groundtruth_rect.txt").read_text().splitlines()
        (tmp_path / name).mkdir()
        lines = [truth[0], *(box or line for line in truth[1:])]
        (tmp_path / name / f"{sequence}.txt").write_text("\n".join(lines) + "\n")
    others = tuple(f"{name}={tmp_path / name}" for name in "ABC")
    evaluation = evaluate(folders, tmp_path, Options((), restarts=False, results=others))
    text = write_report(evaluation, tmp_path, {}).read_text(encoding="utf-8")
    assert "worst frames of A on there" in text


def test_what_did_not_run_is_listed(evaluation, report):
    """Sequences that couldn't be read, and trackers that couldn't run, with the reasons."""
    text = report.read_text(encoding="utf-8")
    (error,) = evaluation.failed.values()
    assert "What didn&#x27;t run" in text
    assert "broken" in error
    assert page.tag("b", "broken") in text
    assert "no depth, 4 sequences" in text
    assert "no color, 1 sequence" in text


def test_parameters_and_versions_are_listed(about, report):
    """Each parameter of our trackers, the changed one beside its default, the versions and the machine."""
    text = report.read_text(encoding="utf-8")
    for tracker, values in about["parameters"].items():
        assert page.tag("b", tracker) in text
        assert all(page.tag("th", name, scope="row") in text for name in values if name != "tricue")
    assert "<strong>60</strong><small> default 100</small>" in text
    assert text.count('class="changed"') == 1
    for name in ("tricue", "opencv", "numpy", "python", "machine"):
        assert page.tag("dd", about[name]) in text


@pytest.mark.parametrize(
    "options",
    [
        Options(),
        Options(("color-particle", "still-box"), seeds=5, restarts=False),
        Options(settings={"flow-depth": {"cues": ("flow",)}, "color-particle": {"particles": 7}}),
        Options(reading=ReadOptions(depth_scale=0.001, fps=15.0, unit=0.03, truth="depth")),
        Options(("fused", "few=color-particle"), {"few": {"particles": 30, "grid": (8, 6)}}),
        Options(protocols=("starts", "every-3")),
        Options(restarts=False, protocols=("noisy-5",)),
    ],
)
def test_the_command_runs_the_same(options):
    """The command's own parser turns it back into the same options."""
    import shlex

    words = shlex.split(command(options, "a data set/"))
    assert words[:3] == ["tricue", "evaluate", "a data set/"]
    found = program.parser(words[1]).parse_args(words[1:])
    reading = ReadOptions(found.depth_scale, found.fps, found.unit, found.truth)
    trackers = tuple(found.trackers) if found.trackers else None
    settings = settings_by_tracker(found.set, found.trackers or ())
    restarts, protocols = chosen_protocols(found)
    assert options == Options(trackers, settings, found.seeds, restarts, reading, protocols=protocols)


def test_matplotlib_is_asked_for(evaluation, about, tmp_path, monkeypatch):
    """Without it the error names the extra, and no half of a page is written."""
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(ImportError, match=re.escape(install_extra("evaluate"))):
        write_report(evaluation, tmp_path, about)
    assert not list(tmp_path.iterdir())


def test_an_evaluation_without_results_is_a_page(evaluation, about, tmp_path):
    """Where no run finished the page says so."""
    empty = dataclasses.replace(evaluation, results=(), failed={"all": "of them"})
    text = write_report(empty, tmp_path, about).read_text(encoding="utf-8")
    assert "No run on these sequences finished" in text
    assert "of them" in text
