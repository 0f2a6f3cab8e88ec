# SPDX-License-Identifier: MIT
"""What ``tricue evaluate`` says of what is wrong, and its exit codes."""

import sys
from pathlib import Path

import cv2
import pytest
from tricue.cli import main
from tricue.doctor.install import install_extra

from tests.cli.conftest import write_sequence


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--set", "particles=3"], "--set: expected tracker.name=value, got 'particles=3'"),
        (["--set", "color-particle.particels=3"], "particels"),
        (["--set", "fused.seed=3"], "--set seed: expected a parameter, got what --seeds N sets"),
        (["--set", "mine.py:Mine.seed=3"], "--set seed: expected a parameter, got what --seeds N sets"),
        (["--set", "flow-depth.rig=3"], "got what the sequence's calibration sets"),
        (
            ["--trackers", "still-box", "--set", "fused.max_speed=3"],
            "--set: expected a parameter of a tracker that runs (still-box), got one of 'fused'",
        ),
        (["--trackers", "CRST"], "got 'CRST'"),
        (["--trackers", "nobody.py:Nobody"], "nobody.py: there is no such file"),
        (
            ["--trackers", "fractions:Fraction"],
            "fractions:Fraction: TypeError: Fraction: expected a class with",
        ),
        (["--results", "theirs"], "--results: expected NAME=FOLDER, got 'theirs'"),
        (["--time-limit", "-3"], "expected seconds above 0, got '-3'"),
        (["--jobs", "0"], "expected a whole number above 0, got '0'"),
        (["--jobs", "2", "--scheduler", "tcp://127.0.0.1:9"], "not allowed with"),
        (["--depth-scale", "-1"], "evaluate: --depth-scale: expected meters"),
        (["--protocols", "one-pass,thirds"], "--protocols: expected some of one-pass, restarts, starts"),
        (["--figures", "pdf,eps"], "--figures: expected some of pdf, svg, png, got 'eps'"),
    ],
)
def test_wrong_options_are_told_in_one_line(dataset, tmp_path, capsys, arguments, message):
    """Exit code 2, one line that names what is wrong."""
    try:
        code = main(["evaluate", str(dataset), "--output", str(tmp_path), *arguments])
    except SystemExit as error:
        code = error.code
    assert code == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert message in lines[0]


def test_results_are_not_written_among_the_sequences(dataset, capsys):
    """By any name of their folder."""
    there = sorted(dataset.iterdir())
    assert main(["evaluate", str(dataset), "--output", f"{dataset}/../{dataset.name}"]) == 2
    assert "--output: expected another folder than that of the sequences" in capsys.readouterr().err
    assert sorted(dataset.iterdir()) == there


def test_a_sequence_that_cannot_be_read_is_told_and_the_exit_code_is_1(tmp_path, capsys):
    """The others have their table."""
    write_sequence(tmp_path / "data" / "good", 5)
    write_sequence(tmp_path / "data" / "bad", 5)
    (tmp_path / "data" / "bad" / "groundtruth_rect.txt").write_text("1,2\n")
    arguments = ["evaluate", str(tmp_path / "data"), "--trackers", "still-box"]
    assert main([*arguments, "--output", str(tmp_path / "out")]) == 1
    captured = capsys.readouterr()
    assert "bad/groundtruth_rect.txt, line 1" in captured.err
    assert "| still-box " in captured.out


@pytest.mark.parametrize(
    ("missing", "options"),
    [
        ("matplotlib.figure", []),
        ("joblib.externals.loky", ["--jobs", "2"]),
        ("distributed", ["--scheduler", "x"]),
    ],
)
def test_a_missing_extra_is_told_before_anything_runs(
    dataset, tmp_path, capsys, monkeypatch, missing, options
):
    """One line that names the extra, exit code 2, no run."""
    monkeypatch.setitem(sys.modules, missing, None)
    assert main(["evaluate", str(dataset), "--output", str(tmp_path / "out"), *options]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert install_extra("dask" if missing == "distributed" else "evaluate") in error
    assert not list(tmp_path.rglob("*.json"))


def test_a_table_that_cannot_be_written_is_told_before_anything_runs(dataset, tmp_path, capsys):
    """Not after hours of runs."""
    words = ["evaluate", str(dataset), "--output", str(tmp_path / "out"), "--latex", str(tmp_path)]
    assert main(words) == 2
    assert capsys.readouterr().err == f"tricue evaluate: {tmp_path}: Is a directory\n"
    assert not list(tmp_path.rglob("*.json"))


def test_what_does_not_run_is_told_below_the_table(dataset, tmp_path, capsys):
    """A baseline that was asked for and isn't there, with the package; results that aren't there."""
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "one.txt").write_text("1,2,3,4\n" * 40)
    arguments = ["evaluate", str(dataset), "--trackers", "still-box,CSRT", "--no-restarts"]
    arguments += ["--results", f"theirs={tmp_path / 'results'}", "--output", str(tmp_path / "out")]
    assert main(arguments) == 0
    printed = capsys.readouterr().out.splitlines()
    assert [line for line in printed if line.startswith("| theirs ")]
    missing = f"not run: theirs on four, three, two: no result in {tmp_path / 'results'}"
    assert missing in printed
    assert "theirs: results in otb form, 1 of 4 sequences, pixels counted from 1" in printed
    if not hasattr(cv2, "TrackerCSRT"):
        (told,) = [line for line in printed if line.startswith("not run: CSRT")]
        assert "opencv-contrib-python-headless" in told
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "theirs: results in otb form" in page
    assert f"theirs={tmp_path / 'results'}" in page


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.parametrize(
    "name", ["rows.csv", "evaluation.json", "report.html", "table.tex", "figures/color-success.png"]
)
def test_a_full_disk_is_told_with_the_file(dataset, tmp_path, capsys, name):
    """The runs are there, and the command that is repeated with more room writes the rest."""
    place = tmp_path / "evaluation"
    place.mkdir()
    (place / name).parent.mkdir(exist_ok=True)
    (place / name).symlink_to("/dev/full")
    words = ["evaluate", str(dataset / "one"), "--trackers", "still-box", "--no-restarts"]
    words += ["--latex", str(place / "table.tex"), "--figures", "png", "--output", str(place)]
    assert main(words) == 2
    assert capsys.readouterr().err.endswith(f"tricue evaluate: {place / name}: No space left on device\n")


def test_an_error_names_the_run_that_it_ended(dataset, own, capfd):
    """Runs of several protocols on one sequence have lines that differ."""
    (own / "own_tracker.py").write_text(
        "class Mine:\n"
        "    def init(self, frame, box): self.left = 5\n"
        "    def update(self, frame):\n"
        "        self.left -= 1\n"
        "        return 1 / self.left and (1, 1, 5, 5)\n"
    )
    words = ["evaluate", str(dataset / "one"), "--trackers", "own_tracker.py:Mine"]
    assert main([*words, "--protocols", "one-pass,backward"]) == 0
    lines = capfd.readouterr().out.splitlines()
    assert [line.partition(", ")[2] for line in lines if line.startswith("own_tracker.py:Mine on")] == [
        "one-pass, seed 0: frame 5: ZeroDivisionError: division by zero",
        "backward, seed 0: frame 34: ZeroDivisionError: division by zero",
    ]


def test_a_tracker_that_starts_nowhere_is_told_once_and_the_exit_code_is_1(dataset, own, capfd):
    """One line for all sequences, with the error's type, if it was asked for; the others have their rows."""
    (own / "own_tracker.py").write_text(
        "class Mine:\n"
        "    def __init__(self): raise RuntimeError('no gpu')\n"
        "    def init(self, frame, box): pass\n"
        "    def update(self, frame): pass\n"
    )
    words = ["evaluate", str(dataset), "--trackers", "still-box,own_tracker.py:Mine", "--no-restarts"]
    assert main(words) == 1
    captured = capfd.readouterr()
    assert (
        "failed: own_tracker.py:Mine on 4 of 4 sequences: RuntimeError: no gpu" in captured.err.splitlines()
    )
    assert (captured.out + captured.err).count("no gpu") == 1
    assert "| still-box " in captured.out


def test_results_that_fit_nothing_make_the_exit_code_1(dataset, tmp_path, capsys):
    """The folder is named, and the line that tells how it was read ends without a comma."""
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "other.txt").write_text("1,2,3,4\n" * 40)
    arguments = ["evaluate", str(dataset), "--trackers", "still-box", "--no-restarts"]
    arguments += ["--results", f"theirs={tmp_path / 'results'}", "--output", str(tmp_path / "out")]
    assert main(arguments) == 1
    captured = capsys.readouterr()
    assert "theirs: results in otb form, 0 of 4 sequences" in captured.out.splitlines()
    assert "failed: theirs: no result that fits any of 4 sequences" in captured.err.splitlines()


def test_sequences_that_have_too_few_frames(tmp_path, capsys):
    """One frame: named once, with its folder. Fewer than true boxes: told below the table."""
    write_sequence(tmp_path / "data" / "good", 5)
    write_sequence(tmp_path / "data" / "single", 1)
    write_sequence(tmp_path / "data" / "short", 5)
    (tmp_path / "data" / "short" / "img" / "00005.jpg").unlink()
    arguments = ["evaluate", str(tmp_path / "data"), "--trackers", "still-box,meanShift"]
    assert main([*arguments, "--output", str(tmp_path / "out")]) == 1
    captured = capsys.readouterr()
    failed = [line for line in captured.err.splitlines() if line.startswith("failed")]
    place = tmp_path / "data" / "single"
    assert failed == [f"failed: single: {place}: expected a frame after the first true box, got 1 frame"]
    assert "short: 1 row of true boxes more than there are frames" in captured.out.splitlines()
