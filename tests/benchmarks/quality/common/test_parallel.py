# SPDX-License-Identifier: MIT
import math

import pytest

from benchmarks.quality.common.parallel import run_parallel


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_keep_the_order(jobs):
    """In this process or in several."""
    assert list(run_parallel(math.sqrt, [4.0, 1.0, 9.0], jobs)) == [2, 1, 3]
