# SPDX-License-Identifier: MIT
"""The peak of 32x32 cells by two filters and a contrast: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Plane = NDArray[np.float32]


def script(responses: Plane, contrast: Plane, filter_weight: float, contrast_weight: float) -> Any:
    """The baseline: argmax, and a quadratic fit by least squares."""
    evidence = filter_weight * responses[0] + contrast_weight * contrast
    i, j = np.unravel_index(evidence.argmax(), evidence.shape)
    offsets = []
    for profile, at in ((evidence[i], j), (evidence[:, j], i)):
        a, b, _ = np.polyfit((-1, 0, 1), profile[at - 1 : at + 2], 2)
        offsets.append(at - b / (2 * a) - 16)
    near = responses[:, i - 1 : i + 2, j - 1 : j + 2].max(axis=(1, 2))
    return np.array([*offsets, evidence[i, j], responses[0, i, j], contrast[i, j], *near])


@pytest.mark.benchmark(group="evidence_peak, 32x32")
@pytest.mark.work(flops32=4 * 32 * 32, why="the call takes a third")
@pytest.mark.parametrize(
    "evidence_peak",
    [_core.evidence_peak, reference.evidence_peak, script],
    ids=["native", "reference", "baseline"],
)
def bench_evidence_peak(benchmark: Any, evidence_peak: Callable[..., Any]) -> None:
    """All find the same, within the rounding of float32 in the fit."""
    y, x = np.indices((32, 32))
    responses = np.stack([np.exp(-((x - 14.3) ** 2 + (y - 17.8) ** 2) / s) for s in (9, 16)])
    contrast = np.random.default_rng(0).random((32, 32), np.float32)
    arguments = responses.astype(np.float32), contrast, 0.7, 0.03
    found = benchmark(evidence_peak, *arguments)
    assert_allclose(found, reference.evidence_peak(*arguments), rtol=0, atol=1e-4)
