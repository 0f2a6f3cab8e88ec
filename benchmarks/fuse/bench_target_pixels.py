# SPDX-License-Identifier: MIT
"""Target pixels by three cues in and around a target window: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Plane = NDArray[np.float32]
RANGES = [(-4.0, 4.0), (-4.0, 4.0), (0.0, 16.0)]


def script(
    planes: list[Plane],
    densities: list[NDArray[np.float64]],
    ranges: list[tuple[float, float]],
    window: Any,
    candidate: Any,
    threshold: float,
    alternatives: list[NDArray[np.float64]],
) -> tuple[NDArray[np.uint8], Plane]:
    """The baseline: the same in the candidate region, with integer corners here; the prior by np.interp."""
    x0, y0, x1, y1 = map(int, candidate)
    part = np.s_[y0:y1, x0:x1]
    columns = np.interp(np.arange(x0, x1) + 0.5, [x0, window[0], window[2], x1], [0, 1, 1, 0])
    rows = np.interp(np.arange(y0, y1) + 0.5, [y0, window[1], window[3], y1], [0, 1, 1, 0])
    odds = np.minimum(columns, rows[:, None]).astype(np.float32)
    for plane, density, alternative, (low, high) in zip(planes, densities, alternatives, ranges, strict=True):
        bins = len(density)
        seen = plane[part]
        places = np.nan_to_num((seen - np.float32(low)) * np.float32(bins / (high - low)), nan=-1)
        table = np.concatenate([[0], density / alternative, [0]]).astype(np.float32)
        odds *= table[np.clip(np.floor(places), -1, bins).astype(np.int32) + 1]
    posterior = np.zeros(planes[0].shape, np.float32)
    posterior[part] = odds / (odds + 1)
    return (posterior >= threshold).astype(np.uint8), posterior


IMPLEMENTATIONS = {"native": _core.target_pixels, "reference": reference.target_pixels, "baseline": script}


def check(benchmark: Any, target_pixels: Callable[..., Any], target: Any) -> None:
    """All decide the same, except for a pixel whose bin depends on rounding. The time doesn't depend on the
    alternatives.
    """
    ramp = np.linspace(1, 2, len(target.densities[0]))
    alternatives = [0.9 * ramp / ramp.sum()] * 3
    arguments = (target.planes, target.densities, RANGES, target.window, target.candidate, 0.5, alternatives)
    mask, posterior = benchmark(target_pixels, *arguments)
    expected_mask, expected = reference.target_pixels(*arguments)
    assert expected_mask.mean() > 0.02
    assert np.count_nonzero(mask != expected_mask) <= 2
    strange = abs(posterior - expected) > 1e-5
    assert np.count_nonzero(strange) <= 5
    assert_allclose(posterior[~strange], expected[~strange], atol=1e-5)


@pytest.mark.benchmark(group="target_pixels, 160x120")
@pytest.mark.work(lookups=3 * 60 * 75, bytes=3 * 4 * 60 * 75 + 5 * 160 * 120)
@pytest.mark.parametrize("target_pixels", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_target_pixels(benchmark: Any, target_pixels: Callable[..., Any], small: Any) -> None:
    """In a frame of 160x120, as in the paper."""
    check(benchmark, target_pixels, small)


@pytest.mark.benchmark(group="target_pixels, 640x480")
@pytest.mark.work(lookups=3 * 240 * 300, bytes=3 * 4 * 240 * 300 + 5 * 640 * 480)
@pytest.mark.parametrize("target_pixels", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_target_pixels_of_many(benchmark: Any, target_pixels: Callable[..., Any], large: Any) -> None:
    """In a frame of 640x480."""
    check(benchmark, target_pixels, large)
