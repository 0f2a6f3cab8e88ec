# SPDX-License-Identifier: MIT
"""Bad stereo pairs, and tricue's trackers that take stereo; run by bad_input.py."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import tricue
from bad_case import Case, Made, with_tracker
from tricue import Frame, Intrinsics, StereoRig
from tricue.scenes import head

SCENE = head(0, 2)
(LEFT, RIGHT), (NEXT, NEXT_RIGHT) = ((frame.color, frame.right) for frame in SCENE.frames)
BOX = tuple(round(number) for number in SCENE.boxes[0])
RIG = SCENE.rig
HEIGHT, WIDTH = LEFT.shape[:2]
DEPTH = np.full((HEIGHT, WIDTH), 2.5, np.float32)
BLACK, WHITE = np.zeros_like(LEFT), np.full_like(LEFT, 255)
NOISE = np.random.default_rng(0).integers(0, 256, (2, *LEFT.shape), np.uint8)
TINY = LEFT[:1, :1].copy(), RIGHT[:1, :1].copy()
HUGE = tuple(np.tile(image, (25, 25, 1)) for image in (LEFT, RIGHT))
SECONDS = 1 / 30


def pair(left: Any, right: Any, seconds: Any = None) -> Made:
    """A frame that is made when the case runs, so that its errors are reported."""
    return Made(lambda: Frame(left, right=right, timestamp=seconds))


GOOD, AFTER = pair(LEFT, RIGHT, 0.0), pair(NEXT, NEXT_RIGHT, SECONDS)


def case(name: str, first: Any = GOOD, box: Any = BOX, second: Any = AFTER, **others: Any) -> Case:
    """A case in which everything else is valid."""
    return Case(name, first, box, second, **{"camera": RIG, **others})


def later(name: str, left: Any = NEXT, right: Any = NEXT_RIGHT) -> Case:
    """A case with a different second stereo pair."""
    return case(name, second=pair(left, right, SECONDS))


def alone(name: str, image: Any) -> Case:
    """A case whose update gets something that isn't a stereo pair, or a function that makes it."""
    return case(name, second=Made(image if callable(image) else lambda: image))


def both(name: str, change: Callable[[Any], Any], **others: Any) -> Case:
    """A case with all four images changed."""
    first, second = pair(change(LEFT), change(RIGHT)), pair(change(NEXT), change(NEXT_RIGHT))
    return case(name, first, second=second, **others)


def gray(image: Any) -> Any:
    """The image in gray, one channel."""
    return cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)


def darker(image: Any) -> Any:
    """The image with two thirds of the light."""
    return (image // 3 * 2).astype(np.uint8)


def rig(degrees: float, baseline: float) -> StereoRig:
    """A rig with this field of view, degrees."""
    return StereoRig(Intrinsics.from_fov(WIDTH, HEIGHT, degrees), baseline)


CASES = (
    case("all is well"),
    case("no box", box=None),
    alone("a bare image", NEXT),
    alone("two images in a tuple", (NEXT, NEXT_RIGHT)),
    alone("both side by side", np.hstack([NEXT, NEXT_RIGHT])),
    alone("tricue.Frame without right", lambda: Frame(NEXT)),
    alone("tricue.Frame of right alone", lambda: Frame(right=NEXT_RIGHT)),
    alone("tricue.Frame of depth alone", lambda: Frame(depth=DEPTH)),
    alone("tricue.Frame of color and depth", lambda: Frame(NEXT, DEPTH)),
    later("right of another size", right=NEXT_RIGHT[:, 1:]),
    later("right half as large", right=NEXT_RIGHT[::2, ::2]),
    later("right of 0 rows", right=NEXT_RIGHT[:0]),
    later("right a list", right=NEXT_RIGHT.tolist()),
    later("right uint16", right=NEXT_RIGHT.astype(np.uint16)),
    later("right float32, 0 to 1", right=NEXT_RIGHT.astype(np.float32) / 255),
    later("right gray", right=gray(NEXT_RIGHT)),
    later("right BGRA", right=cv2.cvtColor(NEXT_RIGHT, cv2.COLOR_BGR2BGRA)),
    later("left gray", left=gray(NEXT)),
    both("all gray", gray),
    both("uint16", lambda image: image.astype(np.uint16)),
    both("read-only", lambda image: np.frombuffer(image.tobytes(), np.uint8).reshape(image.shape)),
    both("crop of a larger array", lambda image: np.pad(image, ((4, 4), (4, 4), (0, 0)))[4:-4, 4:-4]),
    both("channels-reversed view of RGB", lambda image: image[..., ::-1].copy()[..., ::-1]),
    both("Fortran order", np.asfortranarray),
    later("mirrored view", NEXT[:, ::-1], NEXT_RIGHT[:, ::-1]),
    later("left and right swapped at update", NEXT_RIGHT, NEXT),
    case("left and right swapped", pair(RIGHT, LEFT, 0.0), second=pair(NEXT_RIGHT, NEXT, SECONDS)),
    case(
        "not rectified",
        pair(LEFT, np.roll(RIGHT, 4, axis=0), 0.0),
        second=pair(NEXT, np.roll(NEXT_RIGHT, 4, axis=0), SECONDS),
    ),
    later("left twice at update", right=NEXT),
    case("left twice", pair(LEFT, LEFT), second=pair(NEXT, NEXT)),
    case(
        "the right camera a third darker",
        pair(LEFT, darker(RIGHT), 0.0),
        second=pair(NEXT, darker(NEXT_RIGHT), SECONDS),
    ),
    later("smaller pair", NEXT[::2, ::2], NEXT_RIGHT[::2, ::2]),
    later("larger pair", NEXT.repeat(2, 0).repeat(2, 1), NEXT_RIGHT.repeat(2, 0).repeat(2, 1)),
    later(f"4000x3000 after {WIDTH}x{HEIGHT}", *HUGE),
    case("1x1 images", pair(*TINY), (0, 0, 1, 1), pair(*TINY), camera=None),
    case("4000x3000 images", pair(*HUGE), BOX, pair(*HUGE), camera=None),
    case("no rig", camera=None),
    case("rig of another size", camera=StereoRig(Intrinsics.from_fov(640, 480, 57), 0.12)),
    case("intrinsics for a rig", camera=RIG.intrinsics),
    case("a baseline of a nanometer", camera=rig(55, 1e-9)),
    case("an angle of view of 179.9 degrees", camera=rig(179.9, 0.12)),
    case("an angle of view of 0.1 degrees", camera=rig(0.1, 0.12)),
    case("timestamps go back", pair(LEFT, RIGHT, 5.0), second=pair(NEXT, NEXT_RIGHT, 4.0)),
    case("timestamps a day apart", second=pair(NEXT, NEXT_RIGHT, 86_400.0)),
    case("box of 2x2", box=(80, 60, 2, 2)),
    case("box half outside", box=(-10, 40, 20, 24)),
    case("box larger than the image", box=(-100, -100, 600, 600)),
    case("box of a million pixels", box=(-5e5, -5e5, 1e6, 1e6)),
    case("black at init", pair(BLACK, BLACK)),
    case("saturated at init", pair(WHITE, WHITE)),
    later("black at update", BLACK, BLACK),
    later("saturated at update", WHITE, WHITE),
    later("right black at update", right=BLACK),
    later("left black at update", left=BLACK),
    later("noise at update", *NOISE),
)


def ours(name: str) -> Callable[[Case], tricue.Track]:
    """tricue's tracker of that name with the case's rig."""
    return with_tracker(lambda case: tricue.create(name, rig=case.camera))


OURS = {name: ours(name) for name in ("stereo-head", "flow-depth", "fused")}

HEAD = f"""
## Stereo

All other input is valid: two stereo pairs, a thirtieth of a second apart, of `tricue.scenes.head(0)`, somebody in front of two cameras of
{WIDTH}x{HEIGHT} pixels whose calibration is known, and the box {BOX}.

`init` warns of a swapped or unrectified stereo pair, and tracking starts all the same if something in the box has a disparity, but at a
wrong distance: [how often](stereo.md#a-swapped-or-unrectified-pair).

"""
