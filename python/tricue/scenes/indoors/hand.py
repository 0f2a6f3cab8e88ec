# SPDX-License-Identifier: MIT
"""A right hand with its forearm; the fingers can spread, close and bend.

Hand frame: the origin in the center of the palm, y toward the wrist, z out of the palm, so that the back of
the hand faces -z; the thumb is at -x. Lengths are our own estimates of a hand 19 cm long.
"""

from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array
from tricue.scenes.indoors.surface import Cones

SKIN_PAINT, HEAD_PAINT, SHIRT_PAINT, TROUSERS_PAINT, FINGER_PAINT, FINGERTIP_PAINT = range(6)
BLEND = 0.0035  # meters
WRIST = np.array([0.004, 0.062, 0.0])
KNUCKLES = np.array(
    [[-0.030, -0.040, 0.0], [-0.008, -0.045, -0.003], [0.013, -0.042, -0.002], [0.031, -0.033, 0.002]]
)
LENGTHS = np.array(
    [[0.043, 0.026, 0.020], [0.047, 0.030, 0.021], [0.043, 0.028, 0.021], [0.034, 0.021, 0.018]]
)
RADII = np.array([0.0098, 0.0100, 0.0094, 0.0083])  # of the fingers at the knuckles
FANNING = np.array([-0.10, -0.02, 0.06, 0.16])  # radians, the closed fingers' angles to the palm's axis
SPREADING = np.array([-0.24, -0.06, 0.14, 0.34])  # radians, added to those when the fingers are fully spread


class HandPose(NamedTuple):
    """How the fingers are held."""

    spread: float  # 0 closed, 1 spread
    bend: Array  # (5,) radians, the same at each joint of a finger; the thumb first


def build_hand(pose: HandPose, size: float = 1.0) -> Cones:
    """The hand in its own frame: palm and fingers, then wrist and forearm, the last FOREARM_PARTS cones."""
    parts: list[tuple[Array, Array, float, float, int]] = []
    for knuckle, lengths, radius, fan, spread, bend in zip(
        KNUCKLES, LENGTHS, RADII, FANNING, SPREADING, pose.bend[1:], strict=True
    ):
        base = WRIST * [1.0, 0.55, 1.0] + [0.45 * knuckle[0], 0, 0]
        parts.append((base, knuckle, 0.0150, 0.0118, SKIN_PAINT))
        parts += _finger(knuckle, fan + pose.spread * spread, bend, lengths, radius)
    thumb = np.array([-0.020, 0.038, 0.006])
    joint = np.array([-0.043 - 0.010 * pose.spread, 0.004, 0.012])
    parts.append((thumb, joint, 0.0185, 0.0125, SKIN_PAINT))
    parts += _finger(joint, -0.30 - 0.55 * pose.spread, pose.bend[0], np.array([0.034, 0.029]), 0.0115)
    parts.append(
        (np.array([0.022, 0.030, 0.004]), np.array([0.029, -0.012, 0.005]), 0.017, 0.013, SKIN_PAINT)
    )
    parts.append((WRIST * [1, 0.5, 1], WRIST + [0, 0.03, 0], 0.024, 0.0235, SKIN_PAINT))
    for side in (-0.011, 0.011):
        parts.append((WRIST + [side, 0, 0], WRIST + [1.6 * side, 0.26, 0], 0.0195, 0.032, SKIN_PAINT))
    starts, ends, first, last, paints = (np.array(each) for each in zip(*parts, strict=True))
    sides = np.tile([0.0, 0, -1], (len(parts), 1))
    axes = ends - starts
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    sides = sides - (sides * axes).sum(axis=1, keepdims=True) * axes
    sides /= np.linalg.norm(sides, axis=1, keepdims=True)
    return Cones(
        starts * size, ends * size, np.stack([first, last], axis=1) * size, sides, paints, BLEND * size
    )


FOREARM_PARTS = 3


def _finger(
    knuckle: Array, fan: float, bend: float, lengths: Array, radius: float
) -> list[tuple[Array, Array, float, float, int]]:
    """The bones of a finger, which bends toward the palm at each joint."""
    bones, start, angle = [], knuckle, 0.3 * bend
    for number, length in enumerate(lengths):
        angle += bend
        out = np.array([np.sin(fan) * np.cos(angle), -np.cos(fan) * np.cos(angle), np.sin(angle)])
        end = start + length * out
        last = number == len(lengths) - 1
        sizes = radius * np.array([1 - 0.09 * number, 0.94 - 0.09 * number - 0.08 * last])
        bones.append((start, end, *sizes.tolist(), FINGERTIP_PAINT if last else FINGER_PAINT))
        start = end
    return bones
