# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common import color_tables
from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.protocols import ORDERS
from benchmarks.quality.common.sequence_runs import SequenceResult


def result(sequence, overlap, orders=ORDERS):
    """The same run of two hundred frames in all orders: every other frame is TRACKED, in 1 ms to 100 ms, the
    others aren't, in 0.5 ms.
    """
    tracked = np.arange(200) % 2 == 1
    seconds = np.where(tracked, np.arange(200) // 2 + 1, 0.5) / 1e3
    seconds[0] = np.nan
    frames = FrameResults(
        np.full(200, overlap),
        np.zeros(200, np.bool_),
        np.full(200, 0.75),
        tracked,
        seconds,
        *[np.full(200, np.nan)] * 2,
    )
    return SequenceResult("fused", sequence, dict.fromkeys(orders, frames))


def test_groups_have_the_mean_of_their_sequences():
    """AUC of 0.5 is 10 of 21 thresholds, of 1 it is 20; a sequence without a protocol has no part in it."""
    found = {"fused": [result("Couple", 0.5), result("Panda", 1.0, ORDERS[:1])]}
    lines = color_tables.group_table(found).splitlines()
    assert lines[0].startswith("| tracker | AUC | all (2) | tuned (1) | others (1) | OTB (1) | people (1) |")
    assert lines[2].startswith("| fused | forward | 0.714 | 0.476 | 0.952 |")
    assert lines[5].startswith("| fused | third | 0.476 | 0.476 | - |")
    assert "| fused | Panda | 0.952 | - | 0.952 | - |" in color_tables.sequence_table(found)


def test_times_by_status():
    """Median and 99 % of the updates of each status; the first frame has no time."""
    frames = result("Couple", 1.0).runs[ORDERS[0]]
    assert color_tables.times(frames) == pytest.approx([50.5, np.percentile(np.arange(1, 101), 99), 0.5, 0.5])


def test_frames_of_all_runs_and_of_each_protocol():
    """A run that belongs to two protocols counts once in all; a protocol without runs has no row. The bin of
    the score has all frames; empty bins have none.
    """
    found = {"fused": [result("Couple", 1.0, ORDERS[:1])]}
    lines, bins = color_tables.frame_table(found).splitlines(), color_tables.reliability_table(found)
    numbers = "200 | 0.000 | - | - | 0.500 | 0.250 | 0.250 | 50.500 |"
    assert [line[: line.index(numbers)] for line in lines[2:]] == [
        f"| fused | {runs} | " for runs in ("all", "forward", "starts")
    ]
    assert "| fused | 0.7 to 0.8 | 0.750 | 1.000 | 200 |" in bins
    assert "| fused | 0.0 to 0.1 | - | - | 0 |" in bins


def test_csv_rows():
    """A line a protocol that has runs, with all columns."""
    rows = color_tables.csv_rows([result("Couple", 0.5), result("Panda", 1.0, ORDERS[:1])])
    assert [(row[1], row[2], row[3]) for row in rows] == [
        ("Couple", "forward", 1),
        ("Couple", "backward", 1),
        ("Couple", "starts", 8),
        ("Couple", "third", 1),
        ("Panda", "forward", 1),
        ("Panda", "starts", 1),
    ]
    assert {len(row) for row in rows} == {len(color_tables.CSV_COLUMNS)}
    assert rows[2][4] == 1600


def test_intervals_hang_on_recordings():
    """Where one recording is followed and another lost, both may have been drawn alone; two sequences of
    one recording are none.
    """
    followed, lost = result("Panda", 1.0), result("Gull", 0.0)
    row = color_tables.interval_table({"fused": [followed, lost]}).splitlines()[2]
    assert row.startswith("| fused | [0.000, 1.000] |")
    one = color_tables.interval_table({"fused": [result("Couple", 1.0), result("StreetWalker", 0.0)]})
    assert "| fused | - | - |" in one
