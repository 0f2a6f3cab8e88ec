# SPDX-License-Identifier: MIT
"""How people walk: paths over a floor at walking speed, headings, gestures, and poses.

Level frame, seen from above: x right, z away from the camera, meters; the camera is at the origin.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.scenes.arrays import Array
from tricue.scenes.people.body import BodyPose, Person
from tricue.scenes.rendering.depth_room import Furniture

MIN_WALKING_SPEED, MAX_WALKING_SPEED = 0.3, 1.5  # meters per second
MAX_TURN_RATE = 5.0  # radians per second, of a walker's heading
BODY_CLEARANCE = 0.5  # meters to each side of a walker
ARM_CLEARANCE = 1.1  # meters, with spread arms
SWEEP_DURATION = 6.0  # seconds after which crossing people turn around


class WalkableArea(NamedTuple):
    """Where a person can walk and is visible: ``near`` to ``far`` meters away, within the angle of view."""

    near: float
    far: float
    slope: float  # tangent of half the horizontal angle of view
    side: float  # meters to each side at most

    def reach(self, z: Array) -> Array:
        """How far to each side a walker at depth z stays visible and clear of the walls, meters."""
        return np.minimum(self.slope * z, self.side) - BODY_CLEARANCE


class Gestures(NamedTuple):
    """What a walker does besides walking, per frame (M,)."""

    crouch: Array  # 0 to 1
    arms: Array  # 0 to 1
    turn: Array  # radians added to the path's heading


def sample_gestures(frames: int, rate: float, rng: np.random.Generator) -> Gestures:
    """Random gestures, each abrupt and about a second long: crouch, raise the arms, turn on the spot."""
    time = np.arange(frames) / rate
    crouch, arms, turn = np.zeros((3, frames))
    kinds = rng.permutation(3)
    start = rng.uniform(0.3, 0.7)
    for count in range(math.ceil(frames / rate)):  # each takes at least a second
        length, rise = rng.uniform(0.8, 1.2), rng.uniform(0.2, 0.35)
        ramp = np.clip(np.minimum(time - start, start + length - time) / rise, 0, 1)
        if kinds[count % 3] == 0:
            crouch += ramp * rng.uniform(0.6, 1.0)
        elif kinds[count % 3] == 1:
            arms += ramp
        else:
            turn += rng.choice([-1, 1]) * 2 * math.pi * _smooth((time - start) / 1.3)
        start += 1.3 + rng.uniform(0.0, 0.8)
    return Gestures(crouch, arms, turn)


def sample_loop(floor: WalkableArea, crouch: Array, rate: float, rng: np.random.Generator) -> Array:
    """A random closed path (M, 2), sized so that it is walked about once.

    crouch: (M,) 0 to 1; a crouching person walks more slowly. The speed varies between MIN_WALKING_SPEED and
    MAX_WALKING_SPEED.
    """
    frames = len(crouch)
    waves = 1 + 0.25 * np.sin(2 * np.pi * (np.arange(frames) / rate / 2.3 + rng.random()))
    pace = np.clip(rng.uniform(0.8, 1.1) * waves * (1 - 0.7 * crouch), MIN_WALKING_SPEED, MAX_WALKING_SPEED)
    walked = np.concatenate([[0.0], np.cumsum(pace[1:] / rate)])
    angle = np.linspace(0, 2 * np.pi, 1441)
    shape = _loop_shape(angle, rng)
    middle = rng.uniform(-1, 1, 2)
    whole = _on_floor(floor, shape, middle, 1.0)
    size = float(np.clip(walked[-1] / _lengths(whole)[-1], 0.25, 1.0))
    curve = _on_floor(floor, shape, middle, size)
    along = _lengths(curve)
    phase = (walked + rng.random() * along[-1]) % along[-1]
    return np.stack([np.interp(phase, along, curve[:, axis]) for axis in (0, 1)], axis=1)


def _loop_shape(angle: Array, rng: np.random.Generator) -> Array:
    """A closed curve in [-1, 1] x [-1, 1], from side to side and from near to far."""
    offset, sense = rng.uniform(0, 2 * np.pi), rng.choice([-1, 1])
    return np.stack([np.sin(sense * angle), np.cos(angle + 0.3 * np.sin(angle + offset))], axis=1)


def _on_floor(floor: WalkableArea, shape: Array, middle: Array, size: float) -> Array:
    """The shape scaled to a share ``size`` of the floor, around a middle within the remaining space."""
    x, z = (size * shape + (1 - size) * middle).T
    z = (floor.near + floor.far) / 2 + (floor.far - floor.near) / 2 * z
    return np.stack([x * floor.reach(z), z], axis=1)


def _lengths(curve: Array) -> Array:
    """The arc length of a curve (n, 2) at each of its points, meters."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(curve, axis=0).T))])


def compute_sweep_times(frames: int, rate: float) -> Array:
    """The time (M,) within a sweep, from -SWEEP_DURATION / 2 to SWEEP_DURATION / 2 seconds and back.

    It is 0 halfway through a sweep. With fewer frames than a sweep takes, half of them are before 0.
    """
    half = min(SWEEP_DURATION, (frames - 1) / rate) / 2
    time = np.arange(frames) / rate
    if half == 0:
        return time
    there_and_back = time % (4 * half)
    return np.minimum(there_and_back, 4 * half - there_and_back) - half


def slow_down_time(time: Array, seconds: float, rest: float) -> Array:
    """Time (M,) that passes at the rate ``rest`` during ``seconds`` around 0, and at rate 1 elsewhere."""
    return time - (1 - rest) * np.clip(time, -seconds / 2, seconds / 2)


def compute_headings(path: Array, rate: float, looks: NDArray[np.bool_] | None = None) -> Array:
    """The headings (M,) along a path (M, 2), radians from z toward x, with a turn rate up to MAX_TURN_RATE.

    looks: (M,) whether the walker faces the camera instead.
    """
    if len(path) < 2:
        return np.zeros(len(path))
    steps = np.diff(path, axis=0, append=2 * path[-1:] - path[-2:-1])
    ahead, back = np.arctan2(*steps.T), np.arctan2(*-path.T)
    wanted = ahead if looks is None else np.where(looks, back, ahead)
    faced = [float(wanted[0])]
    for angle in wanted[1:].tolist():
        short = math.remainder(angle - faced[-1], 2 * math.pi)
        faced.append(faced[-1] + float(np.clip(short, -MAX_TURN_RATE / rate, MAX_TURN_RATE / rate)))
    return np.array(faced)


def compute_poses(
    person: Person, path: Array, rate: float, gestures: Gestures | None = None
) -> list[BodyPose]:
    """The pose at each point of a path; the legs swing with the speed, two steps span 0.8 body heights."""
    steps = np.hypot(*np.diff(path, axis=0, prepend=path[:1]).T)
    if len(steps) > 1:
        steps[0] = steps[1]
    gait = np.cumsum(steps) / (0.8 * person.height) * 2 * np.pi
    swing = np.minimum(0.4 * steps * rate, 0.5)
    crouch, arms = (gestures.crouch, gestures.arms) if gestures else np.zeros((2, len(path)))
    rows = np.stack([gait, swing * (1 - 0.8 * crouch), crouch, arms], axis=1)
    return [BodyPose(*row) for row in rows.tolist()]


def place_furniture(
    count: int, wall: float, side: float, paths: Array, rng: np.random.Generator
) -> tuple[Furniture, ...]:
    """Up to ``count`` random boxes, neither on the paths (n, 2) nor between them and the camera."""
    pieces = []
    for _ in range(count):
        width, depth, height = rng.uniform([0.4, 0.3, 0.4], [1.4, 0.7, 1.9]).tolist()
        x, z = rng.uniform([-side, 2.0], [side, wall]).tolist()
        if _distance_to_sight_lines((x, z), paths) > ARM_CLEARANCE + math.hypot(width, depth) / 2:
            pieces.append(Furniture(x, z, width, depth, height, rng.uniform(0, math.pi)))
    return tuple(pieces)


def _distance_to_sight_lines(place: tuple[float, float], paths: Array) -> float:
    """The distance of a place from the nearest line between the camera and a path's point, meters."""
    share = np.clip((paths @ place) / (paths**2).sum(axis=1), 0, 1)
    return float(np.hypot(*(share[:, None] * paths - place).T).min())


def _smooth(share: Array) -> Array:
    """Smoothstep: 0 below 0, 1 above 1, and a smooth rise between."""
    share = np.clip(share, 0, 1)
    return share * share * (3 - 2 * share)
