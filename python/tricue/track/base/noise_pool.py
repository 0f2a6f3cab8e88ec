# SPDX-License-Identifier: MIT
"""Random numbers for particle filters, from a pool: drawing them anew takes a tenth of a frame's time.

A step's numbers depend only on the seed and on the step's number. So a tracker's state holds no generator,
and an update that failed draws the same numbers again.
"""

from functools import lru_cache

import numpy as np

from tricue.arrays import Floats

STARTS = 2**15  # places in the pool at which a step's numbers may begin
GOLDEN_RATIO = (5**0.5 - 1) / 2  # its multiples spread evenly over [0, 1), also every second or third one
STRIDE = round(GOLDEN_RATIO * STARTS) | 1  # from a step's place to the next one's; odd, to use all places


class NoisePool:
    """Random numbers of the steps 0, 1, 2 and so on, for steps of the same size."""

    def __init__(self, seed: int, size: int) -> None:
        """size: how many normal numbers a step takes."""
        self._normal, self._size = _normal_numbers(seed, STARTS + size), size

    def normal(self, step: int, shape: tuple[int, ...]) -> Floats:
        """Independent standard normal numbers, read-only."""
        start = step * STRIDE % STARTS
        return self._normal[start : start + self._size].reshape(shape)

    @staticmethod
    def uniform(step: int) -> float:
        """A number in [0, 1)."""
        return (step + 1) * GOLDEN_RATIO % 1.0


@lru_cache(maxsize=4)
def _normal_numbers(seed: int, count: int) -> Floats:
    numbers = np.random.default_rng(seed).standard_normal(count)
    numbers.flags.writeable = False
    return numbers
