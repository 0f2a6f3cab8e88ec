# SPDX-License-Identifier: MIT
"""A face over clutter, as in figure 1 of Sabeti, Parvizi and Wu (2008), section V."""

import numpy as np

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite
from tricue.scenes import motion
from tricue.scenes.pairs import check_pair
from tricue.scenes.rendering import photographs
from tricue.scenes.rendering.paste import ellipse_mask, expose, paste
from tricue.scenes.scene import Scene
from tricue.scenes.seeds import make_generator

CLUTTER_HEIGHT, CLUTTER_WIDTH = 240, 320
FACE_HEIGHT, FACE_WIDTH = 63, 50


def face_over_clutter(
    seed: int = 0,
    frames: int = 90,
    background: str = "coffee",
    *,
    max_speed: float = 16.0,
    brightness: tuple[float, float] = (0.45, 1.3),
    noise: float = 2.0,
) -> Scene:
    """A face of 50x63 pixels moves over clutter, 320x240, and its brightness changes several times.

    background: one of BACKGROUNDS. max_speed: pixels per frame. brightness: the range of the gain that
    multiplies the face's levels; it starts at 1. noise: standard deviation in levels of 255.

    The seed decides the window of the background, the path, the times and sizes of the brightness steps, and
    the noise. ValueError or TypeError names the argument that is wrong.
    """
    check_pair(brightness, "brightness", "a low and a higher gain")
    low, high = (finite(gain, "brightness", "gains") for gain in brightness)
    if not 0 <= low < high:
        raise ValueError(f"brightness: expected a low and a higher gain, got {brightness}")
    rng = make_generator(seed)
    clutter = photographs.crop_background(background, CLUTTER_HEIGHT, CLUTTER_WIDTH, rng).astype(np.float32)
    portrait = photographs.crop(photographs.load_photograph("astronaut"), photographs.ASTRONAUT_FACE)
    face = photographs.resize(portrait, FACE_HEIGHT, FACE_WIDTH).astype(np.float32)
    opacity = ellipse_mask(FACE_HEIGHT, FACE_WIDTH, edge=2.0)
    room = np.array([CLUTTER_WIDTH - FACE_WIDTH, CLUTTER_HEIGHT - FACE_HEIGHT]) / 2
    corners = room + motion.sample_path(frames, (room[0], room[1]), max_speed, rng)
    gains = motion.sample_gain_steps(frames, *brightness, rng)
    images = (paste(clutter, face * gain, opacity, x, y) for gain, (x, y) in zip(gains, corners, strict=True))
    return Scene(
        name=f"face over {background}, seed {seed}",
        frames=tuple(Frame(color=expose(image, noise, rng)) for image in images),
        boxes=tuple(Box(x, y, FACE_WIDTH, FACE_HEIGHT) for x, y in corners.tolist()),
        changes=tuple((np.flatnonzero(np.diff(gains)) + 1).tolist()),
    )
