# SPDX-License-Identifier: MIT
"""People who walk, dressed: each point of the cloth keeps its place on the limb that it covers."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.people import walks
from tricue.scenes.people.body import Person, Pose, about_y, balls
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.ellipsoids import Balls
from tricue.scenes.rendering.stereo_camera import Solid
from tricue.scenes.rendering.textures import Looks

TROUSERS, SHIRT, SLEEVE, LEG, BARE, HEAD = range(6)
# What tricue.scenes.body's parts wear, in their order, and then a coat's parts.
WORN = [TROUSERS, *[SHIRT] * 3, BARE, HEAD, *[*[LEG] * 3, SLEEVE, SLEEVE, BARE] * 2, *[SHIRT] * 3]
TRUNK, LIMB = (192, 256), 96  # texels: rows and columns on the trunk, columns on a limb
CLOTHS = (textures.PLAIN, textures.WOOD, textures.STRIPES, textures.BLOTCHES)
COAT = (
    (0.64, 0.11, 0.20, 0.095),
    (0.53, 0.115, 0.23, 0.115),
    (0.41, 0.12, 0.23, 0.137),
)  # as in tricue.scenes.people.body.TRUNK
SWING = 0.25  # radians, of the legs to each side at least; who walks slowly takes as long steps, but fewer


class Outfit(NamedTuple):
    """How somebody looks: a texture, as a pyramid, for each kind of part."""

    maps: list[list[Picture]]
    coat: bool  # whether there is a coat down to the knees

    @classmethod
    def draw(cls, contrast: float, coat: bool, rng: np.random.Generator) -> "Outfit":
        """Random looks and clothes; contrast: the deviation of the cloths' logarithmic brightness."""
        looks = Looks.draw(rng)
        shirt, trousers = (rng.uniform(0.35, 1.0) * textures.any_color(rng) + 40 for _ in range(2))
        upper, lower = (str(rng.choice(CLOTHS)) for _ in range(2))
        above, below = (
            cloth(kind, color, contrast, rng) for kind, color in ((upper, shirt), (lower, trousers))
        )
        bare = textures.skin((TRUNK[0], LIMB), looks.skin, rng)
        sleeve, leg = (np.ascontiguousarray(map_[:, :LIMB]) for map_ in (above, below))
        maps = [below, above, sleeve, leg, bare, textures.head(looks, rng)]
        return cls([textures.pyramid(map_) for map_ in maps], coat)


class Pedestrian(NamedTuple):
    """Somebody on the way through a scene: the parts of the body in each frame."""

    parts: list[Balls]  # of each frame, level frame
    maps: list[list[Picture]]  # of each part, one level

    @classmethod
    def walk(cls, person: Person, outfit: Outfit, path: Array, floor: float, rate: float) -> "Pedestrian":
        """Along a path (M, 2); the floor is at the height y = ``floor``."""
        poses = [pose._replace(swing=max(pose.swing, SWING)) for pose in walks.poses(person, path, rate)]
        return cls._cast(person, outfit, path, floor, walks.headings(path, rate), poses)

    @classmethod
    def stand(
        cls, person: Person, outfit: Outfit, place: Array, floor: float, facing: float, frames: int
    ) -> "Pedestrian":
        """At one place (2,), facing an angle (radians from z towards x)."""
        path = np.tile(place, (frames, 1))
        return cls._cast(person, outfit, path, floor, np.full(frames, facing), [Pose()] * frames)

    @classmethod
    def _cast(
        cls, person: Person, outfit: Outfit, path: Array, floor: float, facing: Array, poses: Sequence[Pose]
    ) -> "Pedestrian":
        parts = [
            _dress(balls(person, pose), person, outfit).moved(about_y(yaw), np.array([x, floor, z]))
            for (x, z), yaw, pose in zip(path.tolist(), facing.tolist(), poses, strict=True)
        ]
        return cls(parts, [outfit.maps[worn] for worn in WORN[: len(parts[0].centers)]])

    def seen_at(self, depth: float, focal: float) -> "Pedestrian":
        """The same with textures as detailed as a camera of this focal length (pixels) sees them there."""
        girths = 2 * np.pi * np.linalg.norm(self.parts[0].roots[:, :, [0, 2]], axis=1).max(axis=1)
        maps = [
            textures.at_detail(map_, map_[0].shape[1] / girth * depth / focal)
            for map_, girth in zip(self.maps, girths.tolist(), strict=True)
        ]
        return self._replace(maps=maps)

    def solids(self, index: int, to_camera: Array) -> list[Solid]:
        """What to draw in a frame, in the camera's frame."""
        centers, roots = self.parts[index].moved(to_camera, np.zeros(3))
        units = np.linalg.inv(roots)
        return [Solid(*part) for part in zip(centers, units, self.maps, strict=True)]


def cloth(kind: str, color: Array, contrast: float, rng: np.random.Generator) -> Picture:
    """One of CLOTHS for a trunk, (*TRUNK, 3), with folds and wear."""
    folds = textures.noise(*TRUNK, 1.0, rng)
    surface = textures.surface(kind, TRUNK, color, rng)
    return np.asarray(surface * np.exp(np.float32(contrast) * folds)[..., None], np.float32).clip(8, 245)


def _dress(body: Balls, person: Person, outfit: Outfit) -> Balls:
    """The body, and the coat where one is worn."""
    if not outfit.coat:
        return body
    up, *half = np.array(COAT).T * person.height
    wide = np.array([person.build, 1.0, person.build])
    centers = np.outer(-up, [0.0, 1.0, 0.0])
    roots = np.stack([np.diag(axes * wide) for axes in np.transpose(half)])
    return Balls(np.append(body.centers, centers, axis=0), np.append(body.roots, roots, axis=0))
