# SPDX-License-Identifier: MIT
"""A target's place in a patch of 64x64 pixels: native, reference, and its parts one by one."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from tricue import _core, reference

random = np.random.default_rng(0)
PATCH = random.integers(0, 256, (64, 64, 3), np.uint8)
TAPER = random.random((32, 32), np.float32)
FILTERS = np.ascontiguousarray(np.fft.rfft2(random.uniform(-1, 1, (2, 19, 32, 32))) / 1024, np.complex64)
TABLE, OTHER = random.random((16, 16, 16), np.float32), random.random((64, 64), np.float32)
ROOTS = np.full(4096, 1 / 64)
SEARCH = 17.4, 26.1, 1.5, 0.5, 0.7, 0.3, 0.8


def script(patch: Any, taper: Any, appearance: Any, other: Any, search: Any) -> Any:
    """The baseline: a call for each part, and NumPy for the features of the place."""
    filters, table, roots = appearance
    responses = _core.correlation_response(_core.hog_color_cells(patch, taper), filters)
    posterior = _core.combine_posteriors(_core.color_posterior(patch, table), other)
    peak = _core.evidence_peak(responses, _core.box_contrast(posterior, *search[:4]), *search[4:6])
    x, y = 32 + 2 * peak[0], 32 + 2 * peak[1]
    half_width, half_height = (search[6] * side / 2 for side in search[:2])
    part = patch[
        round(y - half_height) : round(y + half_height), round(x - half_width) : round(x + half_width)
    ]
    samples = np.ascontiguousarray(part.reshape(-1, 3).T)[None]
    similarity = np.sqrt(_core.joint_histogram(samples, 16)[0]) @ roots
    return np.array([*peak, (peak[5] - responses[0].mean()) / responses[0].std(), similarity]), responses


@pytest.mark.benchmark(group="localize_target, 64x64")
@pytest.mark.work(flops32=21 * 25_600 + 2 * 19 * 8 * 32 * 17 + 4096 * 120)
@pytest.mark.parametrize(
    "localize_target",
    [_core.localize_target, reference.localize_target, script],
    ids=["native", "reference", "baseline"],
)
def bench_localize_target(benchmark: Any, localize_target: Callable[..., Any]) -> None:
    """All find the same, within the rounding of the responses."""
    arguments = PATCH, TAPER, (FILTERS, TABLE, ROOTS), OTHER, SEARCH
    found, _ = benchmark(localize_target, *arguments)
    expected, _ = reference.localize_target(*arguments)
    assert_allclose(found, expected, rtol=1e-3, atol=1e-3)
