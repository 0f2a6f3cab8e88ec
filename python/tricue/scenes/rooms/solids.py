# SPDX-License-Identifier: MIT
"""Solid things of textured faces and balls: boxes, cans, figures. World frame: x right, y down, z away."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Picture
from tricue.scenes.rendering.depth_view import MountedCamera
from tricue.scenes.rendering.ellipsoids import OrientedEllipsoids
from tricue.scenes.rendering.stereo_camera import (
    RayCamera,
    RayImage,
    TexturedEllipsoid,
    TexturedRectangle,
    WhiteLamp,
)
from tricue.scenes.rendering.textures import build_pyramid

Pyramid = Sequence[Picture]
CAN_SIDES = 14
SEAM = 1.03  # factor by which a can's sides are widened, so that no ray passes between two
LID_THICKNESS = 0.002  # meters
LIGHT_ON_FACES = np.array([1.0, 0.85, 0.75, 0.9, 0.6, 0.4])  # front, left, right, top, back, bottom


class Placement(NamedTuple):
    """A rotation (3, 3) and a translation (3,), meters."""

    rotation: Array
    offset: Array

    @classmethod
    def at(cls, offset: Array, yaw: float = 0.0, roll: float = 0.0, tilt: float = 0.0) -> "Placement":
        """Rotate by roll about z, tilt about x, then yaw about y, in radians; then move by ``offset``."""
        (cy, sy), (cr, sr), (ct, st) = ((math.cos(a), math.sin(a)) for a in (yaw, roll, tilt))
        about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
        about_x = np.array([[1, 0, 0], [0, ct, -st], [0, st, ct]])
        about_z = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
        return cls(about_y @ about_x @ about_z, np.asarray(offset, float))

    def points(self, points: Array) -> Array:
        """The transformed points (..., 3)."""
        return np.asarray(points @ self.rotation.T + self.offset)


class Solid(NamedTuple):
    """A thing made of faces, whose ``along`` x ``down`` points inward, and of textured balls."""

    faces: tuple[TexturedRectangle, ...] = ()
    balls: OrientedEllipsoids = OrientedEllipsoids(np.zeros((0, 3)), np.zeros((0, 3, 3)))
    skins: tuple[Pyramid, ...] = ()

    def __add__(self, other: object) -> "Solid":
        """Both things combined."""
        if not isinstance(other, Solid):
            return NotImplemented
        pairs = zip(self.balls, other.balls, strict=True)
        balls = OrientedEllipsoids(*(np.concatenate(arrays) for arrays in pairs))
        return Solid(self.faces + other.faces, balls, self.skins + other.skins)

    def placed(self, pose: Placement) -> "Solid":
        """The thing, transformed by a pose."""
        turn = pose.rotation
        faces = tuple(
            TexturedRectangle(pose.points(corner), turn @ along, turn @ down, texture)
            for corner, along, down, texture in self.faces
        )
        return Solid(faces, self.balls.transformed(turn, pose.offset), self.skins)

    def draw(self, camera: RayCamera, canvas: RayImage, lamp: WhiteLamp) -> None:
        """Draw the thing, given in the camera's frame, where it is nearer than what is there."""
        center = np.array([camera.offset, 0, 0])
        for face in self.faces:
            if _faces_away_from(face, center):
                camera.draw_rectangle(canvas, face)
        units = np.linalg.inv(self.balls.roots)
        balls = zip(self.balls.centers, units, self.skins, strict=True)
        camera.draw_ellipsoids(canvas, [TexturedEllipsoid(*ball) for ball in balls], lamp)

    def box(self, camera: Intrinsics) -> Array:
        """The box (4,) around the thing's image, hidden parts included; NaN if partly behind the camera."""
        sides = []
        if self.faces:
            steps = np.array([[0, 0], [1, 0], [0, 1], [1, 1]])
            corners = np.concatenate(
                [face.corner + steps @ np.stack([face.along, face.down]) for face in self.faces]
            )
            if corners[:, 2].min() <= 0:
                return np.full(4, np.nan)
            pixels = camera.project(corners) + 0.5
            sides.append(np.concatenate([pixels.min(axis=0), pixels.max(axis=0)]))
        if self.skins:
            try:
                sides += list(MountedCamera(camera, 0.0, 0.0).ellipsoid_boxes(self.balls.ellipsoids))
            except ValueError:
                return np.full(4, np.nan)
        low, high = np.min(sides, axis=0)[:2], np.max(sides, axis=0)[2:]
        return np.concatenate([low, high - low])


def _faces_away_from(face: TexturedRectangle, center: Array) -> bool:
    """Whether along x down, which points inward, points away from a camera; np.cross is much slower."""
    (ax, ay, az), (dx, dy, dz), (x, y, z) = (
        each.tolist() for each in (face.along, face.down, face.corner - center)
    )
    return bool((ay * dz - az * dy) * x + (az * dx - ax * dz) * y + (ax * dy - ay * dx) * z > 0)


def make_box(size: Array, pictures: Sequence[Picture]) -> Solid:
    """A box of this width, height and depth (3,), meters, that stands on y = 0 at the origin.

    pictures: of the front, left, right and top faces; the back and the bottom show the last.
    """
    (w, h, d), x = size.tolist(), np.eye(3)
    sides = [
        ((-w / 2, -h, -d / 2), w * x[0], h * x[1]),
        ((-w / 2, -h, d / 2), -d * x[2], h * x[1]),
        ((w / 2, -h, -d / 2), d * x[2], h * x[1]),
        ((-w / 2, -h, d / 2), w * x[0], -d * x[2]),
        ((w / 2, -h, d / 2), -w * x[0], h * x[1]),
        ((-w / 2, 0.0, -d / 2), w * x[0], d * x[2]),
    ]
    return Solid(
        tuple(
            TexturedRectangle(
                np.array(corner),
                along,
                down,
                build_pyramid(pictures[min(number, len(pictures) - 1)] * np.float32(light)),
            )
            for number, ((corner, along, down), light) in enumerate(zip(sides, LIGHT_ON_FACES, strict=True))
        )
    )


def make_can(radius: float, height: float, picture: Picture, lid: Picture, lamp: WhiteLamp) -> Solid:
    """A can, meters, that stands on y = 0 at the origin. picture: wrapped around, its middle in front."""
    edges = np.linspace(0, picture.shape[1], CAN_SIDES + 1).round().astype(int)
    half, inner = radius * math.tan(math.pi / CAN_SIDES) * SEAM, radius
    faces = []
    for number, (first, last) in enumerate(pairwise(edges.tolist())):
        angle = 2 * math.pi * ((number + 0.5) / CAN_SIDES - 0.5)  # 0 is the front
        out = np.array([math.sin(angle), 0, -math.cos(angle)])
        along = np.array([math.cos(angle), 0, math.sin(angle)])
        light = lamp.ambient + (1 - lamp.ambient) * max(float(out @ lamp.direction), 0.0)
        strip = np.ascontiguousarray(picture[:, first:last]) * np.float32(min(light + 0.15, 1.0))
        corner = inner * out - half * along - [0, height, 0]
        faces.append(
            TexturedRectangle(corner, 2 * half * along, np.array([0, height, 0.0]), build_pyramid(strip))
        )
    plate = OrientedEllipsoids(
        np.array([[0, -height, 0.0]]), np.diag([radius * 1.02, LID_THICKNESS, radius * 1.02])[None]
    )
    return Solid(tuple(faces), plate, (build_pyramid(lid),))


def make_figure(centers: Array, axes: Array, skins: Sequence[Pyramid]) -> Solid:
    """Upright balls with these centers (n, 3) and half axes (n, 3), meters."""
    return Solid((), OrientedEllipsoids(centers, axes[:, :, None] * np.eye(3)), tuple(skins))
