# SPDX-License-Identifier: MIT
"""How a surface looks in a light: Lambert's law, the sky, ambient occlusion, and short cast shadows."""

from typing import NamedTuple

import cv2
import numpy as np
from tricue.arrays import Floats

from tools.face_model.heads import STEP, Head, X, Y
from tools.face_model.painting import Random, ramp

PIVOT = 50.0  # mm, height of the point around which a head turns
NEAR = 8.0  # mm, deviation of the neighborhood that occludes
SHADOW_STEPS = 6.0, 12.0, 20.0  # mm toward the light, at which something may stand in it


class Light(NamedTuple):
    """ambient: the sky's share. direction: toward the light. color: its own. shadow: how dark shadows are."""

    ambient: float
    direction: Floats
    color: Floats
    shadow: float


def random_light(rng: Random) -> Light:
    """From everywhere in front, more often from above; also from below, as off a table or a screen."""
    azimuth, elevation = np.radians(rng.normal(0, 60)), np.radians(rng.uniform(-35, 75))
    direction = [np.sin(azimuth) * np.cos(elevation), -np.sin(elevation), np.cos(azimuth) * np.cos(elevation)]
    color = np.exp(rng.normal(0, 0.12, 3))
    return Light(rng.uniform(0.05, 0.95), np.array(direction), color, rng.uniform(0, 0.9))


def rotation(yaw: float, pitch: float, roll: float) -> Floats:
    """The matrix of turns around y, then x, then z; radians."""
    cos_yaw, cos_pitch, cos_roll = np.cos([yaw, pitch, roll])
    sin_yaw, sin_pitch, sin_roll = np.sin([yaw, pitch, roll])
    around_y = np.array([[cos_yaw, 0, sin_yaw], [0, 1, 0], [-sin_yaw, 0, cos_yaw]])
    around_x = np.array([[1, 0, 0], [0, cos_pitch, -sin_pitch], [0, sin_pitch, cos_pitch]])
    around_z = np.array([[cos_roll, -sin_roll, 0], [sin_roll, cos_roll, 0], [0, 0, 1]])
    return np.asarray(around_z @ around_x @ around_y)


def shade(head: Head, light: Light, turn: Floats, occlusion: float) -> Floats:
    """The light that each point of a turned head sends to the viewer, linear RGB.

    occlusion: by how much each mm below the neighborhood darkens a point.
    """
    height = np.where(head.mask, head.height, 0)
    normals = _normals(height) @ turn.T
    direct = np.maximum(normals @ light.direction, 0)
    sky = 0.6 - 0.4 * normals[..., 1]
    hollow = np.maximum(_blur(height, NEAR / STEP) - height, -2)
    ambient = light.ambient * sky * np.clip(np.exp(-occlusion * hollow), 0.2, 1.15)
    sun = (1 - light.ambient) * 1.3 * direct * _shadow(height, light)
    tint = light.color ** ((1 - light.ambient) * direct[..., np.newaxis])
    return np.asarray(head.albedo * (ambient + sun)[..., np.newaxis] * tint)


def project(head: Head, colors: Floats, turn: Floats, image: Floats, scale: Floats, middle: Floats) -> None:
    """Draw a turned head on an image; what is nearer covers what is farther.

    scale: pixels per mm along x and y. middle: pixel of the point between the eyes.
    """
    points = np.stack([X, Y, head.height - PIVOT], axis=-1)[head.mask] @ turn.T
    x, y = np.rint(points[:, :2] * scale + middle - 0.5).astype(int).T
    inside = (x >= 0) & (x < image.shape[1]) & (y >= 0) & (y < image.shape[0])
    order = np.argsort(points[inside, 2], kind="stable")
    image[y[inside][order], x[inside][order]] = colors[head.mask][inside][order]


def _normals(height: Floats) -> Floats:
    y, x = (_blur(np.asarray(slope), 0.8) for slope in np.gradient(height, STEP))
    normals = np.stack([-x, -y, np.ones_like(height)], axis=-1)
    return np.asarray(normals / np.linalg.norm(normals, axis=-1, keepdims=True))


def _shadow(height: Floats, light: Light) -> Floats:
    """The share of the light that reaches each point past what stands a short way toward the light."""
    share = np.ones_like(height)
    for step in SHADOW_STEPS:
        x, y, up = light.direction * step
        shift = np.array([[1, 0, -x / STEP], [0, 1, -y / STEP]])
        there = cv2.warpAffine(height, shift, height.shape[::-1], borderMode=cv2.BORDER_REPLICATE)
        share *= 1 - light.shadow * ramp(there - height - up, 0, 4)
    return share


def _blur(values: Floats, deviation: float) -> Floats:
    return np.asarray(cv2.GaussianBlur(values, (0, 0), deviation), np.float64)
