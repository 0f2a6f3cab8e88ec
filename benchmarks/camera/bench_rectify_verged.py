# SPDX-License-Identifier: MIT
"""The right image of a verged pair: native, reference and cv2.warpPerspective, 640x480."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]

ANGLE, FOCAL = 0.1, 600.0


def baseline(image: Image, angle: float, focal: float) -> Image:
    """The homography K R K^-1."""
    height, width = image.shape[:2]
    camera = np.array([[focal, 0, (width - 1) / 2], [0, focal, (height - 1) / 2], [0, 0, 1]])
    turn = cv2.Rodrigues(np.array([0, angle, 0]))[0]
    back = camera @ turn @ np.linalg.inv(camera)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return np.asarray(cv2.warpPerspective(image, back, (width, height), flags=flags), np.uint8)


IMPLEMENTATIONS = {
    "native": _core.rectify_verged,
    "reference": reference.rectify_verged,
    "baseline": baseline,
}


@pytest.mark.parametrize("rectify", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
@pytest.mark.parametrize(
    "color",
    [
        pytest.param(
            False,
            marks=[
                pytest.mark.benchmark(group="rectify_verged, gray"),
                pytest.mark.work(lookups=2 * 640 * 480, ops8=36 * 640 * 480),
            ],
        ),
        pytest.param(
            True,
            marks=[
                pytest.mark.benchmark(group="rectify_verged, BGR"),
                pytest.mark.work(
                    lookups=2 * 640 * 480, ops8=108 * 640 * 480, why="three numbers a pixel, one by one"
                ),
            ],
        ),
    ],
    ids=["gray", "BGR"],
)
def bench_rectify_verged(benchmark: Any, rectify: Callable[..., Image], color: bool) -> None:
    """All agree within 2 gray levels inside the image: cv2 interpolates in steps of 1/32 px."""
    noise = np.random.default_rng(0).uniform(0, 255, (480, 640, 3))
    image = cv2.GaussianBlur(noise, (0, 0), 3).astype(np.uint8)
    image = image if color else np.ascontiguousarray(image[..., 0])
    found = benchmark(rectify, image, ANGLE, FOCAL)
    expected = baseline(image, ANGLE, FOCAL)
    seen = cv2.erode(((found > 0) & (expected > 0)).astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    assert seen.mean() > 0.8  # without the edge, which cv2 blends with the outside
    assert abs(found.astype(int) - expected)[seen].max() <= 2
