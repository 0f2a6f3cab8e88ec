# SPDX-License-Identifier: MIT
"""Importance weights of 100 ellipses: native, reference, and a NumPy script in the linear domain."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
random = np.random.default_rng(0)
PREVIOUS = random.normal(100, 5, (100, 4))
ARGUMENTS = (
    -random.exponential(3, 100),
    PREVIOUS + random.normal(0, 8, (100, 4)),
    PREVIOUS,
    (np.array([3.0, -2.0, 0.0, 0.0]), np.array([8.0, 8.0, 1.0, 1.0])),
    (np.array([110.0, 95.0]), np.array([[8.0, 0.0], [-3.0, 5.0]]), 0.25),
)


def script(
    log_likelihood: Floats,
    proposed: Floats,
    previous: Floats,
    dynamics: tuple[Floats, Floats],
    detection: tuple[Floats, Floats, float],
) -> tuple[Floats, float]:
    """The baseline: densities as in the textbook; NaN if all of them underflow."""
    (drift, scale), (mean, root, share) = dynamics, detection
    position = proposed[:, :2]
    z = (position - previous[:, :2] - drift[:2]) / scale[:2]
    p = np.exp(-0.5 * (z * z).sum(axis=1)) / (scale[0] * scale[1])
    offset = position - mean
    covariance = root @ root.T
    mahalanobis = np.einsum("ij,jk,ik->i", offset, np.linalg.inv(covariance), offset)
    detection = np.exp(-0.5 * mahalanobis) / np.sqrt(np.linalg.det(covariance))
    weights = np.exp(log_likelihood) * p / (share * detection + (1 - share) * p)
    return weights / weights.sum(), float(np.log(weights.mean()))


IMPLEMENTATIONS = {"native": _core.reweight, "reference": reference.reweight, "baseline": script}


@pytest.mark.benchmark(group="reweight")
@pytest.mark.work(flops64=100 * (3 * 20 + 30), divs64=100 * 4, why="exp and log, one by one")
@pytest.mark.parametrize("reweight", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_reweight(benchmark: Any, reweight: Callable[..., tuple[Floats, float]]) -> None:
    """All give the same weights and evidence."""
    weights, log_evidence = benchmark(reweight, *ARGUMENTS)
    expected, log_expected = reference.reweight(*ARGUMENTS)
    assert_allclose(weights, expected, rtol=1e-10)
    assert_allclose(log_evidence, log_expected, rtol=1e-10)
