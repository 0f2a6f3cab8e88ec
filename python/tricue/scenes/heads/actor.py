# SPDX-License-Identifier: MIT
"""A person in front of a stereo pair: head, face, hair, dressed body, and a hand that may hide the head."""

from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.heads.moves import HandMotion, HeadMotion
from tricue.scenes.people.body import BodyPose, Person, build_body
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.ellipsoids import Ellipsoids
from tricue.scenes.rendering.stereo_camera import TexturedEllipsoid
from tricue.scenes.rendering.textures import Looks

# Meters, along x, y, z, of head and hair of a person 1.75 m tall. A bare head is about 15 by 22 by 19 cm.
HEAD_SEMI_AXES = np.array([0.084, 0.108, 0.095])
TROUSERS_INDEX, SHIRT_INDEX, SKIN_INDEX = range(3)
# The texture of each ellipsoid, in the order of tricue.scenes.people.body; the head, at 5, has its own.
BODY_PART_TEXTURES = [
    TROUSERS_INDEX,
    *[SHIRT_INDEX] * 3,
    SKIN_INDEX,
    SKIN_INDEX,
    *[*[TROUSERS_INDEX] * 3, SHIRT_INDEX, SHIRT_INDEX, SKIN_INDEX] * 2,
]
HEAD_PART = 5


class PosedActor(NamedTuple):
    """A person in one frame: the textured ellipsoids of head, body and hand."""

    head: TexturedEllipsoid
    body: list[TexturedEllipsoid]
    hand: list[TexturedEllipsoid]
    facing: float  # radians between the face's direction and the line of sight to the camera


class Actor(NamedTuple):
    """A person with a face, clothes, and a motion."""

    person: Person
    looks: Looks
    semi_axes: Array  # (3,) of the head, meters
    face: list[Picture]  # texture pyramid of the head
    body_textures: list[list[Picture]]  # texture pyramids: trousers, shirt, skin
    moves: HeadMotion
    hand: HandMotion | None

    @classmethod
    def sample(cls, moves: HeadMotion, hand: HandMotion | None, rng: np.random.Generator) -> "Actor":
        """A random person with this motion."""
        person, looks = Person.sample(rng), Looks.sample(rng)
        semi_axes = HEAD_SEMI_AXES * (person.height / 1.75) ** 0.5 * rng.uniform(0.96, 1.04, 3)
        cloths = [
            textures.make_surface(
                str(rng.choice(textures.SURFACE_KINDS[:4])), (128, 256), textures.random_color(rng), rng
            )
            for _ in range(2)
        ]
        body_textures = [
            textures.build_pyramid(texture)
            for texture in (*cloths, textures.make_skin((128, 256), looks.skin, rng))
        ]
        return cls(
            person,
            looks,
            semi_axes,
            textures.build_pyramid(textures.make_head(looks, rng)),
            body_textures,
            moves,
            hand,
        )

    @property
    def floor(self) -> float:
        """The floor's height y below the camera, meters."""
        head_height = -build_body(self.person, BodyPose()).centers[HEAD_PART, 1]
        return float(np.median(self.moves.center[:, 1]) + head_height)

    def pose_at(self, index: int) -> PosedActor:
        """The person in a frame, in the left camera's frame."""
        moves = self.moves
        center = moves.center[index]
        rotation = _rotation(moves.yaw[index], moves.pitch[index], moves.roll[index])
        head = TexturedEllipsoid(center, rotation.T / self.semi_axes[:, None], self.face)
        bodies = build_body(self.person, BodyPose(moves.gait[index], moves.swing[index]))
        dressed = _dress(bodies, _rotation(moves.body[index], 0, 0), center, self.body_textures)
        hand = (
            [] if self.hand is None else _place_hand(self.hand, index, center, self.body_textures[SKIN_INDEX])
        )
        toward = -center / np.linalg.norm(center)
        facing = float(np.arccos(np.clip(rotation[:, 2] @ toward, -1, 1)))
        return PosedActor(head, dressed, hand, facing)


def _rotation(yaw: float, pitch: float, roll: float) -> Array:
    """The rotation (3, 3) from the head's or body's frame (y down, z forward) to the camera's.

    Angles in radians; at yaw 0 the face looks at the cameras.
    """
    (cy, sy), (cp, sp), (cr, sr) = ((np.cos(angle), np.sin(angle)) for angle in (yaw + np.pi, pitch, roll))
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
    about_z = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    return np.asarray(about_y @ about_x @ about_z)


def _dress(
    bodies: Ellipsoids, rotation: Array, head_center: Array, body_textures: list[list[Picture]]
) -> list[TexturedEllipsoid]:
    """The textured ellipsoids of a body without its head, placed so that the head is at ``head_center``."""
    values, vectors = np.linalg.eigh(bodies.shapes)
    # The symmetric square root keeps each texture in place on the body.
    units = vectors @ (vectors.transpose(0, 2, 1) / np.sqrt(values)[:, :, None]) @ rotation.T
    centers = (bodies.centers - bodies.centers[HEAD_PART]) @ rotation.T + head_center
    return [
        TexturedEllipsoid(centers[i], units[i], body_textures[material])
        for i, material in enumerate(BODY_PART_TEXTURES)
        if i != HEAD_PART
    ]


def _place_hand(
    hand: HandMotion, index: int, head_center: Array, skin: list[Picture]
) -> list[TexturedEllipsoid]:
    """Palm, thumb and forearm, at the hand's offset along the forearm from the line of sight to the head."""
    forearm = np.array([np.sin(hand.tilt), np.cos(hand.tilt), 0.0])
    beside = np.array([forearm[1], -forearm[0], 0.0])
    rotation = np.stack([beside, forearm, [0, 0, 1.0]])
    palm = hand.depth_ratio * head_center + hand.offset[index] * forearm
    parts = [
        (palm, [0.064, 0.105, 0.025]),
        (palm + 0.055 * beside + 0.02 * forearm, [0.022, 0.055, 0.018]),
        (palm + 0.24 * forearm, [0.042, 0.19, 0.042]),
    ]
    return [
        TexturedEllipsoid(center, rotation / np.array(semi_axes)[:, None], skin)
        for center, semi_axes in parts
    ]
