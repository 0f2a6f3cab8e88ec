# SPDX-License-Identifier: MIT
"""Times of calls that are compared."""

from collections.abc import Callable, Sequence
from time import perf_counter

import numpy as np


def fastest(calls: Sequence[Callable[[], object]], rounds: int) -> list[float]:
    """Seconds of each call in its fastest round; in every round the calls take turns."""
    best = [np.inf] * len(calls)
    for _ in range(max(1, rounds)):
        for index, call in enumerate(calls):
            start = perf_counter()
            call()
            best[index] = min(best[index], perf_counter() - start)
    return best
