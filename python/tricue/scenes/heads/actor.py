# SPDX-License-Identifier: MIT
"""Somebody before a stereo pair: a head with face and hair on a dressed body, and a hand that may hide it."""

from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.heads.moves import HandMotion, HeadMotion
from tricue.scenes.people.body import BodyPose, Person, build_body
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.ellipsoids import Ellipsoids
from tricue.scenes.rendering.stereo_camera import TexturedEllipsoid
from tricue.scenes.rendering.textures import Looks

# Half the breadth, height and depth, metres, of head and hair of a person 1.75 m tall. A bare head is some
# 15 by 22 by 19 cm.
HEAD_SEMI_AXES = np.array([0.084, 0.108, 0.095])
TROUSERS_INDEX, SHIRT_INDEX, SKIN_INDEX = range(3)
# What tricue.scenes.body's ellipsoids wear, in their order; the head, at 5, is drawn by itself.
BODY_PART_TEXTURES = [
    TROUSERS_INDEX,
    *[SHIRT_INDEX] * 3,
    SKIN_INDEX,
    SKIN_INDEX,
    *[*[TROUSERS_INDEX] * 3, SHIRT_INDEX, SHIRT_INDEX, SKIN_INDEX] * 2,
]
HEAD_PART = 5


class PosedActor(NamedTuple):
    """The head and all else that moves, in one frame."""

    head: TexturedEllipsoid
    body: list[TexturedEllipsoid]
    hand: list[TexturedEllipsoid]
    facing: float


class Actor(NamedTuple):
    """Somebody with a face, clothes and a way to go."""

    person: Person
    looks: Looks
    half: Array  # (3,) the head's half axes, metres
    face: list[Picture]
    worn: list[list[Picture]]  # trousers, shirt, skin
    moves: HeadMotion
    hand: HandMotion | None

    @classmethod
    def sample(cls, moves: HeadMotion, hand: HandMotion | None, rng: np.random.Generator) -> "Actor":
        """A random person who moves so."""
        person, looks = Person.sample(rng), Looks.sample(rng)
        half = HEAD_SEMI_AXES * (person.height / 1.75) ** 0.5 * rng.uniform(0.96, 1.04, 3)
        cloths = [
            textures.make_surface(
                str(rng.choice(textures.SURFACE_KINDS[:4])), (128, 256), textures.random_color(rng), rng
            )
            for _ in range(2)
        ]
        worn = [
            textures.build_pyramid(map_)
            for map_ in (*cloths, textures.make_skin((128, 256), looks.skin, rng))
        ]
        return cls(
            person, looks, half, textures.build_pyramid(textures.make_head(looks, rng)), worn, moves, hand
        )

    @property
    def floor(self) -> float:
        """How far below the camera the floor is, metres."""
        lift = -build_body(self.person, BodyPose()).centers[HEAD_PART, 1]
        return float(np.median(self.moves.center[:, 1]) + lift)

    def pose_at(self, index: int) -> PosedActor:
        """The person in one frame."""
        moves = self.moves
        center = moves.center[index]
        turned = _rotation(moves.yaw[index], moves.pitch[index], moves.roll[index])
        head_ = TexturedEllipsoid(center, turned.T / self.half[:, None], self.face)
        bodies = build_body(self.person, BodyPose(moves.gait[index], moves.swing[index]))
        dressed = _dress(bodies, _rotation(moves.body[index], 0, 0), center, self.worn)
        hand = [] if self.hand is None else _reach_out(self.hand, index, center, self.worn[SKIN_INDEX])
        toward = -center / np.linalg.norm(center)
        facing = float(np.arccos(np.clip(turned[:, 2] @ toward, -1, 1)))
        return PosedActor(head_, dressed, hand, facing)


def _rotation(yaw: float, pitch: float, roll: float) -> Array:
    """Head or body frame (y down, z where the face looks) to the camera's; at 0 it looks at the pair."""
    (cy, sy), (cp, sp), (cr, sr) = ((np.cos(angle), np.sin(angle)) for angle in (yaw + np.pi, pitch, roll))
    rotation_about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
    about_z = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    return np.asarray(rotation_about_y @ about_x @ about_z)


def _dress(
    bodies: Ellipsoids, turn: Array, head_: Array, worn: list[list[Picture]]
) -> list[TexturedEllipsoid]:
    """A body's ellipsoids but its head, whose centre is at ``head_``, with their textures."""
    values, vectors = np.linalg.eigh(bodies.shapes)
    # The symmetric root turns with the body, but not within it, so that the textures stay in place.
    units = vectors @ (vectors.transpose(0, 2, 1) / np.sqrt(values)[:, :, None]) @ turn.T
    centers = (bodies.centers - bodies.centers[HEAD_PART]) @ turn.T + head_
    return [
        TexturedEllipsoid(centers[i], units[i], worn[material])
        for i, material in enumerate(BODY_PART_TEXTURES)
        if i != HEAD_PART
    ]


def _reach_out(hand: HandMotion, index: int, head_: Array, skin: list[Picture]) -> list[TexturedEllipsoid]:
    """Palm, thumb and forearm on the line of sight to the head, or ``away`` from it."""
    forearm = np.array([np.sin(hand.tilt), np.cos(hand.tilt), 0.0])
    beside = np.array([forearm[1], -forearm[0], 0.0])
    turn = np.stack([beside, forearm, [0, 0, 1.0]])
    palm = hand.share * head_ + hand.away[index] * forearm
    parts = [
        (palm, [0.064, 0.105, 0.025]),
        (palm + 0.055 * beside + 0.02 * forearm, [0.022, 0.055, 0.018]),
        (palm + 0.24 * forearm, [0.042, 0.19, 0.042]),
    ]
    return [TexturedEllipsoid(center, turn / np.array(half)[:, None], skin) for center, half in parts]
