# SPDX-License-Identifier: MIT
import csv
import math

from benchmarks.quality.common.tables import markdown, mean, write_csv


def test_tables_and_files(tmp_path):
    """Markdown with rounded numbers, CSV with all digits; NaN is "-" or empty."""
    head, rows = ["who", "a", "b"], [["x", 1 / 3, float("nan")], ["y", 2.0, 7]]
    assert markdown(head, rows).splitlines() == [
        "| who | a | b |",
        "| --- | --- | --- |",
        "| x | 0.333 | - |",
        "| y | 2.000 | 7 |",
    ]
    write_csv(tmp_path / "new" / "o.csv", head, rows)
    read = list(csv.DictReader((tmp_path / "new" / "o.csv").read_text().splitlines()))
    assert float(read[0]["a"]) == 1 / 3
    assert read[0]["b"] == ""
    write_csv(None, head, rows)


def test_mean_leaves_out_nan():
    """The mean of nothing is NaN."""
    assert mean([1.0, float("nan"), 3.0]) == 2
    assert math.isnan(mean([float("nan")]))
    assert math.isnan(mean([]))
