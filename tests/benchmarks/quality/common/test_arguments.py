# SPDX-License-Identifier: MIT
import argparse

import pytest
from tricue.evaluation import baselines

from benchmarks.quality.common.arguments import parser, seeds


@pytest.mark.parametrize(("text", "expected"), [("0:3", (0, 1, 2)), ("4", (4,)), ("1,5,7", (1, 5, 7))])
def test_seeds(text, expected):
    """A range without its end, or single seeds."""
    assert seeds(text) == expected


@pytest.mark.parametrize("text", ["3:3", "", "a", "-1", "0:x"])
def test_bad_seeds(text):
    """Empty ranges, words and negative numbers are refused."""
    with pytest.raises(argparse.ArgumentTypeError, match="expected seeds such as 0:20"):
        seeds(text)


def test_a_cv2_without_contrib_is_enough(monkeypatch):
    """The default of --trackers has only those that the installed cv2 has."""
    monkeypatch.setattr(baselines, "available", lambda: {"MIL": None})
    options = parser("robust", "", ("fused", "fused:color", "CSRT", "MIL")).parse_args([])
    assert options.trackers == ["fused", "fused:color", "MIL"]
