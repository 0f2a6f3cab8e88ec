# SPDX-License-Identifier: MIT
import pytest

from benchmarks.quality.common import comparison

NAMES = ("Couple", "Crossing", "Gull", "Panda")


def aucs(change):
    """Of four sequences by two protocols, changed by so much a place in NAMES."""
    return {
        name: {"forward": 0.5 + change * index, "third": 0.4 - change * index}
        for index, name in enumerate(NAMES)
    }


def test_differences_are_paired():
    """Sequence by sequence, and of those that both have."""
    before = {name: found for name, found in aucs(0.0).items() if name != "Crossing"}
    found = comparison.differences(aucs(0.1), before, "third")
    assert found == pytest.approx({"Couple": 0.0, "Gull": -0.2, "Panda": -0.3})
    assert comparison.differences(aucs(0.1), before, "starts") == {}


def test_groups_have_their_mean_difference():
    """Animals: the last two. The interval is no wider than from the least to the most."""
    found = comparison.group_intervals(aucs(0.1), aucs(0.0), "forward")
    assert found.keys() == {"all", "tuned", "others", "OTB", "drones", "people", "animals"}
    assert found["animals"] == pytest.approx((0.25, 0.2, 0.3))
    assert found["all"].mean == pytest.approx(0.15)
    assert 0 <= found["all"].low < 0.15 < found["all"].high < 0.31


def test_the_largest_changes_come_first():
    """Up or down, by the mean over the protocols."""
    now = aucs(0.0)
    now["Gull"] = {"forward": 0.3, "third": 0.4}
    now["Crossing"] = {"forward": 0.55, "third": 0.4}
    rows = comparison.changed_most(now, aucs(0.0))
    assert [row[0] for row in rows[:2]] == ["Gull", "Crossing"]
    assert rows[0][1:3] == ["-0.100", "-0.200"]
    assert rows[0][3] == "-"
    text = comparison.tables("fused", now, aucs(0.0))
    assert "| all | -0.037 [" in text
    assert "| Gull | -0.100 | -0.200 | - | - | +0.000 |" in text
