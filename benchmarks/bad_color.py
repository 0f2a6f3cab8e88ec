# SPDX-License-Identifier: MIT
"""Bad color input, and tricue's trackers that take color; run by bad_input.py."""

from typing import Any

import cv2
import numpy as np
import tricue
from bad_case import Case, Made, with_tracker

NOISE = np.random.default_rng(0).integers(0, 256, (60, 80, 3), np.uint8)
IMAGE = cv2.GaussianBlur(cv2.resize(NOISE, (320, 240), interpolation=cv2.INTER_CUBIC), (0, 0), 2)
SHIFT = 3  # pixels, to the right
NEXT = np.roll(IMAGE, SHIFT, axis=1)
BOX = (120, 80, 50, 60)
DEPTH = np.full((240, 320), 2.5, np.float32)
BLACK, WHITE = np.zeros_like(IMAGE), np.full_like(IMAGE, 255)
TINY, HUGE = IMAGE[:1, :1].copy(), np.tile(IMAGE, (13, 13, 1))[:3000, :4000].copy()


def case(name: str, first: Any = IMAGE, box: Any = BOX, second: Any = NEXT, starts: bool = True) -> Case:
    """A case in which everything else is valid; the target is in both images."""
    x, y, width, height = box
    return Case(name, first, box, second, starts, truth=(x + SHIFT, y, width, height))


def wrong(name: str, first: Any = IMAGE, box: Any = BOX, second: Any = NEXT, starts: bool = True) -> Case:
    """A case without a target to follow, in which only an error or "not found" is right."""
    return Case(name, first, box, second, starts)


def gray(image: Any) -> Any:
    """The image in gray, one channel."""
    return cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)


CASES = (
    case("all is well"),
    wrong("update before init", starts=False),
    wrong("frame None", second=None),
    wrong("frame a list", second=NEXT.tolist()),
    wrong("frame empty", second=NEXT[:0]),
    case("uint16 frame", second=NEXT.astype(np.uint16)),
    case("uint16 frames", IMAGE.astype(np.uint16), second=NEXT.astype(np.uint16)),
    case("float32 frame, 0 to 1", second=NEXT.astype(np.float32) / 255),
    case("float32 frames, 0 to 1", IMAGE.astype(np.float32) / 255, second=NEXT.astype(np.float32) / 255),
    case("bool frame", second=NEXT > 127),
    case("gray frame", second=gray(NEXT)),
    case("gray frames", gray(IMAGE), second=gray(NEXT)),
    case("BGRA frame", second=cv2.cvtColor(NEXT, cv2.COLOR_BGR2BGRA)),
    case("crop of a larger array", second=np.pad(NEXT, ((4, 4), (4, 4), (0, 0)))[4:-4, 4:-4]),
    wrong("mirrored view", second=NEXT[:, ::-1]),
    case("channels-reversed view", second=NEXT[..., ::-1]),
    case("Fortran order", second=np.asfortranarray(NEXT)),
    wrong("depth, float32 meters", second=DEPTH),
    wrong("depth, uint16 millimeters", second=(1000 * DEPTH).astype(np.uint16)),
    wrong("tricue.Frame of depth alone", second=Made(lambda: tricue.Frame(depth=DEPTH))),
    case("tricue.Frame of color and depth", second=Made(lambda: tricue.Frame(NEXT, DEPTH))),
    wrong("smaller frame", second=NEXT[:120, :160].copy()),
    case("larger frame", second=np.tile(NEXT, (2, 2, 1))),
    wrong("4000x3000 after 320x240", second=HUGE),
    wrong("1x1 image", TINY, (0, 0, 1, 1), TINY),
    case("4000x3000 images", HUGE, BOX, HUGE),
    wrong("box of NaN", box=(np.nan, 80, 50, 60)),
    wrong("infinite box", box=(120, 80, np.inf, 60)),
    wrong("box of strings", box=("120", "80", "50", "60")),
    wrong("box of three numbers", box=(120, 80, 50)),
    case("box of fractions", box=(120.5, 80.25, 50.0, 60.5)),
    wrong("box of zeros", box=(0, 0, 0, 0)),
    wrong("box of zero width", box=(120, 80, 0, 60)),
    wrong("negative size", box=(170, 140, -50, -60)),
    case("box of 1x1", box=(120, 80, 1, 1)),
    case("box of 1x300", box=(120, -30, 1, 300)),
    case("box half outside", box=(-25, 80, 50, 60)),
    wrong("box outside", box=(400, 80, 50, 60)),
    wrong("box far outside", box=(10**9, 80, 50, 60)),
    case("box larger than the image", box=(-100, -100, 600, 600)),
    wrong("black at init", BLACK),
    wrong("saturated at init", WHITE),
    wrong("black at update", second=BLACK),
    wrong("saturated at update", second=WHITE),
    wrong("noise at update", second=np.random.default_rng(1).integers(0, 256, IMAGE.shape, np.uint8)),
)


OURS = {
    "color-particle": with_tracker(lambda _: tricue.create("color-particle", seed=0)),
    "flow-depth": with_tracker(lambda _: tricue.create("flow-depth", cues=("flow",))),
    "fused": with_tracker(lambda _: tricue.create("fused")),
}

HEAD = f"""## Color

All other input is valid: a textured image of 320x240 pixels that moves {SHIFT} pixels to the right, and the box {BOX}. `flow-depth`
uses flow alone; in an image that moves as a whole, flow can't tell the target from the rest.

"""
