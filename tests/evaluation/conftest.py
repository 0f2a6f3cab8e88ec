# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.camera.frame import Frame


@pytest.fixture(scope="session")
def patrol():
    """A textured red square of 40 px that moves 2 px a frame over dim noise: 20 frames, true boxes."""
    rng = np.random.default_rng(1)
    ground = rng.integers(20, 60, (120, 160, 3), dtype=np.uint8)
    square = cv2.resize(rng.integers(90, 255, (6, 6, 3), dtype=np.uint8), (40, 40)) // [4, 4, 1]
    frames, boxes = [], []
    for index in range(20):
        image = ground.copy()
        x, y = 30 + 2 * index, 40
        image[y : y + 40, x : x + 40] = square
        frames.append(Frame(color=image))
        boxes.append(Box(float(x), float(y), 40.0, 40.0))
    return tuple(frames), tuple(boxes)
