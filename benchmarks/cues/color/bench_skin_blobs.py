# SPDX-License-Identifier: MIT
"""Blobs of skin in a frame of 320x240: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
THRESHOLD, MIN_AREA = 0.4, 20


def script(image: Image, color: Image, threshold: float, min_area: int) -> NDArray[np.float64]:
    """The baseline: classification of whole planes, then connectedComponentsWithStats."""
    b, g, r = cv2.split(image)
    eta = cv2.max(cv2.max(b, g), r)
    b, g, r = cv2.split(cv2.absdiff(image, np.array([*color, 0.0])))
    boundary = cv2.subtract(eta, cv2.max(cv2.max(b, g), r), dtype=cv2.CV_16S)
    skin = (boundary > 255 * threshold).view(np.uint8)
    _, _, stats, centroids = cv2.connectedComponentsWithStats(skin, connectivity=8)
    blobs = np.hstack([stats, centroids + 0.5])[1:]
    blobs = blobs[blobs[:, 4] >= min_area]
    return blobs[np.lexsort((blobs[:, 0], blobs[:, 1], -blobs[:, 4]))]


@pytest.mark.benchmark(group="skin_blobs")
@pytest.mark.work(bytes=3 * 320 * 240, ops8=16 * 320 * 240, why="runs are joined one by one")
@pytest.mark.parametrize(
    "skin_blobs", [_core.skin_blobs, reference.skin_blobs, script], ids=["native", "reference", "baseline"]
)
def bench_skin_blobs(benchmark: Any, skin_blobs: Callable[..., Any], frame: Image, color: Image) -> None:
    """All find the same blobs in the same order."""
    blobs = benchmark(skin_blobs, frame, color, THRESHOLD, MIN_AREA)
    assert len(blobs) > 10
    assert_allclose(blobs, reference.skin_blobs(frame, color, THRESHOLD, MIN_AREA), rtol=1e-12)
