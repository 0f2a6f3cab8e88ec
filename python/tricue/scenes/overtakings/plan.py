# SPDX-License-Identifier: MIT
"""Who walks where when somebody is overtaken: figure 8 of Okada, Shirai and Miura (1996), section 5.

Ways are drawn as columns and depths in the picture, and laid on the floor. Lengths in the picture are pixels
of an image 160 pixels wide, whatever the camera, and the story's 100 frames are those of the paper.
"""

import math
from typing import NamedTuple

import numpy as np

from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.people.body import Person

RATE = 15.0  # frames a second: 100 in the paper's 6.7 s
STORY = 100  # frames
WIDTH = 160  # pixels


class Plan(NamedTuple):
    """The numbers that make one scene."""

    sense: int  # -1: from right to left
    field: float  # the horizontal angle of view, degrees
    pan: float  # pixels a frame by which the background moves, against the target
    speed: float  # pixels a frame of the target in the picture
    tall: float  # the target's height in the picture, pixels
    disparity: float  # the target's, pixels
    nearer: float  # the overtaker's disparity over the target's
    faster: float  # pixels a frame that the overtaker gains on the target
    met: float  # the frame in which one is behind the other
    passed: float  # the frame in which the target passes who stands
    apart: float  # metres that who stands is farther away than the target then; below 0 nearer
    drift: float  # by which share the target's depth changes over the story
    taller: float  # the overtaker's height over the target's, metres over metres
    contrast: tuple[float, float, float]  # of each one's clothes


PLAIN = Plan(
    sense=-1,
    field=32.0,
    pan=0.6,
    speed=0.85,
    tall=74.0,
    disparity=5.0,
    nearer=1.75,
    faster=0.95,
    met=34.0,
    passed=74.0,
    apart=0.32,
    drift=0.0,
    taller=1.02,
    contrast=(0.25, 0.25, 0.25),
)


def varied(rng: np.random.Generator) -> Plan:
    """A random plan."""
    pan = rng.uniform(0.0, 0.9)
    low, high, sign = (0.28, 0.34, 1) if rng.random() < 0.5 else (0.36, 0.42, -1)
    return Plan(
        sense=int(rng.choice([-1, 1])),
        field=rng.uniform(31, 35),
        pan=pan,
        speed=float(np.clip(rng.uniform(1.35, 1.8) - pan, 0.6, 1.2)),
        tall=rng.uniform(66, 78),
        disparity=rng.uniform(4.6, 5.4),
        nearer=rng.uniform(1.72, 1.85),
        faster=rng.uniform(0.88, 1.02),
        met=rng.uniform(33, 36),
        passed=rng.uniform(72, 76),
        apart=sign * rng.uniform(low, high),
        drift=rng.uniform(-0.06, 0.06),
        taller=rng.uniform(1.0, 1.06),
        contrast=(rng.uniform(0.12, 0.3), rng.uniform(0.12, 0.3), rng.uniform(0.12, 0.3)),
    )


class Ways(NamedTuple):
    """Where everybody is, level frame."""

    pan: Pan
    target: Array  # (M, 2) x and z, metres
    overtaker: Array  # (M, 2)
    standing: Array  # (2,)
    depths: tuple[float, float, float]  # of the three, metres, in the middle of the story


def lay(plan: Plan, person: Person, camera: str, frames: int, rng: np.random.Generator) -> Ways:
    """The ways for ``frames`` frames of a target of this height."""
    width, height = map(int, camera.split("x"))
    intrinsics = Intrinsics.from_fov(width, height, plan.field)
    focal = intrinsics.fx * WIDTH / width
    depth = person.height * focal / plan.tall
    time: Array = np.arange(frames, dtype=np.float64)
    angles = plan.sense * plan.pan / focal * (time - STORY / 2)
    pan = Pan(StereoRig(intrinsics, plan.disparity * depth / focal), rng.uniform(1.0, 1.12), angles)
    column = plan.sense * plan.speed * (time - STORY / 2) / focal
    gained = plan.sense * plan.faster * (time - plan.met) / focal
    depths = depth * (1 + plan.drift * (time / STORY - 0.5))
    # At a frame between two: where the target would be, and there somebody stands a bit farther or nearer.
    there = pan._replace(angles=np.array([plan.sense * plan.pan / focal * (plan.passed - STORY / 2)], float))
    at = depth * (1 + plan.drift * (plan.passed / STORY - 0.5)) + plan.apart
    across = np.array([plan.sense * plan.speed * (plan.passed - STORY / 2) / focal])
    return Ways(
        pan,
        pan.on_floor(column, depths),
        pan.on_floor(column + gained, depths / plan.nearer),
        there.on_floor(across, np.array([at]))[0],
        (depth, depth / plan.nearer, depth + plan.apart),
    )


def facing_camera(place: Array) -> float:
    """The angle at which somebody at a place (2,) looks at the cameras, radians from z towards x."""
    return math.atan2(-place[0], -place[1])
