# SPDX-License-Identifier: MIT
"""What rounding may do to a Fourier transform."""

from collections.abc import Callable

import pytest


def _prime_factors(n: int) -> list[int]:
    smallest = next((p for p in range(2, n + 1) if n % p == 0), None)
    return [] if smallest is None else [smallest, *_prime_factors(n // smallest)]


@pytest.fixture(scope="session")
def fourier_error() -> Callable[..., float]:
    """Of transforms in float32 of the given lengths after one another: at most this part of the norm.

    Higham 2002, theorem 24.2, adds up the stages: a stage of p numbers rounds sums of p products, p + 4 times
    by 2^-24 with the weights' own rounding. Small planes are summed by the definition, along y half as many
    numbers: columns + rows / 2 + 5 roundings, which is less up to 36 a side.
    """
    return lambda *lengths: 2.0**-24 * sum(p + 4 for n in lengths for p in _prime_factors(n))
