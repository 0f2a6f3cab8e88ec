# SPDX-License-Identifier: MIT
import csv

import pytest

from benchmarks.quality import room_scenes


@pytest.fixture
def made(scene_result):
    """Makes a tracker's result on a scene with the same overlap in both counted frames."""

    def make(tracker, kind, seed, overlap):
        result = scene_result(kind, overlaps=(overlap, overlap, 0.0))
        return result._replace(tracker=tracker, seed=seed)

    return make


def test_each_kind_counts_the_same_and_differences_are_paired(made):
    """One kind has more scenes; the difference is the mean over scenes, with an interval about it."""
    results = [
        *(made("a", "table", seed, 0.82) for seed in range(3)),
        made("a", "held", 0, 0.42),
        *(made("b", "table", seed, 0.62) for seed in range(3)),
        made("b", "held", 0, 0.42),
    ]
    first, second = room_scenes.rows(results)
    high, middle, low = (count / 21 for count in (17, 13, 9))  # thresholds below 0.82, 0.62, 0.42
    assert first[1:4] == pytest.approx([high, low, (high + low) / 2])
    assert second[3] == pytest.approx((middle + low) / 2)
    mean, low, _, high = second[4].replace("(", "").replace(")", "").split()
    assert float(mean) == pytest.approx(-3 / 4 * 4 / 21, abs=1e-3)
    assert float(low) <= float(mean) <= float(high)
    assert first[4] == ""


def test_only_visible_frames_count(made):
    """The third frame, without the target, doesn't lower the AUC of the others: 20 of 21 thresholds are
    below an overlap of 1.
    """
    assert room_scenes.auc(made("a", "table", 0, 1.0)) == pytest.approx(20 / 21)


def test_the_command_prints_and_writes(made, monkeypatch, tmp_path, capsys):
    """A line per tracker with a column per kind; every scene's AUC in the file."""
    monkeypatch.setattr(
        room_scenes,
        "run_room",
        lambda task: [made(each.label, task.kind, task.seed, 0.5) for each in task.variants],
    )
    words = ["--trackers", "still-box", "fused:depth", "--kinds", "walker", "table", "--seeds", "0:2"]
    assert room_scenes.main([*words, "--csv", str(tmp_path / "o.csv")]) == 0
    printed = capsys.readouterr().out
    assert "| tracker | walker | table | mean | difference | recovered |" in printed
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert len(lines) == 2 * 2 * 2
    assert {line["tracker"] for line in lines} == {"still-box", "fused:depth"}
    assert {line["recovered"] for line in lines} == {""}
