# SPDX-License-Identifier: MIT
"""``tricue evaluate`` as a user runs it."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.cli import main
from tricue.cli.arguments import any_tracker_names
from tricue.doctor.install import install_extra
from tricue.evaluation import tables
from tricue.track.base import registry

# Python doesn't hear Ctrl-C where its parent ignores it, as what a shell runs in the background does.
HEARING = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
COMMAND = (sys.executable, "-c", HEARING + "from tricue.cli import main; sys.exit(main())", "evaluate")


def write_sequence(folder: Path, frames: int, seed: int = 0, size: tuple[int, int] = (80, 60)) -> None:
    """OTB's layout: a bright textured square that goes round in a circle over noise."""
    rng = np.random.default_rng(seed)
    ground = rng.integers(20, 60, (size[1], size[0], 3), dtype=np.uint8)
    square = cv2.resize(rng.integers(90, 255, (4, 4, 3), dtype=np.uint8), (20, 20)) // [4, 4, 1]
    (folder / "img").mkdir(parents=True)
    lines = []
    for index in range(frames):
        x, y = 30 + round(20 * np.cos(index / 12)), 20 + round(15 * np.sin(index / 12))
        image = ground.copy()
        image[y : y + 20, x : x + 20] = square
        cv2.imwrite(str(folder / "img" / f"{index + 1:05d}.jpg"), image)
        lines.append(f"{x + 1},{y + 1},20,20\n")
    (folder / "groundtruth_rect.txt").write_text("".join(lines))


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    """Four sequences of 40 frames."""
    root = tmp_path_factory.mktemp("data")
    for seed, name in enumerate(("one", "two", "three", "four")):
        write_sequence(root / name, 40, seed)
    return root


def rows(folder: Path) -> list[bytes]:
    """The bytes of the tables that tell what the runs say."""
    return [(folder / name).read_bytes() for name in (tables.ROWS, tables.SUMMARY)]


def test_tables_and_report_are_written_and_the_table_is_printed(dataset, tmp_path, capsys):
    """The printed numbers are those of the CSV and the JSON file; a second run runs nothing anew."""
    arguments = [
        "evaluate",
        str(dataset),
        "--trackers",
        "color-particle,still-box",
        "--output",
        str(tmp_path),
    ]
    assert main([*arguments, "--seeds", "2"]) == 0
    printed = capsys.readouterr().out
    with (tmp_path / tables.SUMMARY).open() as file:
        lines = {line["tracker"]: line for line in csv.DictReader(file)}
    for name, line in lines.items():
        shown = next(text for text in printed.splitlines() if text.startswith(f"| {name} "))
        assert shown.split("|")[3].strip() == f"{float(line['auc']):.2f}"
    values = json.loads((tmp_path / tables.JSON).read_text())
    assert values["summary"][0]["auc"] == float(lines["color-particle"]["auc"])
    assert values["parameters"]["color-particle"]["particles"] == 100
    assert {"tricue", "opencv", "numpy", "machine", "seeds", "dataset"} <= set(values)
    assert len(values["rows"]) == 4 * (2 + 1)
    assert str(tmp_path / "report.html") in printed
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").rglob("*.json")}
    assert main([*arguments, "--seeds", "2"]) == 0
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").rglob("*.json")} == before


@pytest.fixture(scope="module")
def undisturbed(dataset, tmp_path_factory):
    """The options of an evaluation of 48 runs, and the bytes of its tables."""
    options = [str(dataset), "--trackers", "color-particle,script-pf", "--seeds", "6", "--no-restarts"]
    output = tmp_path_factory.mktemp("undisturbed")
    assert main(["evaluate", *options, "--output", str(output)]) == 0
    return options, rows(output)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_and_the_same_command_again_give_the_same_tables(undisturbed, tmp_path, jobs):
    """Interrupted after some runs: exit code 130, no traceback; then as if nothing had happened."""
    options, whole = undisturbed
    for attempt in range(5):
        parts = tmp_path / f"parts{attempt}"
        command = [*COMMAND, *options, "--jobs", jobs, "--output", str(parts)]
        code, error = interrupted(command, parts)
        if code != 0:  # else a busy machine let it finish before this process could see the fifth file
            break
    assert code == 130
    assert 5 <= len(list(parts.rglob("*.json"))) < 48
    assert "the same command goes on" in error
    assert "Traceback" not in error
    assert subprocess.run(command, check=False, capture_output=True).returncode == 0
    assert rows(parts) == whole


def interrupted(command: list[str], output: Path) -> tuple[int, str]:
    """The exit code and the standard error of a command that gets Ctrl-C when it has written five runs."""
    child = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True)
    deadline = time.monotonic() + 120
    while len(list(output.rglob("*.json"))) < 5 and time.monotonic() < deadline and child.poll() is None:
        time.sleep(0.01)
    if child.poll() is None:
        os.killpg(child.pid, signal.SIGINT)  # as a terminal does
    _, error = child.communicate(timeout=120)
    return child.returncode, error


def test_memory_does_not_grow_with_the_length(tmp_path):
    """The peak over 2,000 frames is at most 10 MB above that over 100; the frames alone would be 27 MB."""
    peaks = []
    for frames in (100, 2000):
        write_sequence(tmp_path / str(frames), frames)
        code = (
            "import resource, sys; from tricue.cli import main; main(sys.argv[1:]);"
            "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
        )
        arguments = ["evaluate", str(tmp_path / str(frames)), "--trackers", "color-particle,still-box"]
        arguments += ["--seeds", "1", "--output", str(tmp_path / f"out{frames}")]
        printed = subprocess.run(
            [sys.executable, "-c", code, *arguments], check=True, capture_output=True, text=True
        ).stdout
        peaks.append(int(printed.split()[-1]) / 1024)
    assert peaks[1] - peaks[0] < 10


def test_protocols_attributes_and_files_for_papers(dataset, tmp_path, capsys):
    """One command gives all of them; the same again measures and runs nothing anew."""
    arguments = ["evaluate", str(dataset), "--trackers", "still-box,meanShift", "--output", str(tmp_path)]
    arguments += ["--protocols", "one-pass,backward,every-3", "--attributes"]
    arguments += ["--figures", "svg", "--latex", str(tmp_path / "table.tex")]
    assert main(arguments) == 0
    printed = capsys.readouterr().out
    assert "| one-pass | backward | every-3 |" in " ".join(printed.split())
    assert "this group has 4 recordings" in printed
    with (tmp_path / tables.ATTRIBUTES).open() as file:
        lines = {(line["sequence"], line["attribute"]): line for line in csv.DictReader(file)}
    assert lines["one", "low_resolution"]["has"] == "0"  # 20x20 pixels
    assert (tmp_path / "figures" / "color-success.svg").is_file()
    assert r"\toprule" in (tmp_path / "table.tex").read_text()
    assert tables.ATTRIBUTES in (tmp_path / "report.html").read_text()
    folders = (tmp_path / "runs", tmp_path / "attributes")
    before = {path: path.stat().st_mtime_ns for each in folders for path in each.rglob("*.json")}
    assert len(before) == 4 * 2 * 3 + 4
    assert main(arguments) == 0
    assert {path: path.stat().st_mtime_ns for each in folders for path in each.rglob("*.json")} == before


def test_parameters_of_trackers_are_set_by_name(dataset, tmp_path):
    """--set reaches the tracker that it names; a wrong form is told."""
    arguments = ["evaluate", str(dataset / "one"), "--trackers", "color-particle", "--output", str(tmp_path)]
    assert main([*arguments, "--seeds", "1", "--set", "color-particle.particles=40"]) == 0
    values = json.loads((tmp_path / tables.JSON).read_text())
    assert values["parameters"]["color-particle"]["particles"] == 40
    assert values["changed"] == {"color-particle": {"particles": 40}}


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


def test_progress_of_a_search(tmp_path, capsys, monkeypatch):
    """The search of a large folder for sequences isn't silent."""
    monkeypatch.setattr("tricue.cli.progress._PLAIN_EVERY", 0.0)
    (tmp_path / "data" / "a").mkdir(parents=True)
    assert main(["evaluate", str(tmp_path / "data"), "--output", str(tmp_path / "out")]) == 2
    searched = "".join(f"{count}  folders searched for sequences\n" for count in (1, 2))
    assert capsys.readouterr().err.startswith(f"{searched}tricue evaluate: ")


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


OWN = """
import os, time
from pathlib import Path
print("imported")

class Mine:
    def init(self, frame, box): self.box = box
    def update(self, frame):
        print("| a | line | like | the table's |")
        return self.box

class Stays(Mine):
    def update(self, frame):
        Path("processes", str(os.getpid())).touch()
        time.sleep(1000)
"""


@pytest.fixture
def own(tmp_path, monkeypatch):
    """A working folder with trackers of one's own in it."""
    (tmp_path / "own_tracker.py").write_text(OWN)
    (tmp_path / "processes").mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [path for path in sys.path if path])
    return tmp_path


def test_trackers_of_the_working_folder_are_evaluated(folders, own, capfd):
    """``--trackers NAME,module:Class,file.py:Class`` runs any class with init and update, also in other
    processes; what it prints is in no output.
    """
    chosen = "still-box,own_tracker:Mine,mine=./own_tracker.py:Mine"
    words = ["evaluate", str(folders), "--trackers", chosen, "--jobs", "2", "--no-restarts"]
    assert main(words) == 0
    printed = capfd.readouterr().out
    assert "like" not in printed
    assert "imported" not in printed
    rows = [line.split("|") for line in printed.splitlines() if line.startswith("|")]
    found = {row[1].strip(): row[2:] for row in rows}
    assert found["own_tracker:Mine"][0] == found["mine"][0] == found["still-box"][0]
    assert "own_tracker:Mine" in (own / "evaluation" / "report.html").read_text(encoding="utf-8")
    before = registry.code_digest("own_tracker:Mine")
    (own / "own_tracker.py").write_text(OWN + "\n")
    assert registry.code_digest("own_tracker:Mine") != before


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_leaves_no_process_of_a_tracker(folders, own, jobs):
    """Interrupted in an update that lasts, the command ends with 130, and so do the trackers' processes."""
    words = [str(folders), "--trackers", "own_tracker:Stays", "--no-restarts", "--jobs", jobs]
    child = subprocess.Popen([*COMMAND, *words], stderr=subprocess.PIPE, text=True, start_new_session=True)
    deadline = time.monotonic() + 120
    while not (started := list((own / "processes").iterdir())) and time.monotonic() < deadline:
        time.sleep(0.01)
    os.killpg(child.pid, signal.SIGINT)
    _, error = child.communicate(timeout=120)
    assert child.returncode == 130
    assert "Traceback" not in error
    assert started
    while any(map(runs, started)) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not any(map(runs, started))


def runs(file):
    """Whether a process with the number that a file is named by is there, and no zombie."""
    try:
        return Path("/proc", file.name, "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


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


def test_doubtful_true_boxes_are_told(tmp_path, capsys):
    """A table of frames that count from 1 is told below the table."""
    write_sequence(tmp_path / "data" / "walk", 5)
    (tmp_path / "data" / "walk" / "groundtruth_rect.txt").unlink()
    rows = [f"{frame},30,20,20,20\n" for frame in range(1, 6)]
    (tmp_path / "data" / "walk" / "boxes.csv").write_text("frame,x,y,w,h\n" + "".join(rows))
    arguments = ["evaluate", str(tmp_path / "data"), "--trackers", "still-box"]
    assert main([*arguments, "--output", str(tmp_path / "out")]) == 0
    assert "walk: the table's last frame is 5, but frames count from 0" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("a, b:C", ["a", "b:C"]),
        ("a,trax:./theirs --x=1,2", ["a", "trax:./theirs --x=1,2"]),
        ("mine=trax:python -m theirs,b", ["mine=trax:python -m theirs,b"]),
    ],
)
def test_names_of_trackers(text, names, monkeypatch):
    """Commas separate names, but for those in the command of a TraX program, which is the last."""
    monkeypatch.setattr(sys, "path", [*sys.path])
    assert any_tracker_names(text) == names
