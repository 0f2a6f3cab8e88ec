# SPDX-License-Identifier: MIT
import csv

import pytest

from benchmarks.quality import depth_video
from benchmarks.quality.common import saved_runs
from benchmarks.quality.common.variants import parse_variants

TRACKERS = ("--trackers", "fused", "fused:color", "fused:depth", "still-box")


def test_the_command_prints_and_writes(walk, tmp_path, capsys):
    """All tables, and a line for each tracker, target and protocol; a second run gives the same numbers. With
    depth the person is followed, whose depth is known; a still box isn't told of times.
    """
    (walk / "walk" / "groundtruth_again.txt").write_text((walk / "walk" / "groundtruth.txt").read_text())
    for name, jobs in (("a", "1"), ("b", "2")):
        words = [str(walk), *TRACKERS, "--csv", str(tmp_path / name), "--jobs", jobs]
        assert depth_video.main(words) == 0
    printed = capsys.readouterr().out
    assert "| tracker | target, AUC | forward |" in printed
    assert printed.count("| fused, no times | walk again |") == 2
    assert printed.count("| fused minus fused:color: AUC, 95 % interval | forward |") == 2
    assert printed.count("| fused:depth, no times | all | 0.0") == 2
    first, second = (list(csv.DictReader((tmp_path / name).read_text().splitlines())) for name in ("a", "b"))
    assert [{name: value for name, value in line.items() if name != "ms/frame"} for line in first] == [
        {name: value for name, value in line.items() if name != "ms/frame"} for line in second
    ]
    assert len(first) == 7 * 2 * 4
    forward = {(each["tracker"], each["target"]): each for each in first if each["protocol"] == "forward"}
    still, depth = (forward[name, "walk"] for name in ("still-box", "fused:depth"))
    assert float(depth["mean overlap"]) > float(still["mean overlap"]) + 0.2
    assert float(depth["TRACKED on target"]) < 0.05
    assert still["z error m"] == forward["fused:color", "walk"]["z error m"] == ""


def test_a_run_is_compared_with_a_stored_one(walk, tmp_path, capsys):
    """With itself there is no difference."""
    path = tmp_path / "runs.json"
    words = [str(walk), *TRACKERS[:3], "--times", "without"]
    assert depth_video.main([*words, "--save", str(path)]) == 0
    assert saved_runs.load(path).keys() == {"fused, no times", "fused:color, no times"}
    assert depth_video.main([*words, "--against", str(path)]) == 0
    out, err = capsys.readouterr()
    assert "| fused, no times: changed most | mean | forward |" in out
    assert "| all | +0.000 [-, -] |" in out
    assert err == ""


def test_runs_from_other_boxes(walk, tmp_path):
    """Each protocol has as many runs as boxes are drawn, and other numbers than from the true box."""
    rows = {}
    for name, how in (("true", []), ("drawn", ["--draws", "2"])):
        words = [str(walk), *TRACKERS[:2], "--times", "with", *how, "--csv", str(tmp_path / name)]
        assert depth_video.main(words) == 0
        rows[name] = list(csv.DictReader((tmp_path / name).read_text().splitlines()))
    for true, drawn in zip(*rows.values(), strict=True):
        assert int(drawn["runs"]) == 2 * int(true["runs"])
        assert drawn["AUC"] != true["AUC"]


def test_times():
    """With, without or both; a baseline, which doesn't use them, once and under its name."""
    variants = parse_variants(["fused", "still-box"])
    labels = {
        way: [each.label for each in depth_video.by_times(variants, way)] for way in ("with", "without")
    }
    assert labels == {"with": ["fused", "still-box"], "without": ["still-box", "fused, no times"]}
    both = depth_video.by_times(variants, "both")
    assert [each.label for each in both] == ["fused", "still-box", "fused, no times"]
    assert [each.timed for each in both] == [True, True, False]


def test_errors_end_with_a_line(walk, tmp_path, capsys):
    """A folder without sequences, and an unknown target."""
    for words, error in (
        ([str(tmp_path / "nowhere")], "there is no such file"),
        ([str(walk), "--only", "walker"], "expected some of walk, got 'walker'"),
    ):
        with pytest.raises(SystemExit):
            depth_video.main(words)
        assert error in capsys.readouterr().err
