# SPDX-License-Identifier: MIT
"""From light to the numbers in a video: exposure, white balance, gamma, blur and noise, each at random."""

import cv2
import numpy as np
from tricue.arrays import Floats, Image

from tools.face_model.painting import Random

BRIGHT = 85  # percentile of the light by which a camera exposes


def photograph(rng: Random, light: Floats) -> Image:
    """The BGR image of what sends this linear RGB light to the camera."""
    exposed = light * np.exp(rng.normal(0, [0.10, 0.06, 0.12]))
    exposed *= rng.uniform(0.35, 0.9) / max(np.percentile(exposed, BRIGHT), 1e-6)
    if rng.uniform() < 0.3:  # haze, or light scattered in the lens
        exposed += rng.uniform(0, 0.08)
    image = np.clip(exposed, 0, 1) ** (1 / rng.uniform(1.7, 2.6))
    image = _blurred(rng, image)
    image += rng.normal(0, rng.uniform(0.002, 0.02), image.shape) * [1, 0.7, 0.8]
    paleness = rng.choice([0, rng.uniform(0.2, 0.7), 1], p=[0.65, 0.2, 0.15])  # 1: a gray image
    image += paleness * (image.mean(axis=2, keepdims=True) - image)
    return np.ascontiguousarray(np.clip(image * 255, 0, 255).astype(np.uint8)[..., ::-1])


def _blurred(rng: Random, image: Floats) -> Floats:
    """Out of focus by less than a pixel; sometimes the camera or the target also moves."""
    focus = rng.uniform(0, 0.8)
    if focus > 0.25:
        image = np.asarray(cv2.GaussianBlur(image, (0, 0), focus), np.float64)
    if rng.uniform() < 0.15:
        direction = rng.uniform(0, np.pi)
        tip = 2 * np.array([np.cos(direction), np.sin(direction)])
        path = np.zeros((5, 5))
        cv2.line(path, np.rint(2 - tip).astype(int).tolist(), np.rint(2 + tip).astype(int).tolist(), 1.0)
        image = np.asarray(cv2.filter2D(image, -1, path / path.sum()), np.float64)
    return image
