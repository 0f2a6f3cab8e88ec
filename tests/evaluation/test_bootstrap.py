# SPDX-License-Identifier: MIT
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from tricue.evaluation import bootstrap
from tricue.evaluation.bootstrap import Interval, holm, mean_interval, sign_flip_p

DIFFERENCES = st.lists(st.floats(-1, 1), min_size=6, max_size=20)


def names(count):
    """As many clusters."""
    return [str(index) for index in range(count)]


@pytest.fixture
def few_draws(monkeypatch):
    """Fewer draws, for tests of many samples."""
    monkeypatch.setattr(bootstrap, "DRAWS", 1000)
    bootstrap._drawn.cache_clear()
    yield
    bootstrap._drawn.cache_clear()


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


@pytest.mark.parametrize("size", [8, 12, 30])
@pytest.mark.usefixtures("few_draws")
def test_the_true_mean_is_inside_as_often_as_it_says(size):
    """In 92 to 98 % of 600 samples of 8, 12 and 30 values the true mean is in the 95 % interval; the share
    itself has a standard error of 0.9 %.
    """
    rng = np.random.default_rng(size)
    found = [mean_interval(rng.normal(0.05, 0.1, size), names(size)) for _ in range(600)]
    assert 0.92 < np.mean([each.low < 0.05 < each.high for each in found]) < 0.98


@pytest.mark.usefixtures("few_draws")
def test_dependent_values_are_covered_if_drawn_together():
    """Five targets of a recording share its difficulty: with recordings drawn the interval has its share,
    with sequences drawn it would be far too narrow.
    """
    rng, together, apart = np.random.default_rng(5), 0, 0
    clusters = [str(index // 5) for index in range(60)]
    for _ in range(300):
        values = np.repeat(rng.normal(0, 0.1, 12), 5) + rng.normal(0, 0.02, 60)
        together += mean_interval(values, clusters).low < 0 < mean_interval(values, clusters).high
        apart += mean_interval(values, names(60)).low < 0 < mean_interval(values, names(60)).high
    assert 0.91 < together / 300 < 0.99
    assert apart / 300 < 0.75


@pytest.mark.parametrize("size", [6, 10, 40])
def test_equal_trackers_are_rarely_told_apart(size):
    """Of 1000 samples of differences without a mean at most 6.5 % have a p-value under 0.05 (their share has
    a standard error of 0.7 %), at 6 recordings as at 40.
    """
    rng = np.random.default_rng(size)
    p = [sign_flip_p(rng.normal(0, 0.1, size), names(size)) for _ in range(1000)]
    assert np.mean(np.array(p) < 0.05) < 0.065


def test_a_clear_difference_is_told_from_six_recordings_on():
    """Six differences of one sign have the p-value 2 of 64; of five nothing is said."""
    assert sign_flip_p([0.1] * 6, names(6)) == 2 / 64
    assert math.isnan(sign_flip_p([0.1] * 5, names(5)))
    assert not mean_interval([0.1] * 5, names(5)).known
    assert not mean_interval([0.1] * 5, names(5)).excludes_zero
    assert mean_interval([0.1] * 6, names(6)).excludes_zero


def test_the_p_value_is_scipys():
    """Of few recordings it is that of SciPy's exact permutation test of paired samples."""
    values = np.random.default_rng(4).normal(0.05, 0.1, 10)
    exact = stats.permutation_test(
        (values, np.zeros(10)), lambda x, y: np.mean(x - y), permutation_type="samples", n_resamples=np.inf
    )
    assert sign_flip_p(values, names(10)) == pytest.approx(exact.pvalue)


@given(DIFFERENCES)
def test_the_sign_of_all_differences_does_not_matter(values):
    """Which of two trackers comes first changes neither p-value nor width."""
    turned = [-value for value in values]
    clusters = names(len(values))
    assert sign_flip_p(values, clusters) == sign_flip_p(turned, clusters)
    one, other = mean_interval(values, clusters), mean_interval(turned, clusters)
    assert one.low == pytest.approx(-other.high, abs=1e-9)
    assert 0 < sign_flip_p(values, clusters) <= 1


@given(st.lists(st.floats(0, 1), max_size=12))
def test_holm_is_its_definition(p_values):
    """No p-value falls, their order stays, the smallest is multiplied by their number, the largest is itself
    or what a smaller one became.
    """
    adjusted = holm(p_values)
    assert all(a >= p for a, p in zip(adjusted, p_values, strict=True))
    order = np.argsort(p_values, kind="stable")
    assert all(np.diff(np.array(adjusted)[order]) >= 0)
    if p_values:
        assert min(adjusted) == min(1.0, len(p_values) * min(p_values))
        assert max(adjusted) >= max(p_values)


def test_holm_leaves_unknown_ones_out():
    """NaN stays NaN and doesn't make the others larger."""
    assert holm([0.01, math.nan, 0.04]) == [0.02, pytest.approx(math.nan, nan_ok=True), 0.04]


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


def test_few_clusters_have_no_interval():
    """Their mean is known, how far that is off isn't; and without values there is nothing to say."""
    found = mean_interval([0.1, 0.3], ["a", "a"])
    assert found.mean == pytest.approx(0.2)
    assert np.isnan([found.low, found.high]).all()
    assert not Interval(0.2, math.nan, math.nan).known
    with pytest.raises(ValueError, match="expected a number for each of 0 names"):
        mean_interval([], [])
