# SPDX-License-Identifier: MIT
"""Pictures of faces: a head before a background, with hair behind it, a neck and clothes."""

import cv2
import numpy as np
from tricue.arrays import Floats, Image
from tricue.track.head_detection.face_detection import WINDOW

from tools.face_model.camera import photograph
from tools.face_model.heads import MIDDLE, Head, random_head
from tools.face_model.painting import Random, any_color, noise
from tools.face_model.scenes import leaves
from tools.face_model.shading import Light, project, random_light, rotation, shade

MARGIN = 6  # pixels around the window
SIZE = WINDOW + 2 * MARGIN
PIXEL = 7.0  # mm
EYE_ROW = 10.5  # pixels below the window's upper edge
FINER = 2  # rendered pixels along a pixel's side
TURN = np.radians([11, 7, 5])  # deviations of yaw, pitch and roll, which are cut at twice as much
SHIFT, LOG_SCALE = 0.8, 0.06  # of a face in its window: at most, pixels; deviation


def portrait(rng: Random) -> Image:
    """A BGR image of a face with the detector's window in its middle."""
    head, light = random_head(rng), random_light(rng)
    turn = rotation(*(np.clip(rng.normal(0, 1, 3), -2, 2) * TURN))
    side = SIZE * FINER
    image = np.repeat(np.repeat(leaves(rng, SIZE), FINER, axis=0), FINER, axis=1)
    middle = FINER * (np.array([WINDOW / 2, EYE_ROW]) + MARGIN + rng.uniform(-SHIFT, SHIFT, 2))
    scale = FINER / PIXEL * np.exp(rng.normal(0, LOG_SCALE)) * np.array([rng.uniform(0.94, 1.06), 1])
    y, x = np.mgrid[:side, :side]
    _body(rng, image, (x - middle[0]) / scale[1], (y - middle[1]) / scale[1], head, light)
    project(head, _lit(rng, head, light, turn), turn, image, scale, middle)
    smooth = cv2.GaussianBlur(image, (0, 0), 0.36 * FINER)
    image = np.asarray(cv2.resize(smooth, (SIZE, SIZE), interpolation=cv2.INTER_AREA), np.float64)
    if rng.uniform() < 0.3:  # something unseen casts a shadow
        image *= np.exp(0.3 * noise(rng, (SIZE, SIZE), SIZE / 2))[..., np.newaxis]
    return photograph(rng, image)


def _lit(rng: Random, head: Head, light: Light, turn: Floats) -> Floats:
    """The colors of a head's points in this light, and half of the time in a second one, as by a window."""
    occlusion = rng.uniform(0.03, 0.12)
    colors = shade(head, light, turn, occlusion)
    if rng.uniform() < 0.5:
        share = rng.uniform(0.2, 0.5)
        colors += share * (shade(head, random_light(rng), turn, occlusion) - colors)
    return colors


def _body(rng: Random, image: Floats, x: Floats, y: Floats, head: Head, light: Light) -> None:
    """What is behind a head, evenly lit: hair, neck and clothes. x, y: mm from between the eyes."""
    gain = 0.7 - 0.1 * light.ambient
    at = head.measures
    if not head.bald:
        half = at.half_width + rng.uniform(0, 30)
        height = half - at.half_width + 4 + MIDDLE - at.crown
        behind = ((x / half) ** 2 + ((y - MIDDLE) / height) ** 2 < 1) & (y < rng.uniform(-40, 50))
        if rng.uniform() < 0.4:  # long
            behind |= (np.abs(x) < half) & (y > MIDDLE) & (y < rng.uniform(60, 260))
        strands = np.exp(rng.normal(0, 0.2, (*x.shape, 1)))
        image[behind] = (head.hair * gain * strands)[behind]
    width = rng.uniform(44, 66)
    neck = (np.abs(x) < width + 0.6 * np.maximum(y - at.chin - 20, 0)) & (y > 40)
    image[neck] = head.skin * gain * rng.uniform(0.25, 0.9)
    shoulders = np.minimum(width + 20 + 2 * np.maximum(y - at.chin, 0), 200)
    clothes = (y > at.chin + rng.uniform(15, 60)) & (np.abs(x) < shoulders)
    image[clothes] = any_color(rng) * gain
