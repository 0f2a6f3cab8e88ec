# SPDX-License-Identifier: MIT
"""A target that is drawn before a wall, and a tracker that has followed it."""

from typing import Any

import bad_input_cases as cases
import cv2
import numpy as np
from bad_input_cases import HEIGHT, RIG, WIDTH
from numpy.typing import NDArray
from tricue import FlowDepthTracker, Frame

Image = NDArray[np.uint8]
BOX = (48, 29, 32, 38)
NEAR, OURS, FAR = 20, 12, 4  # disparities of what hides the target, of the target and of the wall, pixels


def texture(shape: tuple[int, int], seed: int) -> Image:
    """Fine and coarse grain, BGR."""
    rng = np.random.default_rng(seed)
    height, width = shape
    coarse = cv2.resize(
        rng.normal(0, 40, (height // 5 + 1, width // 5 + 1)), (width, height), interpolation=cv2.INTER_CUBIC
    )
    levels = coarse + cv2.GaussianBlur(rng.normal(0, 40, shape), (0, 0), 1.0) + 128
    return np.clip(levels[..., None] + rng.integers(-20, 20, 3), 0, 255).astype(np.uint8)


WALL = texture((HEIGHT, WIDTH + FAR), 0)
TARGET = texture((BOX[3], BOX[2]), 1)
SCREEN = texture((60, 50), 2)


def pair(shift: int = 0, screen: int | None = None) -> tuple[Image, Image]:
    """Left and right of a target of 32x38 pixels before a wall, which has moved to the right, and of a screen
    before it, if its first column is told.
    """
    left, right = WALL[:, :WIDTH].copy(), WALL[:, FAR:].copy()
    for side, nearer in ((left, False), (right, True)):
        draw(side, TARGET, BOX[0] + shift - nearer * OURS, BOX[1])
        if screen is not None:
            draw(side, SCREEN, screen - nearer * NEAR, 20)
    return left, right


def draw(image: Image, patch: Image, x: int, y: int) -> None:
    """As much of the patch as the image has room for."""
    first, last = max(x, 0), min(x + patch.shape[1], WIDTH)
    if first < last:
        image[y : y + patch.shape[0], first:last] = patch[:, first - x : last - x]


def depth_of(shift: int = 0) -> NDArray[np.float32]:
    """The same scene's depth, meters."""
    disparity = np.full((HEIGHT, WIDTH), FAR, np.float32)
    first, last = (min(max(BOX[0] + shift + more, 0), WIDTH) for more in (0, BOX[2]))
    disparity[BOX[1] : BOX[1] + BOX[3], first:last] = OURS
    return np.float32(RIG.intrinsics.fx * RIG.baseline) / disparity


def framed(shift: int = 0, screen: int | None = None, **others: Any) -> Frame:
    """That pair as a frame."""
    left, right = pair(shift, screen)
    return Frame(left, right=right, **others)


def seen_by(camera: str, shift: int) -> Frame:
    """The scene as a pair, as color and depth, as color alone, or as depth alone."""
    return {
        "pair": lambda: framed(shift),
        "rgbd": lambda: Frame(pair(shift)[0], depth=depth_of(shift)),
        "color": lambda: Frame(pair(shift)[0]),
        "depth": lambda: Frame(depth=depth_of(shift)),
    }[camera]()


LEFT, RIGHT = pair()
DEPTH = depth_of()
NEXT = framed(5)
FLOW, DISPARITY = {"cues": ("flow",)}, {"cues": ("disparity",)}
FRAMES = {
    **cases.odd_pairs(LEFT, RIGHT),
    "another scene": (texture((HEIGHT, WIDTH), 7), texture((HEIGHT, WIDTH), 8)),
    "another scene, nearer": tuple(texture((HEIGHT, WIDTH + 30), 9)[:, x : x + WIDTH] for x in (0, 30)),
}
DEPTHS = cases.odd_depths(DEPTH)


def odd(name: str) -> Frame:
    """The frame of that name."""
    left, right = FRAMES[name]
    return Frame(left, right=right)


def assert_mask(tracker: FlowDepthTracker) -> None:
    """A mask of the picture's size with 0 and 255 only, and finite blocks."""
    mask = tracker.mask
    assert mask is not None
    assert mask.dtype == np.uint8
    assert np.isin(mask, (0, 255)).all()
    for box in (box for kind in tracker.blocks for box in kind):
        assert np.isfinite(box).all()


def started(frames: int = 4, **parameters: Any) -> FlowDepthTracker:
    """A tracker that has followed BOX, which moves a pixel a frame."""
    tracker = FlowDepthTracker(**{"rig": RIG, **parameters})
    tracker.init(framed(), BOX)
    for shift in range(1, 1 + frames):
        tracker.update(framed(shift))
    return tracker
