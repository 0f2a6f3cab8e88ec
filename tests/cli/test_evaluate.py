# SPDX-License-Identifier: MIT
"""``tricue evaluate`` as a user runs it."""

import csv
import json
import subprocess
import sys

import pytest
from tricue.cli import main
from tricue.cli.arguments import any_tracker_names
from tricue.evaluation import tables
from tricue.track.base import registry

from tests.cli.conftest import OWN, write_sequence


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


def test_progress_of_a_search(tmp_path, capsys, monkeypatch):
    """The search of a large folder for sequences isn't silent."""
    monkeypatch.setattr("tricue.cli.progress._PLAIN_EVERY", 0.0)
    (tmp_path / "data" / "a").mkdir(parents=True)
    assert main(["evaluate", str(tmp_path / "data"), "--output", str(tmp_path / "out")]) == 2
    searched = "".join(f"{count}  folders searched for sequences\n" for count in (1, 2))
    assert capsys.readouterr().err.startswith(f"{searched}tricue evaluate: ")


def test_doubtful_true_boxes_are_told(tmp_path, capsys):
    """A table of frames that count from 1 is told below the table."""
    write_sequence(tmp_path / "data" / "walk", 5)
    (tmp_path / "data" / "walk" / "groundtruth_rect.txt").unlink()
    rows = [f"{frame},30,20,20,20\n" for frame in range(1, 6)]
    (tmp_path / "data" / "walk" / "boxes.csv").write_text("frame,x,y,w,h\n" + "".join(rows))
    arguments = ["evaluate", str(tmp_path / "data"), "--trackers", "still-box"]
    assert main([*arguments, "--output", str(tmp_path / "out")]) == 0
    assert "walk: the table's last frame is 5, but frames count from 0" in capsys.readouterr().out
