# SPDX-License-Identifier: MIT
import csv

import pytest

from benchmarks.quality import color_video
from benchmarks.quality.common import saved_runs

WORDS = ("--trackers", "fused", "still-box", "--set", "fused.cues=color")


def test_the_command_prints_and_writes(folders, tmp_path, capsys):
    """The tables have each tracker, protocol and sequence, the file a line for each. The tracker is better
    than a still box, and a second run gives the same numbers.
    """
    for name, jobs in (("a", "1"), ("b", "2")):
        words = [str(folders), *WORDS, "--csv", str(tmp_path / name), "--jobs", jobs]
        assert color_video.main(words) == 0
    printed = capsys.readouterr().out
    assert "| tracker | AUC | all (3) | other (3) |" in printed
    assert printed.count("| still-box | gap |") == 2
    first, second = (list(csv.DictReader((tmp_path / name).read_text().splitlines())) for name in ("a", "b"))
    assert [{name: value for name, value in line.items() if name != "ms/frame"} for line in first] == [
        {name: value for name, value in line.items() if name != "ms/frame"} for line in second
    ]
    assert len(first) == 2 * 3 * 4
    forward = {(line["tracker"], line["sequence"]): float(line["AUC"]) for line in first[::4]}
    assert forward["fused", "there"] > forward["still-box", "there"] + 0.2


def test_runs_from_other_boxes_and_mirrored(folders, tmp_path):
    """Each protocol has as many runs as boxes are drawn, and other numbers than from the true box."""
    aucs = {}
    for name, how in (("true", []), ("drawn", ["--draws", "2"]), ("mirrored", ["--mirrored"])):
        words = [str(folders), "--only", "there", "--trackers", "fused", *how, "--csv", str(tmp_path / name)]
        assert color_video.main(words) == 0
        lines = list(csv.DictReader((tmp_path / name).read_text().splitlines()))
        assert [int(line["runs"]) for line in lines] == [
            runs * (2 if name == "drawn" else 1) for runs in (1, 1, 8, 1)
        ]
        aucs[name] = [float(line["AUC"]) for line in lines]
    assert min(abs(a - b) for a, b in zip(aucs["true"], aucs["drawn"], strict=True)) > 0
    assert aucs["mirrored"] == pytest.approx(aucs["true"], abs=0.1)
    with pytest.raises(SystemExit):
        color_video.main([str(folders), "--draws", "0"])


def test_a_run_is_compared_with_a_stored_one(folders, tmp_path, capsys):
    """With itself there is no difference; with another cue there is one. What isn't stored is named."""
    path = str(tmp_path / "runs.json")
    words = [str(folders), "--only", "there", "back"]
    assert color_video.main([*words, *WORDS, "--save", path]) == 0
    assert saved_runs.load(tmp_path / "runs.json").keys() == {"fused", "still-box"}
    capsys.readouterr()
    assert color_video.main([*words, *WORDS, "--against", path]) == 0
    same = capsys.readouterr()
    assert "| all | +0.000 [+0.000, +0.000] |" in same.out
    assert "| still-box: changed most | mean | forward |" in same.out
    assert same.err == ""
    other = ["--trackers", "fused", "fused:color", "--set", "fused.cues=filter"]
    assert color_video.main([str(folders), "--only", "there", "gap", *other, "--against", path]) == 0
    different = capsys.readouterr()
    assert "| all | +0.000 [-, -] | +0.000 [-, -] |" not in different.out
    assert different.out.count("changed most") == 1
    assert "not stored for fused: gap\n" in different.err
    assert "not stored for fused:color: gap, there\n" in different.err


def test_errors_end_with_a_line(folders, tmp_path, capsys):
    """A folder without sequences, an unknown tracker or sequence, and no stored runs."""
    for words, error in (
        ([str(tmp_path)], "found none"),
        (["--trackers", "nobody"], "got 'nobody'"),
        ([str(folders), "--trackers", "fused", "--only", "nowhere"], "expected some of back, gap, there"),
        ([str(folders), "--trackers", "fused", "--against", str(tmp_path / "no")], "No such file"),
    ):
        with pytest.raises(SystemExit):
            color_video.main(words)
        assert error in capsys.readouterr().err
