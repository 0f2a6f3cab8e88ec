# SPDX-License-Identifier: MIT
"""The appearance of things in a stress scene: the target, its look-alikes, the occluder, the room.

Targets and walls are cut from different photographs of scikit-image; the occluder and the furniture have the
textures of :mod:`tricue.scenes.rendering.textures`.
"""

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from tricue import imgproc
from tricue.arrays import Image
from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array
from tricue.scenes.rendering import photographs, textures
from tricue.scenes.stress.cards import (
    Card,
    CardCamera,
    CardImage,
    CardPose,
    face_camera,
    rectangle_outline,
    superellipse,
)

TARGET_PHOTOGRAPHS = ("astronaut", "coffee", "cat", "motorcycle", "immunohistochemistry", "rocket")
WALL_PHOTOGRAPHS = ("astronaut", "coffee", "cat", "motorcycle", "immunohistochemistry")
TARGET_TEXELS = 144  # of a target's longer side
SHUFFLE_BLOCKS = 4  # along each side, shuffled to make the look-alike of the target's colors
FLOOR_HEIGHT = 1.6  # meters below the camera, so that the target stays above the floor
WALL_DISTANCES = 4.7, 6.0  # meters to the back wall
MAX_WINDOW_TRIES = 24
MIN_TARGET_CONTRAST, MIN_TARGET_DETAIL, MIN_WALL_DISTANCE = 28.0, 7.0, 0.6


class StressCards(NamedTuple):
    """The moving cards. All have the target's size in meters except the occluder, which is 1 by 1."""

    target: Card
    same_colors: Card  # the target's colors in another structure
    same_structure: Card  # the target's structure in other colors
    occluder: Card
    photograph: str  # from which the target is cut


class StressRoom(NamedTuple):
    """Wall, floor and furniture, far cards first, in the frame of a camera that looks straight ahead."""

    cards: tuple[tuple[Card, CardPose], ...]

    def draw(self, camera: CardCamera, canvas: CardImage, rotation: Array) -> None:
        """Draw the room, rotated (3, 3) about the left camera."""
        for card, pose in self.cards:
            camera.draw(canvas, card, pose.rotated(rotation))


def make_cards(side: float, wall: str, rng: np.random.Generator) -> StressCards:
    """A random target, its look-alikes and the occluder.

    side: of the target, meters, approximately. wall: the wall's photograph; the target is from another one.
    """
    aspect = float(np.exp(rng.uniform(np.log(0.6), np.log(1.6))))
    size = side * aspect**0.5, side / aspect**0.5
    picture, source = _sample_window(aspect, wall, rng)
    outline = [rectangle_outline(), superellipse(2.0), superellipse(4.0)][rng.integers(3)]
    cloth = textures.make_surface(textures.STRIPED_SURFACE, (128, 96), textures.random_color(rng), rng)
    return StressCards(
        Card.from_outline(picture, outline, size),
        Card.from_outline(_shuffle_blocks(picture, rng), outline, size),
        Card.from_outline(_recolor(picture, rng), outline, size),
        Card.from_outline(cloth, superellipse(6.0), (1.0, 1.0)),
        source,
    )


def furnish_stress_room(camera: Intrinsics, wall: str, rng: np.random.Generator) -> StressRoom:
    """A random room: a wall with a photograph, a floor, and three to five boards in front of the wall."""
    far = rng.uniform(*WALL_DISTANCES)
    boards = [_board(far, rng) for _ in range(int(rng.integers(3, 6)))]
    boards.sort(key=lambda board: -float(board[1].center[2]))
    return StressRoom((_wall(camera, wall, far, rng), _floor(far, rng), *boards))


def choose_other(names: tuple[str, ...], taken: tuple[str, ...], rng: np.random.Generator) -> str:
    """A random one of the names that aren't taken."""
    left = [name for name in names if name not in taken]
    return left[rng.integers(len(left))]


def _sample_window(aspect: float, wall: str, rng: np.random.Generator) -> tuple[Image, str]:
    """A random part of a photograph, and the photograph's name.

    It is the first of MAX_WINDOW_TRIES with contrast, detail, and colors unlike the wall's; else the last.
    """
    load = cache(photographs.load_photograph)
    behind = _histogram(load(wall))
    for _ in range(MAX_WINDOW_TRIES):
        name = choose_other(TARGET_PHOTOGRAPHS, (wall,), rng)
        picture = load(name)
        width, height = np.array([aspect**0.5, aspect**-0.5]) * rng.uniform(90, 170)
        top, left = (rng.random(2) * (np.array(picture.shape[:2]) - [height, width])).astype(int)
        part = picture[top : top + int(height), left : left + int(width)]
        columns, rows = _texels(aspect)
        part = imgproc.resize(part, rows, columns, "cubic")
        if _is_distinct(part, behind):
            break
    return part, name


def _texels(aspect: float) -> tuple[int, int]:
    """The target's columns and rows of texels, multiples of SHUFFLE_BLOCKS."""
    shares = min(aspect, 1.0), min(1 / aspect, 1.0)
    columns, rows = (SHUFFLE_BLOCKS * round(TARGET_TEXELS * share / SHUFFLE_BLOCKS) for share in shares)
    return columns, rows


def _is_distinct(part: Image, behind: Array) -> bool:
    gray = imgproc.bgr_to_gray(part).astype(np.float32)
    detail = np.abs(np.diff(gray, axis=0)).mean() + np.abs(np.diff(gray, axis=1)).mean()
    distance = math.sqrt(max(0.0, 1 - float(np.sqrt(_histogram(part) * behind).sum())))  # Bhattacharyya's
    return bool(
        gray.std() > MIN_TARGET_CONTRAST and detail > MIN_TARGET_DETAIL and distance > MIN_WALL_DISTANCE
    )


def _histogram(picture: Image) -> Array:
    """The share (512,) of the pixels in each of 8x8x8 color bins."""
    bins = (picture >> 5).reshape(-1, 3) @ np.array([64, 8, 1])
    return np.asarray(np.bincount(bins, minlength=512) / len(bins))


def _shuffle_blocks(picture: Image, rng: np.random.Generator) -> Image:
    """The same colors in another structure: the blocks are shuffled and rotated by 180 degrees."""
    rows, columns = (side // SHUFFLE_BLOCKS for side in picture.shape[:2])
    blocks = picture.reshape(SHUFFLE_BLOCKS, rows, SHUFFLE_BLOCKS, columns, 3).swapaxes(1, 2)
    order = np.roll(rng.permutation(SHUFFLE_BLOCKS**2), 1)
    mixed = blocks.reshape(-1, rows, columns, 3)[order, ::-1, ::-1]
    return np.asarray(
        mixed.reshape(SHUFFLE_BLOCKS, SHUFFLE_BLOCKS, rows, columns, 3).swapaxes(1, 2).reshape(picture.shape)
    )


def _recolor(picture: Image, rng: np.random.Generator) -> Image:
    """The same lightness with opposite hues, and a tint, since gray has no opposite hue."""
    lab = imgproc.bgr_to_lab((picture / np.float32(255)).astype(np.float32))
    angle = rng.uniform(0, 2 * np.pi)
    lab[..., 1:] = -lab[..., 1:] + np.array([45 * np.cos(angle), 45 * np.sin(angle)], np.float32)
    colors = imgproc.lab_to_bgr(lab)
    return np.asarray(np.clip(np.rint(255 * colors), 0, 255), np.uint8)


def _wall(camera: Intrinsics, name: str, far: float, rng: np.random.Generator) -> tuple[Card, CardPose]:
    """A photograph slightly wider than the view, extended by its mirror images for a camera that pans."""
    picture = photographs.load_photograph(name)
    if rng.random() < 0.5:
        picture = picture[:, ::-1]
    rows, columns = picture.shape[:2]
    beside, over = columns * 3 // 4, rows * 3 // 4
    tiled: Image = np.pad(picture, ((over, over), (beside, beside), (0, 0)), "symmetric")
    scale = far * max(camera.width / camera.fx / columns, camera.height / camera.fy / rows)
    scale *= rng.uniform(1.0, 1.2)  # meters per texel
    size = tiled.shape[1] * scale, tiled.shape[0] * scale
    return Card.from_outline(tiled, rectangle_outline(), size), face_camera(np.array([0.0, 0, far]), 0.0, 0.0)


def _floor(far: float, rng: np.random.Generator) -> tuple[Card, CardPose]:
    """A floor from one meter in front of the camera to the wall."""
    kind = [textures.WOOD_SURFACE, textures.PLAIN_SURFACE][rng.integers(2)]
    picture = textures.make_surface(kind, (256, 512), textures.random_color(rng) * 0.5 + 60, rng)
    pose = CardPose(np.array([0, FLOOR_HEIGHT, (1 + far) / 2]), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]))
    return Card.from_outline(picture, rectangle_outline(), (16.0, far - 1)), pose


def _board(far: float, rng: np.random.Generator) -> tuple[Card, CardPose]:
    """An upright textured board on the floor."""
    kind = [
        textures.WOOD_SURFACE,
        textures.CLUTTERED_SURFACE,
        textures.BLOTCHED_SURFACE,
        textures.STRIPED_SURFACE,
    ][rng.integers(4)]
    picture = textures.make_surface(kind, (160, 128), textures.random_color(rng), rng)
    width, height = rng.uniform([0.4, 0.6], [1.0, 1.9])
    z = rng.uniform(4.0, far - 0.2)
    center = np.array([rng.uniform(-0.85, 0.85) * z, FLOOR_HEIGHT - height / 2, z])
    return Card.from_outline(picture, rectangle_outline(), (width, height)), face_camera(
        center, 0.0, rng.uniform(-0.03, 0.03)
    )
