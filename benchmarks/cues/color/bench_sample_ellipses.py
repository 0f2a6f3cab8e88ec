# SPDX-License-Identifier: MIT
"""144 places of 100 ellipses: native, reference, and OpenCV's remap with nearest neighbors."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]


def script(image: Image, ellipses: Floats, pattern: Floats) -> Image:
    """The baseline: one remap of all places, half a pixel less, as remap rounds where we take the floor."""
    places = (ellipses[:, None, :2] + ellipses[:, None, 2:] * pattern - 0.5).astype(np.float32)
    pixels = cv2.remap(image, places, None, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE)
    return np.ascontiguousarray(pixels.transpose(0, 2, 1))


@pytest.mark.benchmark(group="sample_ellipses")
@pytest.mark.work(lookups=100 * 144)
@pytest.mark.parametrize(
    "sample_ellipses",
    [_core.sample_ellipses, reference.sample_ellipses, script],
    ids=["native", "reference", "baseline"],
)
def bench_sample_ellipses(benchmark: Any, sample_ellipses: Callable[..., Any], frame: Image) -> None:
    """The twins read the same pixels; remap rounds places to 1/32 pixel, so it differs near pixels' edges."""
    rng = np.random.default_rng(0)
    ellipses = rng.normal([160, 120, 25, 31], [20, 20, 1, 1], (100, 4))
    pattern = grid(12, 12)
    samples = benchmark(sample_ellipses, frame, ellipses, pattern)
    same = samples == reference.sample_ellipses(frame, ellipses, pattern)
    assert same.mean() > (0.9 if sample_ellipses is script else 0.99999)
