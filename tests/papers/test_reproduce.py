# SPDX-License-Identifier: MIT
import csv
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.doctor.install import install_extra
from tricue.evaluation import baselines, metrics
from tricue.papers import reproduce
from tricue.papers.sabeti_color import curves
from tricue.scenes import light_change

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")
pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install tricue[demo]")

FRAMES = 8  # of scenes whose pictures don't matter
STILL = {"still": lambda seed, **_: baselines.StillBox()}  # where there is a camera, it doesn't need it


def rows(report):
    """The lines of a report's CSV."""
    with report.table.open() as file:
        return list(csv.DictReader(file))


def shorten(name, frames, monkeypatch):
    """Give an experiment's scenes so few frames, of the smaller camera where there are two."""
    experiment = reproduce.EXPERIMENTS[name]
    cameras = {"moreno-fig3": "160x120", "okada-fig8": "160x120", "sabeti-depth": "tof"}
    small = {"camera": cameras[name]} if name in cameras else {}
    scenes = {scene: partial(make, frames=frames, **small) for scene, make in experiment.scenes.items()}
    monkeypatch.setitem(reproduce.EXPERIMENTS, name, replace(experiment, scenes=scenes))


def test_table_holds_the_errors_of_the_run(tmp_path):
    """The CSV of a box that never moves holds how far the truth of each seed has gone from it."""
    report = reproduce.run("sabeti-fig2", seeds=2, output=tmp_path, models=STILL)
    for seed in (0, 1):
        truth = np.array(light_change(seed).boxes)
        still = np.tile(truth[0], (90, 1))
        written = [row for row in rows(report) if row["seed"] == str(seed)]
        assert [int(row["frame"]) for row in written] == list(range(90))
        errors = [float(row["error_px"]) for row in written]
        np.testing.assert_allclose(errors, metrics.center_errors(still, truth), atol=6e-4)
        np.testing.assert_allclose(
            [float(row["iou"]) for row in written], metrics.overlaps(still, truth), atol=6e-5
        )


TABLES_IN_ANOTHER_LOCALE = """
from pathlib import Path
import numpy as np
from tricue.papers import tables
from tricue.papers.curves import Curve
from tricue.papers.moreno import noise
values = np.zeros(len(noise.QUANTITIES))
run = noise.NoiseRun("m", "1 m", 0, 1.0, noise.STEADY_LIGHT, np.ones(3), values, np.ones((3, 4)))
noise.write_csv(Path("noise.csv"), [run])
curve = Curve("m", "1\\N{DEGREE SIGN}", 0, np.ones(1))
tables.write_csv(Path("frames.csv"), ("model",), [curve], lambda _: [[1]])
"""


def test_tables_are_written_whatever_the_locale(tmp_path):
    """As UTF-8, as their quantities and scenes have letters that other encodings lack."""
    plain = {**os.environ, "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}
    subprocess.run([sys.executable, "-c", TABLES_IN_ANOTHER_LOCALE], env=plain, cwd=tmp_path, check=True)
    assert "e(μ1)" in (tmp_path / "noise.csv").read_text(encoding="utf-8")
    assert "1°" in (tmp_path / "frames.csv").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", reproduce.EXPERIMENTS)
def test_figure_is_drawn_and_progress_reported(name, tmp_path, monkeypatch):
    """Each experiment writes a figure with content, runs every scene, and counts them up to the last."""
    if name != "sabeti-fig2":  # whose figure shows late frames
        shorten(name, {"sabeti-depth": 60, "moreno-fig2": 12}.get(name, FRAMES), monkeypatch)
    experiment = reproduce.EXPERIMENTS[name]
    shared = {scene: cache(make) for scene, make in experiment.scenes.items()}  # by curves and figure
    monkeypatch.setitem(reproduce.EXPERIMENTS, name, replace(experiment, scenes=shared))
    calls = []
    models = None if name == "moreno-fig2" else STILL  # whose measurements are a tracker's own
    report = reproduce.run(name, 1, tmp_path, progress=lambda *done: calls.append(done), models=models)
    scenes = reproduce.EXPERIMENTS[name].scenes
    assert calls == [(done, len(scenes)) for done in range(1, len(scenes) + 1)]
    assert {row["scene"] for row in rows(report)} == set(scenes)
    image = cv2.imread(str(report.figure))
    assert image.shape[1] > 1000
    assert image.std() > 20


def test_jobs_change_nothing(tmp_path, monkeypatch):
    """Two processes write the same table as one, for a tracker that draws random numbers."""
    shorten("sabeti-fig2", 30, monkeypatch)
    models = {"script": baselines.ScriptedParticleFilter}
    one, two = (reproduce.run("sabeti-fig2", 2, tmp_path / str(jobs), jobs, models=models) for jobs in (1, 2))
    assert one.table.read_text() == two.table.read_text()
    assert one.summary == two.summary


@pytest.mark.skipif(sys.platform != "linux", reason="children are counted in /proc")
@pytest.mark.parametrize("after", [0.0, 0.3, 1.5])
def test_ctrl_c_ends_all_processes_without_a_word(after, tmp_path):
    """Also where they still import what they need, some seconds after they were started."""
    hearing = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
    command = hearing + "from tricue.cli import main; sys.exit(main())"
    options = ["reproduce", "sabeti-fig2", "--jobs", "2", "--output", str(tmp_path)]
    child = subprocess.Popen(
        [sys.executable, "-c", command, *options], stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    started, deadline = Path(f"/proc/{child.pid}/task/{child.pid}/children"), time.monotonic() + 60
    while len(started.read_text().split()) < 2 and time.monotonic() < deadline:
        time.sleep(0.01)
    time.sleep(after)
    os.killpg(child.pid, signal.SIGINT)
    _, error = child.communicate(timeout=60)
    assert child.returncode == 130
    assert error.splitlines()[-1] == "tricue reproduce: interrupted"
    assert "Traceback" not in error


def test_summary_counts_frames():
    """Mean, spread over runs, and both shares are those of hand-made curves."""

    def curve(errors, overlaps):
        arrays = (np.array(overlaps), np.ones(4), np.array(errors), np.zeros((4, 4)), np.zeros(4))
        return curves.ColorCurve("m", "s", 0, *arrays)

    made = [curve([0.0, 0, 2, 2], [1.0, 1, 0.6, 0.4]), curve([25.0, 26, 0, 1], [0.5, 0, 0.7, 0.7])]
    *_, line = curves.summarize(made).splitlines()
    assert line == "| m | 7.0 ± 6.0 | 12.5% | 62.5% | 2 |"


@pytest.mark.slow
def test_face_is_held_over_clutter(tmp_path, monkeypatch):
    """On two backgrounds the defaults stay within 3 px, and no color model but spatial ranks does."""
    experiment = reproduce.EXPERIMENTS["sabeti-fig1"]
    scenes = {name: experiment.scenes[name] for name in ("cat", "motorcycle")}
    monkeypatch.setitem(reproduce.EXPERIMENTS, "sabeti-fig1", replace(experiment, scenes=scenes))
    errors = {model: [] for model in experiment.models}
    for row in rows(reproduce.run("sabeti-fig1", 2, tmp_path)):
        errors[row["model"]].append(float(row["error_px"]))
    default, _, *others = (np.mean(each) for each in errors.values())
    assert default < 3
    assert all(other > 3 for other in others)


@pytest.mark.slow
def test_face_is_held_when_the_light_changes(tmp_path):
    """The defaults and spatial ranks keep IoU above 0.5 on 95 % of the frames, the histogram less."""
    overlaps = {model: [] for model in reproduce.EXPERIMENTS["sabeti-fig2"].models}
    for row in rows(reproduce.run("sabeti-fig2", 3, tmp_path)):
        overlaps[row["model"]].append(float(row["iou"]))
    held = {model: np.mean(np.array(each) > 0.5) for model, each in overlaps.items()}
    assert held["spatial ranks, color (default)"] >= 0.95
    assert held["spatial ranks"] >= 0.95
    assert held["16-bin histogram"] < 0.8


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"name": "sabeti-fig9"}, "experiment: expected one of sabeti-fig1, .* got 'sabeti-fig9'"),
        ({"name": "sabeti-fig1", "seeds": 0}, "expected 1 or more, got 0"),
        ({"name": "sabeti-fig1", "jobs": 0}, "expected 1 or more, got 20, 0"),
        ({"name": "sabeti-fig1", "data": Path("mine")}, "data: expected none, as only sabeti-roc .*mine"),
        ({"name": "okada-fig8", "rate": 0.1}, "rate: expected none, as only sabeti-roc takes it, got 0.1"),
    ],
)
def test_bad_arguments_are_named(arguments, words, tmp_path):
    """An unknown experiment or a number below 1 is refused before anything runs."""
    with pytest.raises(ValueError, match=words):
        reproduce.run(**arguments, output=tmp_path / "new")
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("name", [".", "sabeti-fig2.csv/x"])
def test_an_output_that_can_not_be_written_is_told_first(name, tmp_path):
    """A file in the place of the folder, and a folder in that of the table, come before the work."""
    (tmp_path / "out" / name).mkdir(parents=True)
    output = tmp_path / "out"
    if name == ".":
        output = tmp_path / "file"
        output.touch()
    calls = []
    with pytest.raises(OSError, match=r"sabeti-fig2\.(png|csv)"):
        reproduce.run("sabeti-fig2", 1, output, progress=lambda *n: calls.append(n), models=STILL)
    assert not calls


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.parametrize("name", ["sabeti-fig2.csv", "sabeti-fig2.png"])
def test_a_full_disk_is_told_with_the_file(name, tmp_path):
    """After hours of curves it is known which file is missing."""
    (tmp_path / name).symlink_to("/dev/full")
    with pytest.raises(OSError, match=f"No space left on device: '{tmp_path / name}'"):
        reproduce.run("sabeti-fig2", seeds=1, output=tmp_path, models=STILL)


def test_missing_matplotlib_names_the_extra(monkeypatch, tmp_path):
    """Without matplotlib the error comes before the work and says how to install it."""
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(ImportError, match=re.escape(install_extra("demo"))):
        reproduce.run("sabeti-fig2", 1, tmp_path, models=STILL)
