# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from benchmarks.quality.common.bootstrap import mean_interval

from benchmarks.quality.common import bootstrap


def names(count):
    """As many clusters."""
    return [str(index) for index in range(count)]


def test_the_width_is_that_of_a_normal_interval():
    """Of 200 values with the mean 0.05 it contains that, and is as wide as 3.92 standard errors, but for the
    noise of 10,000 draws. It is the same each time.
    """
    values = np.random.default_rng(1).normal(0.05, 0.02, 200)
    found = mean_interval(values, names(200))
    assert found.mean == pytest.approx(values.mean())
    assert found.low < 0.05 < found.high
    width = 2 * 1.96 * values.std() / np.sqrt(200)
    assert found.high - found.low == pytest.approx(width, rel=0.05)
    assert found == mean_interval(values, names(200))


def test_a_known_difference_is_mostly_inside(monkeypatch):
    """In 90 to 98 % of 300 samples of 30 values the true mean is in the interval: of 30 values it is a little
    narrow, and the share itself has a standard error of 1.3 %.
    """
    monkeypatch.setattr(bootstrap, "DRAWS", 1000)
    rng = np.random.default_rng(2)
    found = [mean_interval(rng.normal(0.05, 0.1, 30), names(30)) for _ in range(300)]
    assert 0.90 < np.mean([each.low < 0.05 < each.high for each in found]) < 0.98


def test_equal_values_of_a_cluster_are_one_observation():
    """Each value four times, under one name, leaves the interval as it was; under different names it halves
    its width.
    """
    values = np.random.default_rng(3).normal(0, 1, 50)
    once = mean_interval(values, names(50))
    together = mean_interval(np.tile(values, 4), names(50) * 4)
    apart = mean_interval(np.tile(values, 4), names(200))
    assert together == pytest.approx(once)
    assert (apart.high - apart.low) / (once.high - once.low) == pytest.approx(0.5, rel=0.1)


def test_one_cluster_has_no_interval():
    """Its mean is known, how far that is off isn't; and without values there is nothing to say."""
    found = mean_interval([0.1, 0.3], ["a", "a"])
    assert found.mean == pytest.approx(0.2)
    assert np.isnan([found.low, found.high]).all()
    with pytest.raises(ValueError, match="expected a number for each of 0 names"):
        mean_interval([], [])
