# SPDX-License-Identifier: MIT
"""Depth pictures that the tests of the depth cue share: awkward ones, and a room with known surfaces."""

import numpy as np
import pytest
from numpy.typing import NDArray

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]

STRANGE = np.array([np.nan, 0, -0.0, -1, np.inf, -np.inf, 1e-45, 3e38], np.float32)
CAMERA = np.array([190.0, 192.0, 87.0, 70.5])
HEIGHT, WALL, PERSON = 1.6, 5.0, 2.5  # meters: of the camera, and how far ahead the others are


def _patches(height: int, width: int, seed: int) -> Depth:
    """Patches of a few pixels' size, 0.5 to 7 m away, noise on them, holes and strange numbers among them."""
    rng = np.random.default_rng(seed)
    coarse = rng.uniform(0.5, 7, (height // 6 + 2, width // 6 + 2))
    depth = coarse.repeat(6, axis=0).repeat(6, axis=1)[:height, :width]
    depth = (depth + rng.normal(0, 0.02, depth.shape)).astype(np.float32)
    strange = rng.random(depth.shape) < 0.2
    depth[strange] = rng.choice(STRANGE, depth.shape)[strange]
    return depth


PICTURES = {
    "patches": _patches(57, 83, 0),
    "padded rows": _patches(60, 200, 1)[3:50, 7:150],
    "one row": _patches(1, 300, 2),
    "one column": _patches(90, 1, 3),
    "one column of many": _patches(90, 9, 3)[:, 4:5],
    "one pixel": _patches(1, 1, 4),
    "no rows": np.empty((0, 5), np.float32),
    "no columns": np.empty((5, 0), np.float32),
    "nothing measured": np.full((9, 65), np.nan, np.float32),
    "flat": np.full((9, 64), 2.5, np.float32),
}


@pytest.fixture(params=list(PICTURES), scope="session")
def picture(request: pytest.FixtureRequest) -> Depth:
    """Depth pictures of awkward sizes: none, less than a vector, views with padded rows."""
    return PICTURES[request.param]


@pytest.fixture(scope="session")
def camera() -> Floats:
    """The room's camera, of 176x144 pixels: fx, fy, cx, cy."""
    return CAMERA


@pytest.fixture(scope="session")
def floor() -> Floats:
    """The room's floor: up and height of the camera, which looks 15 degrees down and is rolled by 3."""
    down, roll = np.radians([15, 3])
    up = [np.cos(down) * np.sin(roll), -np.cos(down) * np.cos(roll), -np.sin(down)]
    return np.array([*up, HEIGHT])


@pytest.fixture(scope="session")
def surfaces(camera: Floats, floor: Floats) -> Floats:
    """(3, H, W) depth of floor, wall and person, exact; infinite where a pixel's ray misses them."""
    v, u = np.mgrid[:144, :176]
    rays = np.stack([(u - camera[2]) / camera[0], (v - camera[3]) / camera[1], np.ones(u.shape)], axis=-1)
    up = floor[:3]
    ahead = np.array([0.0, 0.0, 1.0]) - up[2] * up
    ahead /= np.linalg.norm(ahead)
    with np.errstate(divide="ignore"):
        ground, wall, person = -HEIGHT / (rays @ up), WALL / (rays @ ahead), PERSON / (rays @ ahead)
    aside, above = person * (rays @ np.cross(up, ahead)), person * (rays @ up) + HEIGHT
    misses = (abs(aside) > 0.3) | (above < 0) | (above > 1.75)
    return np.stack([np.where(ground > 0, ground, np.inf), wall, np.where(misses, np.inf, person)])


@pytest.fixture(scope="session")
def room(surfaces: Floats) -> Depth:
    """The nearest of floor, wall and person, without noise."""
    return surfaces.min(axis=0).astype(np.float32)


@pytest.fixture(scope="session")
def noisy_room(room: Depth) -> Depth:
    """The room with noise of 1 cm, a tenth outliers between 0.5 and 6 m, a tenth not measured."""
    rng = np.random.default_rng(5)
    depth = room + rng.normal(0, 0.01, room.shape)
    kind = rng.random(room.shape)
    depth = np.where(kind < 0.1, rng.uniform(0.5, 6, room.shape), depth)
    return np.where(kind > 0.9, np.nan, depth).astype(np.float32)
