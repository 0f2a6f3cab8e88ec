# SPDX-License-Identifier: MIT
"""A human body made of ellipsoids, posed by a few joint angles; its outline and depth are exact.

Body frame: x to the person's right, y down, z forward, meters; the origin is on the floor. Lengths are those
of Drillis and Contini (1966), as shares of the height, from figure 4.1 of Winter, "Biomechanics and Motor
Control of Human Movement". Thicknesses are our own estimates.
"""

import math
from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array
from tricue.scenes.rendering.ellipsoids import Ellipsoids, OrientedEllipsoids

# As shares of the height: heights of joints, their offsets from the middle, and lengths between joints.
ANKLE, HIP, SHOULDER = 0.039, 0.530, 0.818
HIP_SIDE, SHOULDER_SIDE = 0.050, 0.112
THIGH, SHANK, UPPER_ARM, FOREARM, HAND = 0.245, 0.246, 0.186, 0.146, 0.108
# Upright trunk and head, as shares of the height: height of the center, semi-axes along x, y, z.
TRUNK_PARTS = {
    "pelvis": (0.545, 0.094, 0.080, 0.066),
    "waist": (0.630, 0.082, 0.090, 0.058),
    "chest": (0.730, 0.098, 0.105, 0.068),
    "shoulders": (0.795, 0.122, 0.036, 0.045),
    "neck": (0.855, 0.034, 0.050, 0.034),
    "head": (0.932, 0.045, 0.068, 0.056),
}
UNSCALED_PARTS = ("neck", "head")  # not scaled by the build


class Person(NamedTuple):
    """A person's measurements."""

    height: float  # meters
    build: float  # breadth and thickness relative to the average

    @classmethod
    def sample(cls, rng: np.random.Generator, shortest: float = 1.55) -> "Person":
        """A random adult between ``shortest`` and 1.95 m tall."""
        return cls(rng.uniform(shortest, 1.95), rng.uniform(0.9, 1.15))


class BodyPose(NamedTuple):
    """A pose; by default the person stands."""

    gait: float = 0.0  # phase of the stride, radians; 2 pi are two steps
    swing: float = 0.0  # amplitude of the legs' swing, radians
    crouch: float = 0.0  # 0 upright, 1 squatting
    arms: float = 0.0  # 0 hanging, 1 raised above the head


def build_body(person: Person, pose: BodyPose) -> Ellipsoids:
    """The ellipsoids of a person in a pose, in the body frame; the lowest point is on the floor, y = 0."""
    return build_oriented_body(person, pose).ellipsoids


def build_oriented_body(person: Person, pose: BodyPose) -> OrientedEllipsoids:
    """As :func:`build_body`, with the orientation of each ellipsoid; a limb's -y points to the trunk."""
    lean = 0.6 * pose.crouch + 0.06 * min(pose.swing, 1.0)
    parts = [*_trunk(person.build, lean)]
    for side in (-1.0, 1.0):
        parts += [*_leg(side, person.build, pose), *_arm(side, person.build, lean, pose)]
    centers, roots = (np.stack(arrays) * person.height for arrays in zip(*parts, strict=True))
    centers[:, 1] -= (centers[:, 1] + np.linalg.norm(roots[:, 1], axis=1)).max()
    return OrientedEllipsoids(centers, roots)


def place_body(person: Person, pose: BodyPose, x: float, z: float, yaw: float, floor: float) -> Ellipsoids:
    """A person's body at (x, floor, z) in a level frame (x right, y down, z forward, meters).

    yaw: the heading, radians: 0 along z, pi / 2 along x.
    """
    return build_body(person, pose).transformed(rotation_about_y(yaw), np.array([x, floor, z]))


def rotation_about_y(yaw: float) -> Array:
    """The rotation (3, 3) by ``yaw`` radians from z toward x."""
    return np.array([[math.cos(yaw), 0, math.sin(yaw)], [0, 1, 0], [-math.sin(yaw), 0, math.cos(yaw)]])


_Limb = tuple[Array, Array]  # a center (3,) and a root (3, 3), as shares of the height


def _trunk(build: float, lean: float) -> list[_Limb]:
    """Pelvis to head, bent forward by ``lean`` at the hip; the head bends back to look ahead."""
    parts = []
    for name, (up, *axes) in TRUNK_PARTS.items():
        breadth = 1.0 if name in UNSCALED_PARTS else build
        tilt = _tilt(lean if name not in UNSCALED_PARTS else 0.3 * lean)
        parts.append((_on_trunk(0.0, up, lean), tilt * [axes[0] * breadth, axes[1], axes[2] * breadth]))
    return parts


def _leg(side: float, build: float, pose: BodyPose) -> list[_Limb]:
    """Thigh, shank and foot of the left (-1) or right (1) leg."""
    phase = pose.gait + (math.pi if side < 0 else 0.0)
    # The knee bends most while the leg swings forward under the hip.
    knee = pose.swing * (0.15 + 1.6 * max(0.0, math.cos(phase)) ** 2) + 2.2 * pose.crouch
    forward = pose.swing * math.sin(phase) + 1.45 * pose.crouch
    hip = np.array([side * HIP_SIDE, -HIP, 0.0])
    joint = hip + THIGH * _direction(0.0, forward)
    ankle = joint + SHANK * _direction(0.0, forward - knee)
    # The sole turns with the shank, but only half as far.
    sole = _tilt(0.5 * (knee - forward)) if not pose.crouch else np.eye(3)
    foot = ankle + sole @ np.array([0.0, ANKLE - 0.022, 0.044])
    return [
        _limb(hip, joint, 0.050 * build, 0.10),
        _limb(joint, ankle, 0.033 * build, 0.10),
        (foot, sole * [0.028, 0.022, 0.076]),
    ]


def _arm(side: float, build: float, lean: float, pose: BodyPose) -> list[_Limb]:
    """Upper arm, forearm and hand; they swing opposite to the legs."""
    swing = -0.8 * pose.swing * math.sin(pose.gait + (math.pi if side < 0 else 0.0)) + 0.8 * pose.crouch
    out = 0.13 + 2.5 * pose.arms
    shoulder = _on_trunk(side * SHOULDER_SIDE * build, SHOULDER - 0.015, lean)
    elbow = shoulder + UPPER_ARM * _direction(side * out, swing)
    along = _direction(side * (out - 0.08 + 0.3 * pose.arms), swing + 0.25 + 0.5 * pose.crouch)
    wrist = elbow + FOREARM * along
    return [
        _limb(shoulder, elbow, 0.029 * build, 0.12),
        _limb(elbow, wrist, 0.023 * build, 0.12),
        _limb(wrist, wrist + 0.8 * HAND * along, 0.020, 0.10),
    ]


def _on_trunk(x: float, up: float, lean: float) -> Array:
    """A point at height ``up`` of the upright trunk, after the trunk has bent by ``lean`` at the hip."""
    bent: Array = np.array([x, -HIP, 0.0]) + _tilt(lean) @ np.array([0.0, HIP - up, 0.0])
    return bent


def _tilt(angle: float) -> Array:
    """The rotation (3, 3) about x that bends forward by ``angle`` radians."""
    return np.array(
        [[1, 0, 0], [0, math.cos(angle), math.sin(angle)], [0, -math.sin(angle), math.cos(angle)]]
    )


def _direction(out: float, forward: float) -> Array:
    """The unit vector down, rotated sideways by ``out`` (positive to the right), then by ``forward``."""
    return np.array([math.sin(out), math.cos(out) * math.cos(forward), math.cos(out) * math.sin(forward)])


def _limb(start: Array, end: Array, radius: float, over: float) -> _Limb:
    """An ellipsoid between two joints, which extends beyond each by the share ``over`` of its length."""
    length = float(np.linalg.norm(end - start))
    axis = (end - start) / length
    return (start + end) / 2, _along(axis) * [radius, length * (0.5 + over), radius]


def _along(axis: Array) -> Array:
    """The smallest rotation of y to a unit vector other than -y (Rodrigues' formula)."""
    x, y, z = axis.tolist()
    cross = np.array([[0, x, 0], [-x, 0, -z], [0, z, 0]])  # of y and the axis
    return np.asarray(np.eye(3) + cross + cross @ cross / (1 + y))
