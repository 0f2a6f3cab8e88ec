# SPDX-License-Identifier: MIT
"""A person who jumps up and down, as in figure 4 of Sabeti, Parvizi and Wu (2008)."""

from typing import NamedTuple

import numpy as np

from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.scenes.arrays import Array
from tricue.scenes.indoors.paint import HeadFrame, Paints
from tricue.scenes.indoors.person import SHOULDERS, UpperBodyPose, build_person, turned
from tricue.scenes.indoors.picture import CAMERA, ColoredLamp, mask_of, render
from tricue.scenes.indoors.room import render_room
from tricue.scenes.indoors.surface import Body
from tricue.scenes.motion import sample_sway
from tricue.scenes.rendering.paste import expose
from tricue.scenes.rendering.textures import Looks
from tricue.scenes.rendering.zbuffer import box_of_mask
from tricue.scenes.scene import Scene
from tricue.scenes.seeds import make_generator

FRAME_RATE = 15.0  # frames per second, like a webcam indoors
SHUTTER = 0.5  # of the time between two frames
GRAVITY = 9.81  # m/s²
DISTANCES = 1.65, 1.95  # meters
MAX_ASIDE = 0.5  # meters from the middle to the head


class _Moves(NamedTuple):
    """M frames of a jumping person."""

    heads: Array  # (M, 3) meters
    turns: Array  # (M, 3) of the head: yaw, pitch, roll, radians
    arms: Array  # (M,) radians from hanging


def jump(seed: int = 0, frames: int = 90, *, noise: float = 2.0) -> Scene:
    """A person jumps up and down in a cluttered room, 320x240 at 15 frames per second.

    The target is the head, about 30 by 45 px. In each jump it goes down, up and down again by up to 35 px per
    frame, turns, rolls and changes its distance, with motion blur. Between jumps it rests.

    frames: a count. noise: standard deviation in levels of 255. The seed decides the person, the room, the
    light, the jumps and the noise. ValueError or TypeError names the argument that is wrong.
    """
    positive_whole(frames, "frames", "a count")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
    rng = make_generator(seed)
    lamp, looks, size = ColoredLamp.sample(rng), Looks.sample(rng), float(rng.uniform(0.95, 1.05))
    paints = Paints.sample(looks, rng)
    room = render_room(looks.skin, lamp, 2.2, rng)
    moves = _sample_jumps(frames, rng)
    pixels = moves.heads[:, :2] / moves.heads[:, 2:] * [CAMERA.fx, CAMERA.fy]
    speeds = np.gradient(pixels, axis=0) if frames > 1 else np.zeros((1, 2))
    images, boxes = [], []
    for index, head in enumerate(moves.heads):
        rotation, arms = turned(*moves.turns[index]), float(moves.arms[index])
        shoulders = head + SHOULDERS * size
        cones, head_parts = build_person(UpperBodyPose(head, rotation, shoulders, (arms, 0.9 * arms)), size)
        layer = render(Body(cones), paints, lamp, HeadFrame(head, rotation, size))
        box = box_of_mask(mask_of(layer, 0, head_parts))
        assert box is not None  # the jumps keep the head in the image
        boxes.append(box)
        images.append(expose(layer.moving(SHUTTER * speeds[index]).over(room), noise, rng))
    return Scene(
        name=f"jump, seed {seed}",
        frames=tuple(Frame(image, timestamp=index / FRAME_RATE) for index, image in enumerate(images)),
        boxes=tuple(boxes),
    )


def _sample_jumps(frames: int, rng: np.random.Generator) -> _Moves:
    """Crouch, leap, land in a crouch, stand for a moment, repeat."""
    fine = 8  # steps per frame
    time = np.arange(frames * fine) / (FRAME_RATE * fine)
    up, aside, arms, roll = (np.zeros(len(time)) for _ in range(4))
    begin, place = float(rng.uniform(0.4, 0.8)), 0.0
    while begin < time[-1]:
        crouch, speed = rng.uniform(0.14, 0.22), rng.uniform(2.2, 2.6)
        down, push, flight = rng.uniform(0.28, 0.36), 2 * crouch / speed, 2 * speed / GRAVITY
        land, stand = rng.uniform(0.30, 0.40), rng.uniform(0.1, 0.5)
        target = float(np.clip(place + rng.uniform(-0.35, 0.35), -MAX_ASIDE, MAX_ASIDE))
        lean = rng.uniform(-0.45, 0.45)
        s = time - begin
        first = _ease(s / down) * -crouch
        pushing = np.clip(s - down, 0, push)
        flying = np.clip(s - down - push, 0, flight)
        after = np.clip(s - down - push - flight, 0, land) / land
        ends = down + push + flight + land
        now = (s >= 0) & (s < ends)
        # The push is uniformly accelerated from the crouch; the landing is a damped crouch.
        height = first + crouch * (pushing / push) ** 2 + speed * flying - GRAVITY / 2 * flying**2
        height -= 0.16 * np.sin(np.pi * after) ** 2 * (after > 0)
        up[now] = height[now]
        share = np.clip((s - down) / (push + flight), 0, 1)
        aside[s >= 0] = (place + (target - place) * share)[s >= 0]
        arms[now] = (1.1 * np.sin(np.pi * share) ** 2)[now]
        roll[now] = (lean * np.sin(np.pi * share) * (share < 1))[now]
        place, begin = target, begin + ends + stand
    sway = np.stack([sample_sway(time, 0.8, 2.0, rng) for _ in range(5)], axis=1)
    distance = rng.uniform(*DISTANCES) + 0.14 * sway[:, 0]
    heads = np.stack([aside + 0.03 * sway[:, 1], 0.02 - up, distance], axis=1)
    turns = np.stack([0.45 * sway[:, 2], 0.15 * sway[:, 3], roll + 0.08 * sway[:, 4]], axis=1)
    return _Moves(heads[::fine], turns[::fine], arms[::fine])


def _ease(share: Array) -> Array:
    """From 0 to 1, with slope 0 at both ends."""
    share = np.clip(share, 0, 1)
    return np.asarray(share**2 * (3 - 2 * share))
