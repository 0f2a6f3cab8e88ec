# SPDX-License-Identifier: MIT
"""The random numbers of particle filters."""

import numpy as np
import pytest
from scipy import stats
from tricue.track.base.noise_pool import STARTS, STRIDE, NoisePool

SIZE = 400


def test_numbers_depend_on_seed_and_step_alone():
    """Another pool of the same seed has the same; another seed or step has others."""
    one, same, other = NoisePool(3, SIZE), NoisePool(3, SIZE), NoisePool(4, SIZE)
    np.testing.assert_array_equal(one.normal(7, (100, 4)), same.normal(7, (100, 4)))
    assert not np.array_equal(one.normal(7, (100, 4)), one.normal(8, (100, 4)))
    assert not np.array_equal(one.normal(7, (100, 4)), other.normal(7, (100, 4)))


def test_they_are_normal_and_cannot_be_changed():
    """Of a thousand steps, each number's distribution is the standard normal one."""
    pool = NoisePool(0, SIZE)
    steps = np.stack([pool.normal(step, (SIZE,)) for step in range(1000)])
    assert abs(steps.mean()) < 0.01
    assert abs(steps.std() - 1) < 0.01
    assert np.mean([stats.kstest(column, "norm").pvalue < 0.01 for column in steps.T]) < 0.05
    with pytest.raises(ValueError, match="read-only"):
        pool.normal(0, (SIZE,))[0] = 0


@pytest.mark.parametrize("every", [1, 2, 3])
def test_near_steps_share_few_numbers(every):
    """Of 40 steps, taken one after the other or every second or third one, no two share more than half of
    their numbers; and all places are used before one comes again.
    """
    places = np.array([step * every * STRIDE % STARTS for step in range(40)])
    apart = np.abs(places[:, None] - places)[np.triu_indices(len(places), 1)]
    assert np.minimum(apart, STARTS - apart).min() > SIZE / 2
    assert len({step * STRIDE % STARTS for step in range(STARTS)}) == STARTS


def test_uniform_numbers_spread_evenly():
    """A thousand of them fill [0, 1) more evenly than independent ones."""
    found = np.sort([NoisePool.uniform(step) for step in range(1000)])
    assert found[0] >= 0
    assert found[-1] < 1
    assert np.abs(found - (np.arange(1000) + 0.5) / 1000).max() < 0.005
