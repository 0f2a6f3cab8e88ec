# SPDX-License-Identifier: MIT
"""Bad depth input, and tricue's trackers that take depth; run by bad_input.py."""

from collections.abc import Callable
from typing import Any

import numpy as np
import tricue
from bad_case import Case, Made, made, with_tracker
from tricue import Frame
from tricue.scenes import walker

SCENE = walker(0, frames=2)
DEPTH, NEXT = (frame.depth for frame in SCENE.frames)
BOX = tuple(round(number) for number in SCENE.boxes[0])
CAMERA = SCENE.intrinsics
HEIGHT, WIDTH = DEPTH.shape
MM, NEXT_MM = (np.nan_to_num(1000 * meters).astype(np.uint16) for meters in (DEPTH, NEXT))
COLOR = np.zeros((480, 640, 3), np.uint8)
NOTHING, WALL = np.full_like(DEPTH, np.nan), np.full_like(DEPTH, 3.0)
TINY, HUGE = DEPTH[60:61, 80:81].copy(), np.tile(DEPTH, (21, 23))[:3000, :4000].copy()


def case(name: str, first: Any = DEPTH, box: Any = BOX, second: Any = NEXT, **others: Any) -> Case:
    """A case in which everything else is valid."""
    return Case(name, first, box, second, **{"camera": CAMERA, **others})


def alone(name: str, image: Any) -> Case:
    """A case whose update gets the value without a Frame around it."""
    return case(name, second=Made(lambda: image))


def both(name: str, change: Callable[[Any], Any], **others: Any) -> Case:
    """A case with both frames changed."""
    return case(name, change(DEPTH), second=change(NEXT), **others)


def scaled(name: str, image: Any, scale: Any) -> Case:
    """A case whose update has a depth scale."""
    return case(name, second=Made(lambda: Frame(depth=image, depth_scale=scale)))


def colored(name: str, change: Callable[[Any], Any]) -> Case:
    """A case with both depth images changed, with gray pictures of the unchanged ones as color."""

    def frame(meters: Any) -> Made:
        levels = np.nan_to_num(255 / 8 * meters).clip(0, 255).astype(np.uint8)
        return Made(lambda: Frame(levels, change(meters)))

    return case(name, frame(DEPTH), second=frame(NEXT))


def timed(name: str, first: Any, second: Any) -> Case:
    """A case with these timestamps."""
    return case(
        name,
        Made(lambda: Frame(depth=DEPTH, timestamp=first)),
        second=Made(lambda: Frame(depth=NEXT, timestamp=second)),
    )


CASES = (
    case("all is well"),
    case("no box", box=None),
    alone("bare depth, float32 meters", NEXT),
    alone("bare depth, uint16 millimeters", NEXT_MM),
    alone("bare color image", COLOR),
    case("tricue.Frame of color alone", second=Made(lambda: Frame(COLOR))),
    case("depth of 0 rows", second=NEXT[:0]),
    case("depth a list", second=NEXT.tolist()),
    case("uint16 without a scale", second=NEXT_MM),
    scaled("uint16 with its scale", NEXT_MM, 0.001),
    scaled("int32 with its scale", NEXT_MM.astype(np.int32), 0.001),
    scaled("scale 0", NEXT_MM, 0),
    scaled("scale NaN", NEXT_MM, np.nan),
    scaled("scale 'mm'", NEXT_MM, "mm"),
    case("uint8 picture", second=(NEXT_MM // 32).astype(np.uint8)),
    case("colored picture", second=np.dstack(3 * [(NEXT_MM // 32).astype(np.uint8)])),
    case("bool", second=NEXT > 3),
    case("float16", second=NEXT.astype(np.float16)),
    case("float64", second=NEXT.astype(np.float64)),
    case("objects", second=NEXT.astype(object)),
    case("millimeters as meters at update", second=1000 * NEXT),
    both("millimeters as meters", lambda meters: 1000 * meters),
    both("millimeters as meters, no box", lambda meters: 1000 * meters, box=None),
    both("meters as millimeters", lambda meters: Made(lambda: Frame(depth=meters, depth_scale=0.001))),
    case("all NaN at update", second=NOTHING),
    case("all 0 at update", second=np.zeros_like(DEPTH)),
    case("all negative at update", second=-NEXT),
    case("all infinite at update", second=np.full_like(DEPTH, np.inf)),
    case("all NaN at init", NOTHING),
    case("all NaN at init, no box", NOTHING, None),
    case("a wall alone, no box", WALL, None),
    both("gaps as 0", np.nan_to_num),
    both("gaps as -1", lambda meters: np.nan_to_num(meters, nan=-1.0)),
    both("masked gaps", np.ma.masked_invalid),
    colored("gray picture beside it", lambda meters: meters),
    colored("millimeters as meters, gray picture beside them", lambda meters: 1000 * meters),
    colored("meters as millimeters, gray picture beside them", lambda meters: meters / 1000),
    colored("8 pixels to the right of the gray picture", lambda meters: np.roll(meters, 8, axis=1)),
    both("color of 640x480 beside it", lambda meters: Made(lambda: Frame(COLOR, meters))),
    case(
        "color of another size than before",
        Made(lambda: Frame(COLOR, DEPTH)),
        second=Made(lambda: Frame(COLOR[:9], NEXT)),
    ),
    both("read-only", lambda meters: np.frombuffer(meters.tobytes(), np.float32).reshape(meters.shape)),
    both("crop of a larger array", lambda meters: np.pad(meters, 4)[4:-4, 4:-4]),
    both("every other pixel of a larger array", lambda meters: meters.repeat(2, 0).repeat(2, 1)[::2, ::2]),
    both("Fortran order", np.asfortranarray),
    both("other byte order", lambda meters: meters.astype(">f4")),
    case("mirrored view", second=NEXT[:, ::-1]),
    case("smaller frame", second=NEXT[::2, ::2]),
    case("larger frame", second=NEXT.repeat(2, 0).repeat(2, 1)),
    case(f"4000x3000 after {WIDTH}x{HEIGHT}", second=HUGE),
    case("1x1 image", TINY, (0, 0, 1, 1), TINY, camera=None),
    case("1x1 image, no box", TINY, None, TINY, camera=None),
    case("4000x3000 images", HUGE, BOX, HUGE, camera=None),
    case("camera of another size", camera=tricue.Intrinsics.from_fov(640, 480, 57)),
    case("camera a matrix", camera=CAMERA.matrix),
    case("no camera", camera=None),
    timed("timestamp NaN", 0.0, np.nan),
    timed("timestamp a text", 0.0, "now"),
    timed("timestamps go back", 5.0, 4.0),
    timed("timestamps a day apart", 0.0, 86_400.0),
    case("box half outside", box=(-10, 40, 20, 60)),
    case("box larger than the image", box=(-100, -100, 600, 600)),
    case(
        "nothing measured in the box",
        np.where(np.indices(DEPTH.shape)[1] < WIDTH // 2, np.nan, DEPTH),
        (10, 40, 30, 60),
    ),
    case("a wall in front at update", second=np.minimum(NEXT, 1.0)),
    case("noise at update", second=np.random.default_rng(0).uniform(0.3, 8, DEPTH.shape)),
)


def framed(value: Any) -> Any:
    """A frame with depth alone, or what the case makes instead."""
    return made(value) if isinstance(value, Made) else Frame(depth=value)


def ours(name: str, **parameters: Any) -> Callable[[Case], tricue.Track]:
    """tricue's tracker of that name with the case's camera."""
    return with_tracker(lambda case: tricue.create(name, intrinsics=case.camera, **parameters), framed)


OURS = {
    "depth-particle": ours("depth-particle", seed=0),
    "flow-depth": ours("flow-depth", cues=("disparity",)),
    "fused": ours("fused"),
}

HEAD = f"""
## Depth

All other input is valid: two frames, a fifteenth of a second apart, of `tricue.scenes.walker(0)`, somebody in front of a time-of-flight
camera of {WIDTH}x{HEIGHT} pixels whose intrinsics are known; depth is float32 in meters, and the box {BOX}. `flow-depth` uses depth
alone.

Where there is color, too, `fused` ignores depth in another unit, with one warning, and follows by color. It does the same with depth that
has stayed the same for half a second while the color image changed, which two frames can't show.

"""
