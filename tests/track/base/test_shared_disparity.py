# SPDX-License-Identifier: MIT
"""The disparity that most of a region shares."""

import tracemalloc

import numpy as np
from tricue.track.base.shared_disparity import most_shared


def test_most_share_it():
    """Those around the whole number that most are near, of two as frequent ones the smaller."""
    disparities = np.array([3.0, 9.4, 8.7, 20.0, 9.0, 20.5, 19.6], np.float32)
    np.testing.assert_array_equal(most_shared(disparities, 0.6), [0, 1, 1, 0, 1, 0, 0])


def test_nobody_shares_any():
    """With a tolerance below their fractions none is chosen."""
    assert not most_shared(np.array([1.4, 2.4], np.float32), 0.1).any()


def test_memory_is_that_of_a_few_masks():
    """Where each of many has a disparity of its own, as depths in a wrong unit do, memory stays small."""
    disparities = np.arange(4000, dtype=np.float32)
    tracemalloc.start()
    most_shared(disparities, 1.0)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 100 * len(disparities)
