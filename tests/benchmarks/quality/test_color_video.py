# SPDX-License-Identifier: MIT
import csv
import shutil

import numpy as np
import pytest
from tricue.evaluation import metrics
from tricue.evaluation.dataset import Entry

from benchmarks.quality import robustness
from benchmarks.quality.common.variants import parse_variants


def test_orders():
    """One pass; every third frame; eight starts, four on each way, at the quarters."""
    assert [each.tolist() for each in robustness.orders("plain", 4)] == [[0, 1, 2, 3]]
    assert [each.tolist() for each in robustness.orders("third", 8)] == [[0, 3, 6]]
    starts = [each.tolist() for each in robustness.orders("starts", 4)]
    assert starts[::2] == [[0, 1, 2, 3], [1, 2, 3], [2, 3], [3]]
    assert starts[1::2] == [[3, 2, 1, 0], [2, 1, 0], [1, 0], [0]]


def test_a_start_waits_for_truth(folders, tmp_path):
    """Frames before the first true box aren't tracked; a run of fewer than two frames doesn't count."""
    folder = shutil.copytree(folders / "there", tmp_path / "there")
    lines = (folder / "groundtruth_rect.txt").read_text().splitlines()
    (folder / "groundtruth_rect.txt").write_text("\n".join(["NaN,NaN,NaN,NaN"] * 3 + lines[3:]))
    (variant,) = parse_variants(["still-box"])
    opened = Entry("there", folder).open()
    frames = list(opened.source)
    results = robustness.run_order(variant, opened, frames, np.arange(20))
    assert len(results.overlaps) == 17
    assert results.overlaps[0] == 1
    assert robustness.run_order(variant, opened, frames, np.arange(4)) is None
    assert robustness.run_order(variant, opened, frames, np.arange(3)) is None


def test_a_still_box_has_the_overlap_of_its_motion(folders):
    """The target goes 2 px a frame and is 40 px wide: each run's AUC is that of these overlaps."""
    (variant,) = parse_variants(["still-box"])
    result = robustness.run_protocols(robustness.RobustnessTask(variant, Entry("there", folders / "there")))
    assert {name: len(runs) for name, runs in result.runs.items()} == {"plain": 1, "starts": 8, "third": 1}

    def expected(step, count):
        shift = np.minimum(step * np.arange(count), 40)
        return metrics.success_curve((40 - shift) / (40 + shift)).mean()

    assert robustness.auc(result, "plain") == pytest.approx(expected(2, 20))
    assert robustness.auc(result, "third") == pytest.approx(expected(6, 7))
    starts = [expected(2, count) for count in (20, 15, 10, 5)]
    assert robustness.auc(result, "starts") == pytest.approx(np.mean(starts))


def test_the_command_prints_and_writes(folders, tmp_path, capsys):
    """The tables have each tracker, protocol and sequence, the file a line for each. The tracker is better
    than a still box, and a second run gives the same numbers.
    """
    words = [str(folders), "--trackers", "fused", "still-box", "--set", "fused.cues=color", "--csv"]
    for name, jobs in (("a", "1"), ("b", "2")):
        assert robustness.main([*words, str(tmp_path / name), "--jobs", jobs]) == 0
    printed = capsys.readouterr().out
    assert "| tracker | protocol | back | gap | there | mean |" in printed
    first, second = (list(csv.DictReader((tmp_path / name).read_text().splitlines())) for name in ("a", "b"))
    assert [{name: value for name, value in line.items() if name != "ms/frame"} for line in first] == [
        {name: value for name, value in line.items() if name != "ms/frame"} for line in second
    ]
    assert len(first) == 2 * 3 * 3
    plain = {(line["tracker"], line["sequence"]): float(line["AUC"]) for line in first[::3]}
    assert plain["fused", "there"] > plain["still-box", "there"] + 0.2


def test_errors_end_with_a_line(tmp_path, capsys):
    """A folder without sequences, and an unknown tracker."""
    for words, error in (([str(tmp_path)], "found none"), (["--trackers", "nobody"], "got 'nobody'")):
        with pytest.raises(SystemExit):
            robustness.main(words)
        assert error in capsys.readouterr().err
