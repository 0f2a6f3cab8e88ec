# SPDX-License-Identifier: MIT
"""Motion of a head in front of a stereo pair, changes of the light, and a hand that hides the head."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tricue.scenes import motion
from tricue.scenes.arrays import Array
from tricue.scenes.motion import sample_sway

HEAD_FRAME_RATE = 30.0  # frames per second
WALKING_SPEEDS = 0.7, 1.4  # meters per second, on the straight parts of a path
STEP_LENGTH = 0.7  # meters per step
RAMP_FRAMES, RAMP_END_GAIN = 100, 0.5  # duration of the ramp, and the gain at its end
HAND_SLIDE_FRAMES = 6  # for the hand to come, and again to leave
HAND_START_DISTANCE = 0.6  # meters along the forearm, where the hand is outside the image


class HeadRange(NamedTuple):
    """Where the head's center may be, so that both cameras see the head."""

    near: float  # meters of depth
    far: float
    side: float  # tangent of half the horizontal angle of view
    up: float  # the same, vertical
    baseline: float  # meters


class HeadMotion(NamedTuple):
    """A head's motion over M frames. Angles are in radians; at 0 the face looks along -z, at the cameras."""

    center: Array  # (M, 3) of the head, meters, left camera's frame
    yaw: Array  # (M,)
    pitch: Array
    roll: Array
    body: Array  # the body's yaw
    gait: Array  # phase of the stride
    swing: Array  # of the legs


class HandMotion(NamedTuple):
    """A hand in front of the head, over M frames."""

    depth_ratio: float  # its depth as a share of the head's
    offset: Array  # (M,) from the line of sight to the head, meters along the forearm
    tilt: float  # of the forearm from the vertical, radians


def sample_walk(frames: int, room: HeadRange, turning: bool, rng: np.random.Generator) -> HeadMotion:
    """A smooth random walk at a speed within WALKING_SPEEDS.

    The head looks around; with ``turning`` the person also turns around completely.
    """
    time = np.arange(frames) / HEAD_FRAME_RATE
    center = _path(time, room, rng)
    turn = _turns(time, rng) if turning else np.zeros(frames)
    yaw, pitch, roll = (
        np.radians(largest) * sample_sway(time, 1.5, 4.0, rng) for largest in (12 if turning else 28, 9, 7)
    )
    step = np.hypot(*np.diff(center[:, [0, 2]], axis=0, prepend=center[:1, [0, 2]]).T)
    swing = 0.35 * np.clip(step * HEAD_FRAME_RATE / 1.2, 0, 1)
    return HeadMotion(
        center, yaw + turn, pitch, roll, 0.4 * yaw + turn, np.pi * np.cumsum(step) / STEP_LENGTH, swing
    )


def stand(frames: int, center: Array) -> HeadMotion:
    """A head at rest at ``center`` (3,), meters, looking along -z."""
    still = np.zeros(frames)
    return HeadMotion(np.tile(center, (frames, 1)), *[still] * 6)


def sample_smooth_light(frames: int, amplitude: float, rng: np.random.Generator) -> Array:
    """A gain (M,) that varies smoothly between 1 - amplitude and 1 + amplitude, reaching both."""
    curve = sample_sway(np.arange(frames) / HEAD_FRAME_RATE, 1.5, 4.0, rng)
    low, high = float(curve.min()), float(curve.max())
    share = (curve - low) / (high - low) if high > low else np.full(frames, 0.5)
    return 1 + amplitude * (2 * share - 1)


def sample_jumping_light(frames: int, amplitude: float, rng: np.random.Generator) -> Array:
    """A gain (M,) within 1 +- amplitude that starts at 1 and jumps every 10 to 20 frames."""
    return (
        motion.sample_gain_steps(frames, 1 - amplitude, 1 + amplitude, rng) if amplitude else np.ones(frames)
    )


def make_ramp_light(frames: int) -> Array:
    """A gain (M,) that falls linearly from 1 to 0.5 within the first 100 frames."""
    share: Array = np.minimum(np.arange(frames) / (RAMP_FRAMES - 1), 1)
    return 1 + share * (RAMP_END_GAIN - 1)


def sample_tint(frames: int, rng: np.random.Generator) -> Array:
    """The light's color (M, 3): a factor per channel, within a few percent of 1, that drifts slowly."""
    time = np.arange(frames) / HEAD_FRAME_RATE
    return np.exp(0.04 * np.stack([sample_sway(time, 3.0, 8.0, rng) for _ in range(3)], axis=1))


def sample_hand(frames: int, rng: np.random.Generator) -> HandMotion:
    """A hand that comes about halfway through the scene, covers the head for 10 to 16 frames, and leaves."""
    held = int(rng.integers(10, 17))
    start = max(round(frames * rng.uniform(0.32, 0.45)), 1)
    early, late = start - np.arange(frames), np.arange(frames) - (start + held - 1)
    share = np.clip(np.maximum(early, late) / HAND_SLIDE_FRAMES, 0, 1)
    return HandMotion(
        rng.uniform(0.38, 0.44), HAND_START_DISTANCE * _ease(share), np.radians(rng.uniform(-35, 35))
    )


def _path(time: Array, room: HeadRange, rng: np.random.Generator) -> Array:
    """The head's center (M, 3), meters: sums of sines in depth and sideways, at walking speed."""
    nearest = room.near + 0.35 * (room.far - room.near) * rng.random() ** 2
    farthest = room.far - 0.4 * (room.far - nearest) * rng.random() ** 2
    phases, turns = rng.uniform(0, 2 * np.pi, 4), rng.uniform(0.8, 2.0, 2) * [1.0, 2.0]

    def curve(angle: Array) -> Array:
        depth = 0.8 * np.sin(angle + phases[0]) + 0.2 * np.sin(2 * angle + phases[1])
        z = nearest + (farthest - nearest) * (1 + depth) / 2
        reach = np.maximum(room.side * z - 0.15 - room.baseline / 2, 0)
        aside = 0.7 * np.sin(turns[0] * angle + phases[2]) + 0.3 * np.sin(turns[1] * angle + phases[3])
        return np.stack([room.baseline / 2 + aside * reach, z], axis=1)

    x, z = curve(_pace(curve, time, rng.uniform(*WALKING_SPEEDS))).T
    highest = np.minimum(room.up * z - 0.17, 0.22).clip(0)
    y = highest * (0.35 * rng.uniform(-1, 1) + 0.65 * sample_sway(time, 1.2, 4.0, rng))
    return np.stack([x, y, z], axis=1)


def _pace(curve: Callable[[Array], Array], time: Array, speed: float) -> Array:
    """The curve parameters (M,) of a walker: at ``speed`` (m/s) on straight parts, slower in turns.

    Between two frames the walker moves by speed / HEAD_FRAME_RATE meters at most.
    """
    dense = np.linspace(0, 2 * np.pi, 2001)
    walked, step = [0.0], dense[1]
    angles = [0.0]
    while walked[-1] < time[-1]:
        meters = np.hypot(*np.diff(curve(angles[-1] + dense), axis=0).T) / step  # per radian
        seconds = np.hypot(meters, 0.35 * meters.max()) * step / speed
        walked += (walked[-1] + np.cumsum(seconds)).tolist()
        angles += (angles[-1] + dense[1:]).tolist()
    return np.interp(time, walked, angles)


def _turns(time: Array, rng: np.random.Generator) -> Array:
    """The yaw (M,) of a person who repeatedly turns away, pauses, and turns on or back toward the cameras."""
    moments, angles, sense = [0.0], [0.0], rng.choice([-1, 1])
    while moments[-1] <= time[-1]:
        pause, away, back, home = rng.uniform([0.3, 0.7, 0.3, 0.7], [0.6, 1.1, 0.7, 1.1]).tolist()
        full = angles[-1] + sense * 2 * np.pi if rng.random() < 0.5 else angles[-1]
        moments += (moments[-1] + np.cumsum([pause, away, back, home])).tolist()
        angles += [angles[-1], angles[-1] + sense * np.pi, angles[-1] + sense * np.pi, full]
    index = np.searchsorted(moments, time, side="right") - 1
    start, stop = np.array(moments)[index], np.array(moments)[index + 1]
    share = _ease((time - start) / (stop - start))
    knots = np.array(angles)
    return np.asarray(knots[index] + share * (knots[index + 1] - knots[index]))


def _ease(share: Array) -> Array:
    """Ease in and out: from 0 to 1, with slope 0 at both ends."""
    return share**2 * (3 - 2 * share)
