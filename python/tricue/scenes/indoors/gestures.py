# SPDX-License-Identifier: MIT
"""Hands: one that is tracked itself, and one that hides a face, as in figure 3 of Sabeti et al. (2008)."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.scenes.arrays import Array, Mask, Picture
from tricue.scenes.indoors.hand import FOREARM_PARTS, HandPose, build_hand
from tricue.scenes.indoors.paint import HeadFrame, Paints
from tricue.scenes.indoors.person import SHOULDERS, UpperBodyPose, build_person, turned
from tricue.scenes.indoors.picture import CAMERA, MIN_COVERAGE, ColoredLamp, Layer, mask_of, render
from tricue.scenes.indoors.room import render_room
from tricue.scenes.indoors.surface import Body, Integers
from tricue.scenes.motion import sample_sway
from tricue.scenes.rendering.paste import expose
from tricue.scenes.rendering.textures import Looks
from tricue.scenes.rendering.zbuffer import box_of_mask
from tricue.scenes.scene import Scene
from tricue.scenes.seeds import make_generator

FRAME_RATE = 30.0  # frames per second
SHUTTER = 0.4  # of the time between two frames
SLIDE_FRAMES = 9  # for the hand to come, and again to leave
AWAY = np.array([0.06, 0.36])  # meters sideways and down from the face, where the hand is out of the image


class _Still(NamedTuple):
    """The person, the hand and the room, without motion."""

    paints: Paints
    lamp: ColoredLamp
    room: Picture
    size: float


class _Moves(NamedTuple):
    """The positions and poses of head and hand in M frames."""

    heads: Array  # (M, 3) meters
    turns: Array  # (M, 3) the head's yaw, pitch, roll, radians
    hands: Array  # (M, 3) meters, the centers of the palms
    tilts: Array  # (M, 3) the hand's yaw, pitch, roll, radians
    spreads: Array  # (M,)
    bends: Array  # (M, 5) radians


def hand(seed: int = 0, frames: int = 90, *, noise: float = 2.0) -> Scene:
    """A hand moves, turns, spreads and closes its fingers in front of a person in a cluttered room, 320x240.

    The target is the hand without the wrist, about 60 to 110 px long. It passes in front of the person's
    face, and in front of wood, clay and a curtain of nearly its color. 30 frames per second, with motion
    blur.

    frames: a count. noise: standard deviation in levels of 255. The seed decides the person, the room, the
    light, the motion and the noise. ValueError or TypeError names the argument that is wrong.
    """
    rng, still = _start(seed, frames, noise)
    moves = _sample_gestures(frames, rng)
    images, boxes = [], []
    for index in range(frames):
        person, palm, _, mask = _layers(still, moves, index)
        images.append(expose(palm.over(person.over(still.room)), noise, rng))
        boxes.append(_box(mask))
    return _scene(f"hand, seed {seed}", images, boxes)


def hidden_face(seed: int = 0, frames: int = 90, *, noise: float = 2.0) -> Scene:
    """A person's hand moves in front of the face, hides it, and leaves, twice; a cluttered room, 320x240.

    The target is the head, about 50 by 65 px. First the hand covers it with closed fingers for 8 to 12
    frames; later it wipes across with spread fingers. 30 frames per second, with motion blur.

    frames, noise, the seed and errors are as in :func:`hand`.
    """
    rng, still = _start(seed, frames, noise)
    moves = _sample_wiping(frames, rng)
    images, boxes, visible = [], [], []
    for index in range(frames):
        person, palm, face, _ = _layers(still, moves, index)
        images.append(expose(palm.over(person.over(still.room)), noise, rng))
        boxes.append(_box(face))
        visible.append(float(1 - palm.coverage[face].mean()))
    return _scene(f"hidden face, seed {seed}", images, boxes, tuple(visible))


def skin_picture(seed: int = 0, *, noise: float = 2.0) -> tuple[Image, Mask]:
    """A picture of a person with a raised hand in a cluttered room, 320x240, and the mask of its skin.

    noise, the seed and errors are as in :func:`hand`. Hair, brows, pupils and clothes don't count as skin.
    """
    rng, still = _start(seed, 1, noise)
    person, palm, *_ = _layers(still, _sample_gestures(1, rng), 0)
    skin = person.skin * (1 - palm.coverage) + palm.skin
    return expose(palm.over(person.over(still.room)), noise, rng), skin > MIN_COVERAGE


def _start(seed: int, frames: int, noise: float) -> tuple[np.random.Generator, _Still]:
    positive_whole(frames, "frames", "a count")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
    rng = make_generator(seed)
    lamp, looks, size = ColoredLamp.sample(rng), Looks.sample(rng), float(rng.uniform(0.95, 1.05))
    paints = Paints.sample(looks, rng)
    return rng, _Still(paints, lamp, render_room(looks.skin, lamp, 1.5, rng), size)


def _scene(name: str, images: list[Image], boxes: list[Box], visible: tuple[float, ...] = ()) -> Scene:
    frames = tuple(Frame(image, timestamp=index / FRAME_RATE) for index, image in enumerate(images))
    return Scene(name, frames, tuple(boxes), visible=visible)


def _layers(still: _Still, moves: _Moves, index: int) -> tuple[Layer, Layer, Mask, Mask]:
    """The person and the hand in a frame, and the pixels of head and hand if nothing hid them."""
    head, rotation = moves.heads[index], turned(*moves.turns[index])
    shoulders = head * [0.6, 0.5, 1.0] + SHOULDERS * still.size
    cones, head_parts = build_person(UpperBodyPose(head, rotation, shoulders, (0.05, 0.1)), still.size)
    yaw, pitch, roll = moves.tilts[index]
    palm = build_hand(HandPose(float(moves.spreads[index]), moves.bends[index]), still.size)
    # The hand's frame looks away from the camera, so half a turn less than a head's.
    palm = palm.moved(turned(yaw - np.pi, pitch, roll), moves.hands[index])
    palm_body, person_body = Body(palm), Body(cones)
    person = render(
        person_body, still.paints, still.lamp, HeadFrame(head, rotation, still.size), shadow=palm_body
    )
    near = render(palm_body, still.paints, still.lamp)
    face, fingers = mask_of(person, 0, head_parts), mask_of(near, 0, len(palm.radii) - FOREARM_PARTS)
    before = max(index - 1, 0)
    return (
        person.moving(SHUTTER * _step(moves.heads, before, index)),
        near.moving(SHUTTER * _step(moves.hands, before, index)),
        face,
        fingers,
    )


def _step(path: Array, before: int, index: int) -> Array:
    """Pixels along x and y between two frames."""
    first, last = (path[i, :2] / path[i, 2] * [CAMERA.fx, CAMERA.fy] for i in (before, index))
    return np.asarray(last - first)


def _box(mask: Mask) -> Box:
    box = box_of_mask(mask)
    assert box is not None  # the paths keep head and hand in the image
    return box


def _sample_head(frames: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """The positions (M, 3) and angles (M, 3) of a head that sways and looks around, a meter away."""
    time = np.arange(frames) / FRAME_RATE
    middle = rng.uniform([-0.06, -0.08, 1.02], [0.06, -0.03, 1.12])
    sway = np.stack([sample_sway(time, 1.2, 3.0, rng) for _ in range(6)], axis=1)
    return middle + sway[:, :3] * [0.07, 0.02, 0.05], np.radians(sway[:, 3:] * [18, 7, 7])


def _sample_gestures(frames: int, rng: np.random.Generator) -> _Moves:
    heads, turns = _sample_head(frames, rng)
    time = np.arange(frames) / FRAME_RATE
    sway = np.stack([sample_sway(time, 1.8, 4.0, rng) for _ in range(6)], axis=1)
    depth = 0.62 + 0.07 * sway[:, 2]
    aside, down = 0.19 * sway[:, 0], 0.02 + 0.07 * sway[:, 1]
    hands = np.stack([aside * depth / 0.6, down * depth / 0.6, depth], axis=1)
    tilts = np.radians(sway[:, 3:6] * [28, 18, 26])
    spreads = np.clip(0.5 + 0.75 * sample_sway(time, 1.2, 2.6, rng), 0, 1)
    return _Moves(heads, turns, hands, tilts, spreads, _sample_bends(time, 0.28, rng))


def _sample_bends(time: Array, most: float, rng: np.random.Generator) -> Array:
    """The bends (M, 5) of the fingers, which mostly move together, up to ``most`` radians per joint."""
    shared = sample_sway(time, 0.8, 2.0, rng)
    own = np.stack([sample_sway(time, 0.6, 1.5, rng) for _ in range(5)], axis=1)
    return np.asarray(most * np.clip(0.4 + 0.4 * shared[:, None] + 0.25 * own, 0.05, 1.05))


def _sample_wiping(frames: int, rng: np.random.Generator) -> _Moves:
    heads, turns = _sample_head(frames, rng)
    index, time = np.arange(frames), np.arange(frames) / FRAME_RATE
    held = int(rng.integers(8, 13))
    start = round(frames * rng.uniform(0.22, 0.3))
    again = round(frames * rng.uniform(0.66, 0.72))
    covering = _away(index, start, start + held)
    wiping = _away(index, again, again + 4)
    side = float(rng.choice([-1.0, 1.0]))
    ratio = rng.uniform(0.55, 0.58)  # of the distance to the face
    aside = AWAY * [side, 1.0]
    offset = np.where(covering < wiping, covering, wiping)[:, None] * aside
    cross = np.clip((index - again) / 6, -1, 1) * (wiping < 1) * 0.05 * side
    hands = heads * ratio + np.stack([offset[:, 0] + cross, offset[:, 1] + 0.012, np.zeros(frames)], axis=1)
    roll = np.radians(rng.uniform(-25, 25)) + 0.25 * sample_sway(time, 0.8, 2.0, rng)
    tilts = np.stack([0.2 * sample_sway(time, 0.8, 2.0, rng), np.zeros(frames), roll], axis=1)
    spreads = np.where(covering < wiping, 0.1, 0.8) + 0.1 * sample_sway(time, 0.6, 1.4, rng)
    return _Moves(heads, turns, hands, tilts, np.clip(spreads, 0, 1), _sample_bends(time, 0.12, rng))


def _away(index: Integers, first: int, stop: int) -> Array:
    """How far away (M,) the hand is: 0 from ``first`` to ``stop``, 1 long before and after."""
    share = np.clip(np.maximum(first - index, index - stop) / SLIDE_FRAMES, 0, 1)
    return np.asarray(share**2 * (3 - 2 * share))
