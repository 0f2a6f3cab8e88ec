# SPDX-License-Identifier: MIT
import argparse

import pytest

from benchmarks.quality.common.arguments import seeds


@pytest.mark.parametrize(("text", "expected"), [("0:3", (0, 1, 2)), ("4", (4,)), ("1,5,7", (1, 5, 7))])
def test_seeds(text, expected):
    """A range without its end, or single seeds."""
    assert seeds(text) == expected


@pytest.mark.parametrize("text", ["3:3", "", "a", "-1", "0:x"])
def test_bad_seeds(text):
    """Empty ranges, words and negative numbers are refused."""
    with pytest.raises(argparse.ArgumentTypeError, match="expected seeds such as 0:20"):
        seeds(text)
