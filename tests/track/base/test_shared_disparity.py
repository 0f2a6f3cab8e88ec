# SPDX-License-Identifier: MIT
"""The disparity that most of a region shares."""

import time
import tracemalloc

import numpy as np
import pytest
from tricue.track.base.shared_disparity import most_shared


def test_most_share_it():
    """Those around the whole number that most are near, of two as frequent ones the smaller."""
    disparities = np.array([3.0, 9.4, 8.7, 20.0, 9.0, 20.5, 19.6], np.float32)
    np.testing.assert_array_equal(most_shared(disparities, 0.6), [0, 1, 1, 0, 1, 0, 0])


def test_nobody_shares_any():
    """With a tolerance below their fractions none is chosen."""
    assert not most_shared(np.array([1.4, 2.4], np.float32), 0.1).any()


@pytest.mark.parametrize("tolerance", [0.0, 0.25, 1.0, 1.3])
def test_it_is_as_defined(tolerance):
    """Of random disparities, many at the tolerance itself, the most are found, and the smaller candidate."""
    rng = np.random.default_rng(0)
    for count in range(1, 60):
        disparities = (rng.integers(-40, 40, count) / rng.choice([1, 4, 7])).astype(np.float32)
        near = [
            np.abs(disparities - each) <= np.float32(tolerance) for each in np.unique(np.round(disparities))
        ]
        best = near[int(np.argmax([each.sum() for each in near]))]
        np.testing.assert_array_equal(most_shared(disparities, tolerance), best)


def test_time_is_that_of_sorting():
    """60,000 disparities of their own, which took seconds when each was compared with all, take no time."""
    started = time.process_time()
    most_shared(np.arange(60_000, dtype=np.float32), 1.0)
    assert time.process_time() - started < 0.7


def test_memory_is_that_of_a_few_masks():
    """Where each of many has a disparity of its own, as depths in a wrong unit do, memory stays small."""
    disparities = np.arange(4000, dtype=np.float32)
    tracemalloc.start()
    most_shared(disparities, 1.0)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 100 * len(disparities)
