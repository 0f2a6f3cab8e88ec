# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.data.open_source import Source
from tricue.evaluation import metrics

from benchmarks.quality.common import sequence_runs
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.sequence_runs import find_tasks, run_sequence, run_sequences
from benchmarks.quality.common.variants import parse_variants


def test_a_still_box_has_the_overlap_of_its_motion(folders):
    """The target goes 2 px a frame and is 40 px wide: each run's AUC is that of these overlaps."""
    (task,) = find_tasks(parse_variants(["still-box"]), folders, ["there"])
    (result,) = run_sequence(task)

    def expected(step, count):
        shift = np.minimum(step * np.arange(count), 40)
        return metrics.success_curve((40 - shift) / (40 + shift)).mean()

    assert result.auc("forward") == result.auc("backward") == pytest.approx(expected(2, 20))
    assert result.auc("third") == pytest.approx(expected(6, 7))
    starts = [expected(2, count) for count in (20, 15, 10, 5)]
    assert result.auc("starts") == pytest.approx(np.mean(starts))
    shift = np.minimum(6 * np.arange(7), 40)
    assert result.overlap("third") == pytest.approx(np.mean((40 - shift) / (40 + shift)))
    # Each run counts once, though two are both passes and starts.
    assert len(sequence_runs.pool([result]).overlaps) == 2 * (20 + 15 + 10 + 5) + 7


def test_a_sequence_is_decoded_once(folders, monkeypatch):
    """For all trackers, and not at all where none can use it."""
    decoded, iterate = [], Source.__iter__
    monkeypatch.setattr(Source, "__iter__", lambda self: decoded.append(self.name) or iterate(self))
    words = ["still-box", "meanShift", "stereo-head"]
    (task,) = find_tasks(parse_variants(words), folders, ["there"])
    results = run_sequence(task)
    assert decoded == ["there"]
    assert [(each.tracker, bool(each.runs), each.unsupported) for each in results] == [
        ("still-box", True, ""),
        ("meanShift", True, ""),
        ("stereo-head", False, "no stereo pair"),
    ]
    run_sequence(task._replace(variants=task.variants[2:]))
    assert decoded == ["there"]


def test_the_longest_runs_first(folders, monkeypatch, capsys):
    """The one with a gap is shorter than the others. Results have the order of the tasks, and what can't run
    is named.
    """
    order, run = [], sequence_runs.run_sequence
    monkeypatch.setattr(
        sequence_runs, "run_sequence", lambda task, **how: order.append(task.entry.name) or run(task, **how)
    )
    results = run_sequences(find_tasks(parse_variants(["still-box", "stereo-head"]), folders), jobs=1)
    assert order == ["back", "there", "gap"]
    assert [each.sequence for each in results[::2]] == ["back", "gap", "there"]
    assert capsys.readouterr().err.count("left out stereo-head on gap: no stereo pair\n") == 1
    found = sequence_runs.by_tracker(results)
    assert list(found) == ["still-box"]
    for protocol in PROTOCOLS:
        mean = np.mean([each.auc(protocol) for each in found["still-box"]])
        assert sequence_runs.mean_auc(found["still-box"], protocol) == pytest.approx(mean)
