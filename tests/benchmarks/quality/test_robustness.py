# SPDX-License-Identifier: MIT
import csv
import shutil

import numpy as np
import pytest
from tricue.evaluation import confidence, metrics
from tricue.evaluation.dataset import Entry

from benchmarks.quality.fused import robust
from benchmarks.quality.fused.status_metrics import Said
from benchmarks.quality.fused.variants import participants


def test_orders():
    """One pass; every third frame; eight starts, four on each way, at the quarters."""
    assert [each.tolist() for each in robust.orders("plain", 4)] == [[0, 1, 2, 3]]
    assert [each.tolist() for each in robust.orders("third", 8)] == [[0, 3, 6]]
    starts = [each.tolist() for each in robust.orders("starts", 4)]
    assert starts[::2] == [[0, 1, 2, 3], [1, 2, 3], [2, 3], [3]]
    assert starts[1::2] == [[3, 2, 1, 0], [2, 1, 0], [1, 0], [0]]


def test_a_start_waits_for_truth(folders, tmp_path):
    """Frames before the first true box aren't seen; a run of fewer than two frames doesn't count."""
    folder = shutil.copytree(folders / "there", tmp_path / "there")
    lines = (folder / "groundtruth_rect.txt").read_text().splitlines()
    (folder / "groundtruth_rect.txt").write_text("\n".join(["NaN,NaN,NaN,NaN"] * 3 + lines[3:]))
    (participant,) = participants(["still-box"])
    opened = Entry("there", folder).open()
    frames = list(opened.source)
    said = robust.follow(participant, opened, frames, np.arange(20))
    assert len(said.overlaps) == 17
    assert said.overlaps[0] == 1
    assert robust.follow(participant, opened, frames, np.arange(4)) is None
    assert robust.follow(participant, opened, frames, np.arange(3)) is None


def test_a_still_box_has_the_overlap_of_its_motion(folders):
    """The target goes 2 px a frame and is 40 px wide: each run's AUC is that of these overlaps."""
    (participant,) = participants(["still-box"])
    result = robust.perform(robust.Task(participant, Entry("there", folders / "there")))
    assert {name: len(runs) for name, runs in result.runs.items()} == {"plain": 1, "starts": 8, "third": 1}

    def expected(step, count):
        shift = np.minimum(step * np.arange(count), 40)
        return metrics.success_curve((40 - shift) / (40 + shift)).mean()

    assert robust.auc(result, "plain") == pytest.approx(expected(2, 20))
    assert robust.auc(result, "third") == pytest.approx(expected(6, 7))
    starts = [expected(2, count) for count in (20, 15, 10, 5)]
    assert robust.auc(result, "starts") == pytest.approx(np.mean(starts))


def test_what_was_said():
    """Shares of lost, of lost that were TRACKED, of good that weren't; unknown frames don't count."""
    said = Said(
        overlaps=np.array([1.0, 0.9, 0.3, 0.05, 0.0, np.nan, 0.8]),
        absent=np.array([False] * 6 + [True]),
        scores=np.array([1.0, 0.2, 0.5, 0.4, 0.1, 0.9, 0.3]),
        tracked=np.array([True, False, True, True, False, True, True]),
        seconds=np.full(6, 0.002),
    )
    assert said.lost == 3 / 6
    assert said.tracked_of_lost == 2 / 3
    assert said.doubted_of_good == 1 / 2
    assert said.milliseconds == pytest.approx(2)
    assert said.auroc == confidence.auroc(said.overlaps, said.scores, said.absent)
    twice = Said.pooled([said, said])
    assert twice.lost == said.lost
    assert len(twice.seconds) == 12


def test_the_command_prints_and_writes(folders, tmp_path, capsys):
    """The tables have each tracker, protocol and sequence; the file a line for each. The tracker that follows
    is above the box that stands still; the same again gives the same numbers.
    """
    words = [str(folders), "--trackers", "fused", "still-box", "--set", "fused.cues=color", "--csv"]
    for name, jobs in (("a", "1"), ("b", "2")):
        assert robust.main([*words, str(tmp_path / name), "--jobs", jobs]) == 0
    printed = capsys.readouterr().out
    assert "| tracker | protocol | back | gap | there | mean |" in printed
    first, second = (list(csv.DictReader((tmp_path / name).read_text().splitlines())) for name in ("a", "b"))
    assert [{name: value for name, value in line.items() if name != "ms/frame"} for line in first] == [
        {name: value for name, value in line.items() if name != "ms/frame"} for line in second
    ]
    assert len(first) == 2 * 3 * 3
    plain = {(line["tracker"], line["sequence"]): float(line["AUC"]) for line in first[::3]}
    assert plain["fused", "there"] > plain["still-box", "there"] + 0.2


def test_errors_are_told(tmp_path, capsys):
    """A folder without sequences, and a tracker that nobody knows, end with a line."""
    for words, error in (([str(tmp_path)], "found none"), (["--trackers", "nobody"], "got 'nobody'")):
        with pytest.raises(SystemExit):
            robust.main(words)
        assert error in capsys.readouterr().err
