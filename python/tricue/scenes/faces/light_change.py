# SPDX-License-Identifier: MIT
"""Abrupt changes of light, as on the driver's face in figure 2 of Sabeti, Parvizi and Wu (2008)."""

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.scenes import motion
from tricue.scenes.arrays import Picture
from tricue.scenes.rendering import photographs
from tricue.scenes.rendering.paste import ellipse_mask, expose, paste
from tricue.scenes.scene import Scene
from tricue.scenes.seeds import make_generator

PHOTOGRAPH_SCALE = 0.625  # from the upper 512x384 of the photograph to 320x240
MAX_HEAD_OFFSET = (40.0, 10.0)  # pixels from the center, horizontally and vertically


class ToneCurve(NamedTuple):
    """A tone curve per channel, ``gain * level ** gamma`` for levels in [0, 1]; it keeps their order."""

    gain: NDArray[np.float32]
    gamma: NDArray[np.float32]

    def __call__(self, picture: Picture) -> Picture:
        return np.asarray(255 * self.gain * (picture / 255) ** self.gamma, dtype=np.float32)


def light_change(seed: int = 0, frames: int = 90, *, max_speed: float = 6.0, noise: float = 2.0) -> Scene:
    """A head moves in front of a static cabin, 320x240; the light on the whole image changes abruptly, twice.

    The light changes after one third and two thirds of the frames. Each channel has its own tone curve in
    each light, so that colors shift. The target is the face, about 61x77 pixels. max_speed: pixels per
    frame. noise: standard deviation in levels of 255. The seed decides the path, the curves and the noise.
    """
    rng = make_generator(seed)
    cabin, head, corner, face = _cabin_and_head()
    opacity = ellipse_mask(head.shape[0], head.shape[1], edge=6.0)
    offsets = motion.sample_path(frames, MAX_HEAD_OFFSET, max_speed, rng)
    courses = np.searchsorted([frames // 3, 2 * frames // 3], np.arange(frames), side="right")
    lights = [_daylight(), _warm(rng), _cold(rng)]
    images = (
        lights[course](paste(cabin, head, opacity, *(corner + offset)))
        for course, offset in zip(courses.tolist(), offsets, strict=True)
    )
    return Scene(
        name=f"light change, seed {seed}",
        frames=tuple(Frame(color=expose(image, noise, rng)) for image in images),
        boxes=tuple(face._replace(x=face.x + x, y=face.y + y) for x, y in offsets.tolist()),
        changes=tuple((np.flatnonzero(np.diff(courses)) + 1).tolist()),
    )


def _cabin_and_head() -> tuple[Picture, Picture, NDArray[np.float64], Box]:
    """The cabin with the head inpainted, the cut-out head, its top-left corner (x, y), and the face's box."""
    picture = photographs.load_photograph("astronaut")
    cabin = photographs.resize(picture[:384], 240, 320)
    head, face = (
        np.array(box) * PHOTOGRAPH_SCALE for box in (photographs.ASTRONAUT_HEAD, photographs.ASTRONAUT_FACE)
    )
    cutout = photographs.resize(
        photographs.crop(picture, photographs.ASTRONAUT_HEAD), round(head[3]), round(head[2])
    )
    hole = np.zeros(cabin.shape[:2], dtype=np.uint8)
    x, y, width, height = head.astype(int)
    hole[y : y + height, x : x + width] = 1
    empty = cv2.inpaint(cabin, hole, 3, cv2.INPAINT_TELEA)
    return empty.astype(np.float32), cutout.astype(np.float32), head[:2], Box(*face.tolist())


def _daylight() -> ToneCurve:
    return ToneCurve(np.ones(3, dtype=np.float32), np.ones(3, dtype=np.float32))


def _warm(rng: np.random.Generator) -> ToneCurve:
    """Low sunlight: red rises most, blue falls."""
    return _varied([0.75, 1.05, 1.2], [1.3, 0.9, 0.6], rng)


def _cold(rng: np.random.Generator) -> ToneCurve:
    """Shadow: all channels are darker, red most."""
    return _varied([0.75, 0.6, 0.45], [0.9, 1.1, 1.4], rng)


def _varied(gain: list[float], gamma: list[float], rng: np.random.Generator) -> ToneCurve:
    factors = rng.uniform(0.9, 1.1, (2, 3))
    return ToneCurve(np.float32(gain * factors[0]), np.float32(gamma * factors[1]))
