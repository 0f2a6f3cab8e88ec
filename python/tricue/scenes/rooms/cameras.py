# SPDX-License-Identifier: MIT
"""The camera's pose in each frame of a room: on a stand, or handheld."""

import math
from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array
from tricue.scenes.motion import sample_sway
from tricue.scenes.rooms.solids import Placement

DOWN = np.array([0.0, 1, 0])
TREMBLE = 0.004  # radians, of a handheld camera


class Viewpoint(NamedTuple):
    """A camera that looks at a point (3,) from a distance in meters. azimuth, pitch (downward): radians."""

    look_at: Array
    distance: float
    azimuth: float
    pitch: float

    def pose(self) -> Placement:
        """The pose that transforms the world into the camera's frame."""
        level = self.distance * math.cos(self.pitch)
        away = np.array([level * math.sin(self.azimuth), self.distance * math.sin(self.pitch), 0])
        away[2] = level * math.cos(self.azimuth)
        forward = away / np.linalg.norm(away)
        right = np.cross(DOWN, forward)
        right /= np.linalg.norm(right)
        rotation = np.stack([right, np.cross(forward, right), forward])
        return Placement(rotation, -rotation @ (self.look_at - away))


def stand(view: Viewpoint, frames: int) -> list[Placement]:
    """The poses of a camera on a stand."""
    return [view.pose()] * frames


def hold(view: Viewpoint, frames: int, rate: float, rng: np.random.Generator) -> list[Placement]:
    """The poses of a handheld camera, which moves about, nearer and farther, and around."""
    time = np.arange(frames) / rate
    around, up, near, *aside = (sample_sway(time, 2.0, 6.0, rng) for _ in range(6))
    reach = rng.uniform([0.1, 0.03, 0.1], [0.4, 0.12, 0.3])
    wander = 0.08 * view.distance * np.stack(aside, axis=1)
    poses = []
    for index in range(frames):
        moved = Viewpoint(
            view.look_at + wander[index],
            view.distance * float(np.exp(reach[2] * (near[index] - near[0]))),
            view.azimuth + reach[0] * float(around[index]),
            view.pitch + reach[1] * float(up[index]),
        )
        poses.append(moved.pose())
    shakes = TREMBLE * np.stack([sample_sway(time, 0.2, 0.6, rng) for _ in range(3)], axis=1)
    return [_turned(pose, shake) for pose, shake in zip(poses, shakes, strict=True)]


def _turned(pose: Placement, angles: Array) -> Placement:
    yaw, tilt, roll = angles.tolist()
    turn = Placement.at(np.zeros(3), yaw, roll, tilt).rotation
    return Placement(turn @ pose.rotation, turn @ pose.offset)
