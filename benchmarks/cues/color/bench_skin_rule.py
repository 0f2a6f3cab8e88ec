# SPDX-License-Identifier: MIT
"""The explicit skin rule on 100 ellipses: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(samples: Image) -> NDArray[np.float32]:
    """The baseline: saturating differences and thresholds of whole planes."""
    b, g, r = (np.ascontiguousarray(samples[:, k]) for k in range(3))
    bright = (r > 95) & (g > 40) & (b > 20) & (r > b)
    spread = cv2.subtract(r, cv2.min(g, b)) > 15
    return (bright & spread & (cv2.subtract(r, g) > 15)).astype(np.float32)


@pytest.mark.benchmark(group="skin_rule")
@pytest.mark.work(bytes=7 * 100 * 251, ops8=10 * 100 * 251)
@pytest.mark.parametrize(
    "skin_rule", [_core.skin_rule, reference.skin_rule, script], ids=["native", "reference", "baseline"]
)
def bench_skin_rule(benchmark: Any, skin_rule: Callable[..., Any], samples: Image) -> None:
    """All decide the same."""
    skin = benchmark(skin_rule, samples)
    assert_array_equal(skin, reference.skin_rule(samples))
