# SPDX-License-Identifier: MIT
"""The paths of an overtaking, as in figure 8 of Okada, Shirai and Miura (1996), section 5.

Paths are planned as image columns and depths, and projected to the floor. Lengths in the image are pixels at
a width of 160, whatever the camera's width. The events take the paper's 100 frames.
"""

import math
from typing import NamedTuple

import numpy as np

from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.people.body import Person

OVERTAKING_FRAME_RATE = 15.0  # frames per second; the paper's 100 frames take 6.7 s
STORY_FRAMES = 100  # in which all events happen
REFERENCE_WIDTH = 160  # pixels


class OvertakingPlan(NamedTuple):
    """The parameters of one scene."""

    direction: int  # of walking: 1 from left to right, -1 from right to left
    field_of_view: float  # horizontal angle of view, degrees
    pan_speed: float  # pixels per frame of the background, against the target's direction
    target_speed: float  # pixels per frame of the target in the image
    target_height: float  # pixels
    target_disparity: float  # pixels
    disparity_ratio: float  # the overtaker's disparity divided by the target's
    speed_gain: float  # pixels per frame by which the overtaker is faster
    overtaking_frame: float  # the frame in which the overtaker covers the target
    passing_frame: float  # the frame in which the target passes the standing person
    standing_depth_offset: float  # meters from target to standing person then; nearer if negative
    depth_drift: float  # relative change of the target's depth over all events
    height_ratio: float  # the overtaker's body height divided by the target's
    clothes_contrast: tuple[float, float, float]  # of target, overtaker, standing person


PLAIN_PLAN = OvertakingPlan(
    direction=-1,
    field_of_view=32.0,
    pan_speed=0.6,
    target_speed=0.85,
    target_height=74.0,
    target_disparity=5.0,
    disparity_ratio=1.75,
    speed_gain=0.95,
    overtaking_frame=34.0,
    passing_frame=74.0,
    standing_depth_offset=0.32,
    depth_drift=0.0,
    height_ratio=1.02,
    clothes_contrast=(0.25, 0.25, 0.25),
)


def sample_plan(rng: np.random.Generator) -> OvertakingPlan:
    """A random plan."""
    pan = rng.uniform(0.0, 0.9)
    low, high, sign = (0.28, 0.34, 1) if rng.random() < 0.5 else (0.36, 0.42, -1)
    return OvertakingPlan(
        direction=int(rng.choice([-1, 1])),
        field_of_view=rng.uniform(31, 35),
        pan_speed=pan,
        target_speed=float(np.clip(rng.uniform(1.35, 1.8) - pan, 0.6, 1.2)),
        target_height=rng.uniform(66, 78),
        target_disparity=rng.uniform(4.6, 5.4),
        disparity_ratio=rng.uniform(1.72, 1.85),
        speed_gain=rng.uniform(0.88, 1.02),
        overtaking_frame=rng.uniform(33, 36),
        passing_frame=rng.uniform(72, 76),
        standing_depth_offset=sign * rng.uniform(low, high),
        depth_drift=rng.uniform(-0.06, 0.06),
        height_ratio=rng.uniform(1.0, 1.06),
        clothes_contrast=(rng.uniform(0.12, 0.3), rng.uniform(0.12, 0.3), rng.uniform(0.12, 0.3)),
    )


class OvertakingPaths(NamedTuple):
    """Where the three people are, meters in the level frame."""

    pan: Pan
    target: Array  # (M, 2) x and z
    overtaker: Array  # (M, 2)
    standing: Array  # (2,)
    depths: tuple[float, float, float]  # of the three, halfway through the events


def plan_paths(
    plan: OvertakingPlan, person: Person, camera: str, frames: int, rng: np.random.Generator
) -> OvertakingPaths:
    """The paths for a plan over ``frames`` frames. person: the target."""
    width, height = map(int, camera.split("x"))
    intrinsics = Intrinsics.from_fov(width, height, plan.field_of_view)
    focal = intrinsics.fx * REFERENCE_WIDTH / width
    depth = person.height * focal / plan.target_height
    time: Array = np.arange(frames, dtype=np.float64)
    angles = plan.direction * plan.pan_speed / focal * (time - STORY_FRAMES / 2)
    pan = Pan(StereoRig(intrinsics, plan.target_disparity * depth / focal), rng.uniform(1.0, 1.12), angles)
    column = plan.direction * plan.target_speed * (time - STORY_FRAMES / 2) / focal
    gained = plan.direction * plan.speed_gain * (time - plan.overtaking_frame) / focal
    depths = depth * (1 + plan.depth_drift * (time / STORY_FRAMES - 0.5))
    # The passing time may lie between two frames; the person stands where the target is then, except in
    # depth.
    pan_at_passing = pan._replace(
        angles=np.array(
            [plan.direction * plan.pan_speed / focal * (plan.passing_frame - STORY_FRAMES / 2)], float
        )
    )
    at = (
        depth * (1 + plan.depth_drift * (plan.passing_frame / STORY_FRAMES - 0.5))
        + plan.standing_depth_offset
    )
    across = np.array([plan.direction * plan.target_speed * (plan.passing_frame - STORY_FRAMES / 2) / focal])
    return OvertakingPaths(
        pan,
        pan.on_floor(column, depths),
        pan.on_floor(column + gained, depths / plan.disparity_ratio),
        pan_at_passing.on_floor(across, np.array([at]))[0],
        (depth, depth / plan.disparity_ratio, depth + plan.standing_depth_offset),
    )


def heading_to_camera(place: Array) -> float:
    """The heading of a person at a place (2,) who looks at the cameras, radians from z toward x."""
    return math.atan2(-place[0], -place[1])
