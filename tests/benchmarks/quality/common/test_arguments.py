# SPDX-License-Identifier: MIT
import argparse
import csv
import math

import pytest
from tricue.evaluation import baselines

from benchmarks.quality.fused.options import markdown, mean, parser, performed, seeds, write_csv


@pytest.mark.parametrize(("text", "expected"), [("0:3", (0, 1, 2)), ("4", (4,)), ("1,5,7", (1, 5, 7))])
def test_seeds(text, expected):
    """A span without its end, or each by itself."""
    assert seeds(text) == expected


@pytest.mark.parametrize("text", ["3:3", "", "a", "-1", "0:x"])
def test_bad_seeds(text):
    """Nothing, words and what is below 0 are refused."""
    with pytest.raises(argparse.ArgumentTypeError, match="expected seeds such as 0:20"):
        seeds(text)


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_keep_the_order(jobs):
    """In this process or in several."""
    assert list(performed(math.sqrt, [4.0, 1.0, 9.0], jobs)) == [2, 1, 3]


def test_tables_and_files(tmp_path):
    """Markdown with rounded numbers, CSV with all digits; what isn't known is "-" or empty."""
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


def test_mean_of_what_is_known():
    """NaN is left out, and is the mean of nothing."""
    assert mean([1.0, float("nan"), 3.0]) == 2
    assert math.isnan(mean([float("nan")]))
    assert math.isnan(mean([]))


def test_a_cv2_without_contrib_is_enough(monkeypatch):
    """Without --trackers only those are compared that the installed cv2 has."""
    monkeypatch.setattr(baselines, "available", lambda: {"MIL": None})
    options = parser("robust", "", ("fused", "fused:color", "CSRT", "MIL")).parse_args([])
    assert options.trackers == ["fused", "fused:color", "MIL"]
