# SPDX-License-Identifier: MIT
"""Dressed pedestrians; each point of their clothes stays at its place on the limb."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.people import walks
from tricue.scenes.people.body import BodyPose, Person, build_oriented_body, rotation_about_y
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.ellipsoids import OrientedEllipsoids
from tricue.scenes.rendering.stereo_camera import TexturedEllipsoid
from tricue.scenes.rendering.textures import Looks

TROUSERS_TEXTURE, SHIRT_TEXTURE, SLEEVE_TEXTURE, LEG_TEXTURE, SKIN_TEXTURE, HEAD_TEXTURE = range(6)
# The texture of each part, in the order of tricue.scenes.people.body, then of a coat's parts.
PART_TEXTURES = [
    TROUSERS_TEXTURE,
    *[SHIRT_TEXTURE] * 3,
    SKIN_TEXTURE,
    HEAD_TEXTURE,
    *[*[LEG_TEXTURE] * 3, SLEEVE_TEXTURE, SLEEVE_TEXTURE, SKIN_TEXTURE] * 2,
    *[SHIRT_TEXTURE] * 3,
]
TRUNK_TEXTURE_SHAPE, LIMB_TEXTURE_COLUMNS = (
    (192, 256),
    96,
)  # texels: rows and columns of a trunk's texture, and columns of a limb's
CLOTH_KINDS = (
    textures.PLAIN_SURFACE,
    textures.WOOD_SURFACE,
    textures.STRIPED_SURFACE,
    textures.BLOTCHED_SURFACE,
)
COAT_PARTS = (
    (0.64, 0.11, 0.20, 0.095),
    (0.53, 0.115, 0.23, 0.115),
    (0.41, 0.12, 0.23, 0.137),
)  # as in tricue.scenes.people.body.TRUNK
MIN_LEG_SWING = 0.25  # radians; slow walkers make fewer steps, not shorter ones


class Outfit(NamedTuple):
    """A person's looks: a texture pyramid for each kind of body part."""

    part_textures: list[list[Picture]]
    coat: bool  # whether the person wears a coat down to the knees

    @classmethod
    def sample(cls, contrast: float, coat: bool, rng: np.random.Generator) -> "Outfit":
        """Random looks and clothes. contrast: the standard deviation of the clothes' log brightness."""
        looks = Looks.sample(rng)
        shirt, trousers = (rng.uniform(0.35, 1.0) * textures.random_color(rng) + 40 for _ in range(2))
        upper, lower = (str(rng.choice(CLOTH_KINDS)) for _ in range(2))
        above, below = (
            make_cloth(kind, color, contrast, rng) for kind, color in ((upper, shirt), (lower, trousers))
        )
        bare = textures.make_skin((TRUNK_TEXTURE_SHAPE[0], LIMB_TEXTURE_COLUMNS), looks.skin, rng)
        sleeve, leg = (np.ascontiguousarray(texture[:, :LIMB_TEXTURE_COLUMNS]) for texture in (above, below))
        part_textures = [below, above, sleeve, leg, bare, textures.make_head(looks, rng)]
        return cls([textures.build_pyramid(texture) for texture in part_textures], coat)


class Pedestrian(NamedTuple):
    """A person's body parts in each frame of a scene, in the level frame, and their textures."""

    parts: list[OrientedEllipsoids]  # of each frame
    part_textures: list[list[Picture]]  # of each part

    @classmethod
    def walk(cls, person: Person, outfit: Outfit, path: Array, floor: float, rate: float) -> "Pedestrian":
        """A person who walks along a path (M, 2), x and z in meters, on the floor y = ``floor``."""
        poses = [
            pose._replace(swing=max(pose.swing, MIN_LEG_SWING))
            for pose in walks.compute_poses(person, path, rate)
        ]
        return cls._dress_path(person, outfit, path, floor, walks.compute_headings(path, rate), poses)

    @classmethod
    def stand(
        cls, person: Person, outfit: Outfit, place: Array, floor: float, facing: float, frames: int
    ) -> "Pedestrian":
        """A person who stands at a place (2,). facing: heading, radians from z toward x."""
        path = np.tile(place, (frames, 1))
        return cls._dress_path(person, outfit, path, floor, np.full(frames, facing), [BodyPose()] * frames)

    @classmethod
    def _dress_path(
        cls,
        person: Person,
        outfit: Outfit,
        path: Array,
        floor: float,
        facing: Array,
        poses: Sequence[BodyPose],
    ) -> "Pedestrian":
        parts = [
            _dress(build_oriented_body(person, pose), person, outfit).transformed(
                rotation_about_y(yaw), np.array([x, floor, z])
            )
            for (x, z), yaw, pose in zip(path.tolist(), facing.tolist(), poses, strict=True)
        ]
        return cls(parts, [outfit.part_textures[worn] for worn in PART_TEXTURES[: len(parts[0].centers)]])

    def at_detail(self, depth: float, focal: float) -> "Pedestrian":
        """The pedestrian with the texture levels that fit a depth (meters) and a focal length (pixels)."""
        girths = 2 * np.pi * np.linalg.norm(self.parts[0].roots[:, :, [0, 2]], axis=1).max(axis=1)
        part_textures = [
            textures.select_level(texture, texture[0].shape[1] / girth * depth / focal)
            for texture, girth in zip(self.part_textures, girths.tolist(), strict=True)
        ]
        return self._replace(part_textures=part_textures)

    def ellipsoids(self, index: int, to_camera: Array, shift: Array | None = None) -> list[TexturedEllipsoid]:
        """The textured ellipsoids of a frame, in the camera's frame. shift: (3,) meters, added there."""
        moved = np.zeros(3) if shift is None else shift
        centers, roots = self.parts[index].transformed(to_camera, moved)
        units = np.linalg.inv(roots)
        return [TexturedEllipsoid(*part) for part in zip(centers, units, self.part_textures, strict=True)]


def make_cloth(kind: str, color: Array, contrast: float, rng: np.random.Generator) -> Picture:
    """A cloth (*TRUNK_TEXTURE_SHAPE, 3) with folds. kind: one of CLOTH_KINDS."""
    folds = textures.make_noise(*TRUNK_TEXTURE_SHAPE, 1.0, rng)
    surface = textures.make_surface(kind, TRUNK_TEXTURE_SHAPE, color, rng)
    return np.asarray(surface * np.exp(np.float32(contrast) * folds)[..., None], np.float32).clip(8, 245)


def _dress(body: OrientedEllipsoids, person: Person, outfit: Outfit) -> OrientedEllipsoids:
    """The body, with a coat if the outfit has one."""
    if not outfit.coat:
        return body
    up, *half = np.array(COAT_PARTS).T * person.height
    wide = np.array([person.build, 1.0, person.build])
    centers = np.outer(-up, [0.0, 1.0, 0.0])
    roots = np.stack([np.diag(axes * wide) for axes in np.transpose(half)])
    return OrientedEllipsoids(np.append(body.centers, centers, axis=0), np.append(body.roots, roots, axis=0))
