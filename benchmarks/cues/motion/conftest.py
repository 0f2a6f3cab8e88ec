# SPDX-License-Identifier: MIT
"""Two frames of a moving texture with known flow, made before any clock starts."""

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

Image = NDArray[np.uint8]
FLOW = (0.6, -0.4)


@pytest.fixture(scope="session")
def frames() -> tuple[Image, Image]:
    """Two noisy frames of 160x120; the texture moves by FLOW."""
    rng = np.random.default_rng(0)
    texture = cv2.GaussianBlur(rng.normal(0, 1, (160, 200)), (0, 0), 2.0)
    texture = 128 + 45 * texture / texture.std()
    shift = np.array([[1, 0, FLOW[0]], [0, 1, FLOW[1]]], float)
    moved = cv2.warpAffine(texture, shift, (200, 160), flags=cv2.INTER_CUBIC)
    previous, current = (
        (image[20:140, 20:180] + rng.normal(0, 1, (120, 160))).round().clip(0, 255).astype(np.uint8)
        for image in (texture, moved)
    )
    return previous, current
