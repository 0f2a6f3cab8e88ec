# SPDX-License-Identifier: MIT
"""The random numbers of a scene, from its seed."""

from numbers import Integral
from typing import Any

import numpy as np


def make_generator(seed: Any) -> np.random.Generator:
    """The random generator of a scene; ValueError for a seed that :func:`check_seed` rejects."""
    check_seed(seed)
    return np.random.default_rng(seed)


def check_seed(seed: Any) -> None:
    """ValueError for anything but a whole number from 0; None would give a new scene each time."""
    if not isinstance(seed, Integral) or seed < 0:
        raise ValueError(f"seed: expected a whole number from 0, got {seed!r:.80}")
