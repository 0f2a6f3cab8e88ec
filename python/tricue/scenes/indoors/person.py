# SPDX-License-Identifier: MIT
"""Head, neck, trunk and arms of a person in front of the camera.

Head frame: the origin in the center of the head, x to the person's left, y down, z out of the face. Lengths
are our own estimates of an adult.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tricue.scenes.arrays import Array
from tricue.scenes.indoors.hand import HEAD_PAINT, SHIRT_PAINT, SKIN_PAINT, TROUSERS_PAINT
from tricue.scenes.indoors.surface import Cones

BLEND = 0.007  # meters
SHOULDERS = np.array([0.0, 0.222, 0.035])  # meters from a head that faces the camera

_Part = tuple[ArrayLike, ArrayLike, float, float]  # start, end, and the radius at each; meters

_HEAD: list[_Part] = [  # start, end, radii
    ((0, -0.026, -0.034), (0, -0.030, 0.006), 0.072, 0.069),
    ((0, -0.005, 0.010), (0, 0.052, 0.022), 0.063, 0.045),
    ((-0.012, 0.078, 0.040), (0.012, 0.078, 0.040), 0.025, 0.025),
    ((-0.036, 0.030, 0.036), (-0.024, 0.060, 0.036), 0.032, 0.027),
    ((0.036, 0.030, 0.036), (0.024, 0.060, 0.036), 0.032, 0.027),
    ((0, -0.004, 0.070), (0, 0.028, 0.085), 0.007, 0.010),
    ((-0.009, 0.030, 0.077), (0.009, 0.030, 0.077), 0.007, 0.007),
    ((-0.032, -0.014, 0.062), (0.032, -0.014, 0.062), 0.012, 0.012),
    ((-0.014, 0.055, 0.070), (0.014, 0.055, 0.070), 0.008, 0.008),
    ((-0.074, -0.012, -0.012), (-0.069, 0.024, -0.002), 0.011, 0.008),
    ((0.074, -0.012, -0.012), (0.069, 0.024, -0.002), 0.011, 0.008),
]
_TRUNK: list[_Part] = [  # relative to the middle of the shoulders
    ((-0.060, -0.055, 0.0), (-0.150, 0.005, 0.0), 0.042, 0.056),
    ((0.060, -0.055, 0.0), (0.150, 0.005, 0.0), 0.042, 0.056),
    ((-0.075, 0.060, 0.015), (-0.065, 0.420, 0.015), 0.095, 0.085),
    ((0.075, 0.060, 0.015), (0.065, 0.420, 0.015), 0.095, 0.085),
    ((0, 0.050, 0.005), (0, 0.420, 0.010), 0.098, 0.090),
]
_LEGS: list[_Part] = [
    ((-0.075, 0.470, 0.015), (0.075, 0.470, 0.015), 0.105, 0.105),
    ((-0.090, 0.520, 0.010), (-0.105, 0.900, -0.02), 0.088, 0.060),
    ((0.090, 0.520, 0.010), (0.105, 0.900, -0.02), 0.088, 0.060),
]


def turned(yaw: float, pitch: float = 0.0, roll: float = 0.0) -> Array:
    """The rotation (3, 3) from a head frame; at angles of 0 (radians) the face looks at the camera."""
    (cy, sy), (cp, sp), (cr, sr) = ((np.cos(angle), np.sin(angle)) for angle in (yaw + np.pi, pitch, roll))
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
    about_z = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x)


class UpperBodyPose(NamedTuple):
    """A person's pose in a frame."""

    head: Array  # (3,) its center, meters
    rotation: Array  # (3, 3) from the head frame
    shoulders: Array  # (3,) their middle, meters
    arms: tuple[float, float]  # radians, by which each arm is raised, in the image plane


def build_person(pose: UpperBodyPose, size: float = 1.0) -> tuple[Cones, int]:
    """The person's cones, and how many of the first ones are the head."""
    head = _cones(_HEAD, np.zeros(3), HEAD_PAINT, size).moved(pose.rotation, pose.head)
    nape = pose.head + pose.rotation @ (np.array([0, 0.05, -0.025]) * size)
    throat = pose.shoulders + np.array([0, -0.05, 0.005]) * size
    neck: list[_Part] = [(nape, throat, 0.050 * size, 0.056 * size)]
    body = head | _cones(neck, np.zeros(3), SKIN_PAINT, 1.0)
    body = body | _cones(_TRUNK, pose.shoulders, SHIRT_PAINT, size)
    body = body | _cones(_LEGS, pose.shoulders, TROUSERS_PAINT, size)
    for side, angle in zip((-1.0, 1.0), pose.arms, strict=True):
        body = body | _arm(side, angle, pose.shoulders, size)
    return body, len(_HEAD)


def _arm(side: float, angle: float, shoulders: Array, size: float) -> Cones:
    """Sleeve, forearm and fist; the elbow bends with the arm."""
    shoulder = np.array([0.178 * side, 0.020, 0.0])
    elbow = shoulder + 0.27 * np.array([side * np.sin(0.12 + angle), np.cos(0.12 + angle), 0.0])
    lower = 0.05 + 1.5 * angle
    wrist = elbow + 0.24 * np.array([side * np.sin(lower), np.cos(lower), -0.25])
    fist = wrist + 0.07 * np.array([side * np.sin(lower), np.cos(lower), -0.1])
    sleeve = _cones([(shoulder, elbow, 0.052, 0.043)], shoulders, SHIRT_PAINT, size)
    bare: list[_Part] = [(elbow, wrist, 0.040, 0.029), (wrist, fist, 0.032, 0.040)]
    return sleeve | _cones(bare, shoulders, SKIN_PAINT, size)


def _cones(parts: Sequence[_Part], origin: Array, paint: int, size: float) -> Cones:
    first, last, *radii = zip(*parts, strict=True)
    starts, ends = (np.array(points, float) * size + origin for points in (first, last))
    axes = ends - starts
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    ahead = np.where(np.abs(axes[:, 2:]) < 0.9, [[0.0, 0, -1]], [[0.0, -1, 0]])
    sides = ahead - (ahead * axes).sum(axis=1, keepdims=True) * axes
    sides /= np.linalg.norm(sides, axis=1, keepdims=True)
    return Cones(
        starts, ends, np.array(radii, float).T * size, sides, np.full(len(parts), paint), BLEND * size
    )
