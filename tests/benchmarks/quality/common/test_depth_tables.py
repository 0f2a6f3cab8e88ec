# SPDX-License-Identifier: MIT
import numpy as np

from benchmarks.quality.common import depth_tables
from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.protocols import ORDERS
from benchmarks.quality.common.sequence_runs import SequenceResult
from benchmarks.quality.common.variants import parse_variants, without_times

NAMES = ("paper-cup", "yellow-dragon", "walk-away")


def result(tracker, sequence, overlap, orders=ORDERS, error=0.1):
    """The same run of four frames in all orders."""
    frames = FrameResults(
        np.full(4, overlap),
        np.zeros(4, np.bool_),
        np.full(4, 0.75),
        np.ones(4, np.bool_),
        np.array([np.nan, 1e-3, 1e-3, 1e-3]),
        np.full(4, error),
        np.full(4, 0.06),
    )
    return SequenceResult(tracker, sequence, dict.fromkeys(orders, frames))


def test_targets_and_groups():
    """The AUC and the mean overlap: an overlap of 0.5 is an AUC of 10 of 21 thresholds, one of 1 is 20."""
    found = {
        "fused": [result("fused", name, value) for name, value in zip(NAMES, (0.5, 1, 0.5), strict=True)]
    }
    lines = depth_tables.target_table(found).splitlines()
    assert len(lines) == 2 + 3 + 3
    assert lines[2].startswith("| fused | paper-cup | 0.476 | 0.476 | 0.476 | 0.476 | 0.500 | 0.500 |")
    assert lines[5].startswith("| fused | all (3) | 0.635 |")
    assert lines[6].startswith("| fused | registered (2) | 0.714 | 0.714 | 0.714 | 0.714 | 0.750 |")
    assert lines[7].startswith("| fused | walkers (1) | 0.476 |")


def test_pairs():
    """Each with color alone, of the same tracker and with or without times; without times with times."""
    variants = parse_variants(["fused", "fused:color", "fused:depth", "flow-depth", "still-box"])
    assert depth_tables.pairs(variants) == [("fused", "fused:color"), ("fused:depth", "fused:color")]
    whole, color = variants[:2]
    assert depth_tables.pairs([whole, color, without_times(whole), without_times(color)]) == [
        ("fused", "fused:color"),
        ("fused, no times", "fused"),
        ("fused, no times", "fused:color, no times"),
        ("fused:color, no times", "fused:color"),
    ]


def test_differences_are_paired():
    """With an interval over recordings; a variant that didn't run has none."""
    variants = parse_variants(["fused", "fused:color", "fused:depth"])
    found = {
        "fused": [result("fused", name, 1.0) for name in NAMES],
        "fused:color": [result("fused:color", name, 0.5) for name in NAMES],
    }
    (table,) = depth_tables.difference_tables(variants, found)
    assert table.startswith("| fused minus fused:color: AUC, 95 % interval | forward |")
    assert "| all | +0.476 [+0.476, +0.476] |" in table
    assert "| walkers | +0.476 [-, -] |" in table


def test_frame_tables():
    """Pooled by group; only trackers with positions have depths. An error of 0.1 is in two sigma of 0.06."""
    runs = [result("fused", NAMES[0], 1.0), result("fused", NAMES[2], 0.05)]
    found = {"fused": runs, "CSRT": [result("CSRT", NAMES[0], 1.0, error=np.nan)]}
    summary, depths = depth_tables.frame_tables(found)
    assert "| fused | all | 72 | 0.500 | 0.500 | 1.000 | 0.000 |" in summary
    assert "| fused | walkers | 36 | 1.000 | - | 1.000 | - |" in summary
    assert "| CSRT | registered | 36 | 0.000 |" in summary
    assert "| fused | registered | 0.100 | 0.100 | 0.100 | 0.060 | 0.000 | 1.000 |" in depths
    assert "CSRT" not in depths


def test_csv_rows():
    """A line a protocol that has runs, with all columns."""
    rows = depth_tables.csv_rows([result("fused", NAMES[0], 0.5), result("fused", NAMES[1], 1.0, ORDERS[:1])])
    assert [row[2] for row in rows] == ["forward", "backward", "starts", "third", "forward", "starts"]
    assert {len(row) for row in rows} == {len(depth_tables.CSV_COLUMNS)}
