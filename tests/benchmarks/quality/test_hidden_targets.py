# SPDX-License-Identifier: MIT
import csv

import pytest

from benchmarks.quality import hidden_targets
from benchmarks.quality.common.hidden_runs import HiddenResult, Hiding


def test_shares_of_the_runs():
    """More than 5 wrong frames in a row count; a way of hiding without runs has no shares."""
    results = [
        HiddenResult("x", "a", Hiding("covered", 30, False), True, 5),
        HiddenResult("x", "a", Hiding("covered", 30, True), False, 6),
        HiddenResult("y", "a", Hiding("covered", 30, True), False, 6),
    ]
    lines = hidden_targets.rows(results, ["x", "y"])
    assert lines[:2] == [["covered", 30, "x", 2, 0.5, 0.5], ["covered", 30, "y", 1, 0.0, 1.0]]
    assert [line[3] for line in lines[2:]] == [0] * 10


def test_the_command_prints_and_writes(folders, tmp_path, capsys):
    """A row per way of hiding and tracker, and in the file one per run; unknown sequences are named."""
    words = [str(folders), "--only", "there", "--trackers", "fused"]
    assert hidden_targets.main([*words, "--csv", str(tmp_path / "o.csv")]) == 0
    printed = capsys.readouterr().out
    assert "| empty | 30 | fused | 2 | 1.000 | 0.000 |" in printed
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert len(lines) == 3 * 2 * 2
    with pytest.raises(SystemExit):
        hidden_targets.main([str(folders), "--only", "nowhere"])
    assert "expected some of back, gap, there" in capsys.readouterr().err
