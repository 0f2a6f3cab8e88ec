# SPDX-License-Identifier: MIT
"""From light to the numbers in a video: exposure, white balance, gamma, blur and noise, each at random."""

import cv2
import numpy as np
from tricue.arrays import Floats, Image

from tools.face_model.painting import Random

REACH = 3  # pixels to either side, of the largest swing
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
    """Out of focus, mostly by less than a pixel; sometimes the camera or the target also moves."""
    focus = rng.uniform(0, 0.8) if rng.uniform() < 0.85 else rng.uniform(0.8, 1.5)
    if focus > 0.25:
        image = np.asarray(cv2.GaussianBlur(image, (0, 0), focus), np.float64)
    if rng.uniform() < 0.3:
        image = np.asarray(cv2.filter2D(image, -1, _path(rng)), np.float64)
    if rng.uniform() < 0.3:  # cameras sharpen edges
        smooth = cv2.GaussianBlur(image, (0, 0), rng.uniform(0.5, 1.2))
        image = image + rng.uniform(0, 1.2) * (image - smooth)
    return image


def _path(rng: Random) -> Floats:
    """How long a point stays on each pixel during the exposure, in a part of a swing to and fro."""
    direction, phase = rng.uniform(0, np.pi), rng.uniform(0, 2 * np.pi)
    way = rng.uniform(0.5, REACH) * np.sin(phase + np.linspace(0, rng.uniform(0.5, 1.5) * np.pi, 50))
    points = REACH + 1 + (way - way.mean())[:, np.newaxis] * [np.sin(direction), np.cos(direction)]
    path = np.zeros((2 * REACH + 3,) * 2)
    first = np.floor(points).astype(int)
    for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
        share = np.abs(1 - np.array(corner) - (points - first)).prod(axis=1)
        np.add.at(path, tuple((first + corner).T), share)
    return np.asarray(path / path.sum())
