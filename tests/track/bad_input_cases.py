# SPDX-License-Identifier: MIT
"""Bad and odd input that no tracker expects, the same for all; each tracker's test_bad_input.py adds its own.

A bad case is what to make or give, the error, and what its message matches.
"""

import copy
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue import Frame, Intrinsics, Status, StereoRig, Track
from tricue.camera.frame import FrameLike
from tricue.track.base.track import Tracker

Image = NDArray[np.uint8]
Depth = NDArray[np.float32]
BadFrames = dict[str, tuple[Callable[[], Any], type[Exception], str]]
BadBoxes = dict[str, tuple[Any, type[Exception], str]]

WIDTH, HEIGHT = SIZE = (128, 96)
CAMERA = Intrinsics.from_fov(*SIZE, 60)
RIG = StereoRig(CAMERA, 0.12)
OTHER_SHAPES = [(48, 64), (192, 256), (96, 127), (128, 96)]
ANY_SHAPES = [(1, 1), (1, 2), (3, 3), (1, 300), (300, 1), (16, 16), (1500, 2000), (4, 5000)]

LEFT, RIGHT = np.random.default_rng(0).integers(0, 256, (2, HEIGHT, WIDTH, 3), np.uint8)
METERS = np.full((HEIGHT, WIDTH), 2.0, np.float32)
MILLIMETERS = (1000 * METERS).astype(np.uint16)

NO_FRAMES: BadFrames = {
    "None": (lambda: None, TypeError, r"^frame: expected a BGR image .*NoneType.*cv2.imread"),
    "list": (LEFT.tolist, TypeError, r"^frame: expected a BGR image or a tricue.Frame, got list"),
    "string": (lambda: "frame.png", TypeError, r"^frame: .*got str"),
    "two images": (lambda: (LEFT, RIGHT), TypeError, r"^frame: expected .*got tuple"),
    "seconds in words": (lambda: Frame(LEFT, timestamp="now"), TypeError, r"^timestamp: expected"),
    "NaN seconds": (lambda: Frame(LEFT, timestamp=np.nan), ValueError, r"^timestamp: expected"),
    "nothing": (Frame, ValueError, r"^frame: expected color or depth, got neither"),
}
"""For every tracker."""

NO_IMAGES: BadFrames = {
    "uint16": (lambda: LEFT.astype(np.uint16), TypeError, r"^frame.color: expected uint8 .*uint16"),
    "float": (lambda: LEFT / 255, TypeError, r"^frame.color: expected uint8 .*float64"),
    "float32 0..1": (
        lambda: LEFT.astype(np.float32) / 255,
        TypeError,
        r"^frame.color: expected uint8 .*float32",
    ),
    "bool": (lambda: LEFT > 9, TypeError, r"^frame.color: expected uint8 .*bool"),
    "object": (lambda: LEFT.astype(object), TypeError, r"^frame.color: expected uint8 .*object"),
    "two channels": (lambda: LEFT[..., :2], ValueError, r"^frame.color: expected BGR .*\(96, 128, 2\)"),
    "RGBA": (lambda: np.dstack([LEFT, LEFT[..., 0]]), ValueError, r"^frame.color: expected BGR .*alpha"),
    "batch": (lambda: LEFT[None], ValueError, r"^frame.color: expected BGR .*\(1, 96, 128, 3\)"),
    "scalar": (lambda: np.array(7, np.uint8), ValueError, r"^frame.color: expected BGR .*uint8 \(\)"),
    "empty": (lambda: LEFT[:0], ValueError, r"^frame.color: expected an image with pixels"),
    "no columns": (lambda: LEFT[:, :0], ValueError, r"^frame.color: expected an image with pixels"),
}
"""Bare arrays, for a tracker that takes a bare image."""

BARE_DEPTHS: BadFrames = {
    "float depth": (lambda: METERS, TypeError, r"^frame.color: .*float32.*; depth comes as .*\(depth=image"),
    "16-bit depth": (
        lambda: MILLIMETERS,
        TypeError,
        r"^frame.color: .*uint16.*; depth comes as .*\(depth=image",
    ),
}
"""For every tracker."""

NO_PAIRS: BadFrames = {
    "right alone": (
        lambda: Frame(right=RIGHT),
        ValueError,
        r"^frame: expected color or depth, got right alone",
    ),
    "right without color": (
        lambda: Frame(depth=METERS, right=RIGHT),
        ValueError,
        r"^right: expected together with color",
    ),
    "right of another size": (
        lambda: Frame(LEFT, right=RIGHT[:, 1:]),
        ValueError,
        r"^right: expected the shape of color, \(96, 128, 3\), got \(96, 127, 3\)",
    ),
    "right gray": (
        lambda: Frame(LEFT, right=RIGHT[..., 0]),
        ValueError,
        r"^right: expected the shape of color, \(96, 128, 3\), got \(96, 128\)",
    ),
    "left with alpha": (
        lambda: Frame(np.dstack([LEFT, LEFT[..., 0]]), right=RIGHT),
        ValueError,
        r"^color: expected BGR .*drops the alpha",
    ),
    "right with alpha": (
        lambda: Frame(LEFT, right=np.dstack([RIGHT, RIGHT[..., 0]])),
        ValueError,
        r"^right: expected BGR .*drops the alpha",
    ),
    "left float": (lambda: Frame(LEFT / 255, right=RIGHT), TypeError, r"^color: expected uint8 .*float64"),
    "right float": (lambda: Frame(LEFT, right=RIGHT / 255), TypeError, r"^right: expected uint8 .*float64"),
    "right 16 bits": (
        lambda: Frame(LEFT, right=RIGHT.astype(np.uint16)),
        TypeError,
        r"^right: expected uint8 .*uint16",
    ),
    "right bool": (lambda: Frame(LEFT, right=RIGHT > 99), TypeError, r"^right: expected uint8 .*bool"),
    "right a list": (lambda: Frame(LEFT, right=RIGHT.tolist()), TypeError, r"^right: expected a NumPy array"),
    "right a file": (lambda: Frame(LEFT, right="r.png"), TypeError, r"^right: expected a NumPy .*got str"),
    "both empty": (
        lambda: Frame(LEFT[:0], right=RIGHT[:0]),
        ValueError,
        r"^color: expected an image with pixels",
    ),
    "right empty": (
        lambda: Frame(LEFT, right=RIGHT[:0]),
        ValueError,
        r"^right: expected an image with pixels",
    ),
    "batch of pairs": (lambda: Frame(LEFT[None], right=RIGHT[None]), ValueError, r"^color: expected BGR"),
}
"""For a tracker that takes a pair."""

ONE_IMAGE: BadFrames = {
    "bare image": (lambda: LEFT, ValueError, r"^frame: expected the channel right.*got color"),
    "no right image": (lambda: Frame(LEFT), ValueError, r"^frame: expected the channel right.*got color"),
    "side by side": (lambda: np.hstack([LEFT, RIGHT]), ValueError, r"^frame: expected the channel right"),
    "depth alone": (
        lambda: Frame(depth=METERS),
        ValueError,
        r"^frame: expected the channel color.*got depth",
    ),
}
"""For a tracker that color alone isn't enough for, and depth alone neither."""

NO_DEPTHS: BadFrames = {
    "depth of integers": (
        lambda: Frame(depth=MILLIMETERS),
        ValueError,
        r"^depth: expected depth_scale with integers",
    ),
    "depth of 8 bits": (lambda: Frame(depth=LEFT[..., 0]), TypeError, r"^depth: expected float32 .*uint8"),
    "depth in color": (lambda: Frame(LEFT, depth=LEFT), ValueError, r"^depth: expected one value a pixel"),
    "depth of bools": (lambda: Frame(depth=METERS > 3), TypeError, r"^depth: expected float32 .*bool"),
    "complex depth": (
        lambda: Frame(depth=METERS.astype(complex)),
        TypeError,
        r"^depth: expected .*complex",
    ),
    "half floats": (lambda: Frame(depth=METERS.astype(np.float16)), TypeError, r"^depth: .*float16"),
    "depth of objects": (lambda: Frame(depth=METERS.astype(object)), TypeError, r"^depth: .*object"),
    "depth of lists": (
        lambda: Frame(depth=METERS.tolist()),
        TypeError,
        r"^depth: expected a NumPy array, got list",
    ),
    "empty depth": (lambda: Frame(depth=METERS[:0]), ValueError, r"^depth: expected one value a pixel"),
    "depth without columns": (
        lambda: Frame(depth=METERS[:, :0]),
        ValueError,
        r"^depth: expected one value a pixel",
    ),
    "batch of depths": (lambda: Frame(depth=METERS[None]), ValueError, r"^depth: expected one value a pixel"),
    "scale -1": (lambda: Frame(depth=MILLIMETERS, depth_scale=-1), ValueError, r"^depth_scale: expected"),
    "scale 0": (lambda: Frame(depth=MILLIMETERS, depth_scale=0), ValueError, r"^depth_scale: expected"),
    "scale NaN": (
        lambda: Frame(depth=MILLIMETERS, depth_scale=np.nan),
        ValueError,
        r"^depth_scale: expected",
    ),
    "scale in words": (
        lambda: Frame(depth=MILLIMETERS, depth_scale="mm"),
        TypeError,
        r"^depth_scale: expected",
    ),
}
"""For a tracker that takes depth."""

UNREGISTERED: BadFrames = {
    "depth of another size": (
        lambda: Frame(LEFT, depth=METERS[::2, ::2]),
        ValueError,
        r"^frame.depth: expected shape \(96, 128\), got \(48, 64\); .*color image's pixels",
    )
}
"""For a tracker that takes color and depth together."""

BAD_BOXES: BadBoxes = {
    "string": ("1,2,3,4", TypeError, "expected four numbers"),
    "strings": (["1", "2", "3", "4"], TypeError, "expected four numbers"),
    "bools": ([True, True, True, True], TypeError, "expected four numbers"),
    "three numbers": ((1, 2, 3), ValueError, "expected four numbers"),
    "five numbers": ((1, 2, 3, 4, 5), ValueError, "expected four numbers"),
    "two corners": (((1, 2), (3, 4)), TypeError, "expected four numbers"),
    "matrix": (np.ones((1, 4)), TypeError, "expected four numbers"),
    "number": (7, TypeError, "expected four numbers"),
    "complex": ((1, 2, 3j, 4), TypeError, "expected four numbers"),
    "NaN": ((1, np.nan, 3, 4), ValueError, "expected finite numbers"),
    "infinite": ((1, 2, np.inf, 4), ValueError, "expected finite numbers"),
    "zero width": ((1, 2, 0, 4), ValueError, "expected width and height above 0"),
    "zero": ((0, 0, 0, 0), ValueError, "expected width and height above 0"),
    "negative height": ((50, 50, 9, -9), ValueError, "corners swapped"),
    "1 px": ((50, 50, 1, 1), ValueError, "at least 2 pixels"),
    "1 px by 300": ((50, -100, 1, 300), ValueError, "at least 2 pixels"),
    "right of the image": ((128, 10, 20, 20), ValueError, "a part inside the image of 128x96"),
    "above the image": ((10, -20, 20, 20), ValueError, "a part inside the image of 128x96"),
    "far away": ((1e300, 0, 10, 10), ValueError, "expected at most a million pixels"),
    "denormal": ((50, 50, 5e-324, 5e-324), ValueError, "at least 2 pixels"),
}
"""For every tracker; whether one needs a box is its own."""

ODD_BOXES: dict[str, Any] = {
    "2 px": (60, 45, 2, 2),
    "2 px by 300": (60, -100, 2, 300),
    "300 px by 2": (-100, 45, 300, 2),
    "2 px by a million": (60, -5e5, 2, 1e6),
    "a million by 2 px": (-5e5, 45, 1e6, 2),
    "a corner": (-30, -30, 31, 31),
    "a corner inside": (127.5, 95.5, 30, 30),
    "half outside": (-15, -12, 40, 60),
    "the wall": (90, 10, 25, 25),
    "the whole image": (0, 0, *SIZE),
    "larger than the image": (-500, -500, 2000, 2000),
    "much larger": (-5000, -5000, 10_100, 10_100),
    "a million pixels": (-5e5, -5e5, 1e6, 1e6),
}
"""Boxes that are no mistake, of images of SIZE."""

STILL_TIMES = [(0.0, 0.0), (5.0, 4.0), (-1e300, -1e301), (None, 1.0), (1.0, None)]
LEAPING_TIMES = [(0.0, 3e10), (-1e300, 3e10), (0.0, 1e-300), (0.0, 5e-324)]
ODD_TIMES = [*STILL_TIMES, *LEAPING_TIMES]
"""Timestamps of two frames that tell nothing of the time between them, or too much."""

NO_RIGS = [RIG.intrinsics, 0.12, "rig.yml", StereoRig, np.eye(3), {}]
NO_CAMERAS = [(100, 100, 64, 48), 60, "camera.yml", Intrinsics, np.eye(3), RIG]
DEGENERATE_RIGS = {
    "fisheye": StereoRig(Intrinsics.from_fov(*SIZE, 179.0), 0.12),
    "telescope": StereoRig(Intrinsics.from_fov(*SIZE, 0.5), 0.12),
    "no baseline": StereoRig(CAMERA, 1e-6),
    "wide baseline": StereoRig(CAMERA, 1.9),
    "flat pixels": StereoRig(Intrinsics(110.0, 1e-3, 64, 48, *SIZE), 0.12),
    "far principal point": StereoRig(Intrinsics(110.0, 110.0, -1e6, 1e6, *SIZE), 0.12),
}

VIEWS: dict[str, Callable[[NDArray[Any]], NDArray[Any]]] = {
    "crop": lambda image: np.pad(image, ((3, 2), (5, 7), *(image.ndim - 2) * [(0, 0)]))[3:-2, 5:-7],
    "mirrored": lambda image: np.ascontiguousarray(image[:, ::-1])[:, ::-1],
    "upside down": lambda image: np.ascontiguousarray(image[::-1])[::-1],
    "Fortran": np.asfortranarray,
    "transposed": lambda image: np.ascontiguousarray(image.swapaxes(0, 1)).swapaxes(0, 1),
    "every other pixel": lambda image: image.repeat(2, 0).repeat(2, 1)[::2, ::2],
    "other byte order": lambda image: image.astype(image.dtype.newbyteorder()),
    "read-only": lambda image: np.frombuffer(image.tobytes(), image.dtype).reshape(image.shape),
}
"""Layouts of any image in memory."""

COLOR_VIEWS: dict[str, Callable[[Image], Image]] = {
    **VIEWS,
    "channels reversed": lambda image: np.ascontiguousarray(image[..., ::-1])[..., ::-1],
    "three of four channels": lambda image: np.dstack([image, image[..., 0]])[..., :3],
}
"""The same of a BGR image."""

numbers = st.floats() | st.floats(-300, 300) | st.integers(-(10**9), 10**9)
boxes = st.tuples(*4 * [numbers])


def same_box(box: tuple[int, ...]) -> dict[str, Any]:
    """A box of whole numbers up to 255 in other types."""
    return {
        "list": list(box),
        "array": np.array(box, np.float32),
        "NumPy integers": tuple(np.array(box)),
        "uint8": tuple(np.array(box, np.uint8)),
    }


def odd_pairs(left: Image, right: Image) -> dict[str, tuple[Image, Image]]:
    """Pairs with nothing in them, or nonsense, and what can be made of a good one."""
    rng, (height, width) = np.random.default_rng(1), left.shape[:2]
    black, white = np.zeros_like(left), np.full_like(left, 255)
    stripes = np.tile(np.array([[[0] * 3, [255] * 3]], np.uint8), (height, width // 2, 1))
    noise = rng.integers(0, 256, (3, *left.shape), np.uint8)
    lines = [
        np.where(np.arange(width)[:, None] == column, white, black)
        for column in (width // 2, width // 2 - 12)
    ]
    return {
        "black": (black, black),
        "white": (white, white),
        "gray": (np.full_like(left, 127), np.full_like(left, 127)),
        "left black": (black, right),
        "right black": (left, black),
        "right white": (left, white),
        "noise": (noise[0], noise[1]),
        "the same noise": (noise[2], noise[2]),
        "the same twice": (left, left),
        "swapped": (right, left),
        "far apart": (left, np.roll(left, -60, axis=1)),
        "rows apart": (left, np.roll(right, 5, axis=0)),
        "stripes": (stripes, stripes),
        "one pixel": (lines[0], lines[1]),
        "mirrored": (left[:, ::-1], right[:, ::-1]),
        "negative": (255 - left, 255 - right),
    }


def odd_depths(depth: Depth) -> dict[str, Depth]:
    """Depth images with nothing in them, or nonsense, and what can be made of a good one, meters."""
    far, columns = depth > 2, np.arange(depth.shape[1])
    return {
        "NaN": np.full_like(depth, np.nan),
        "zero": np.zeros_like(depth),
        "infinite": np.full_like(depth, np.inf),
        "negative": -depth,
        "denormal": np.where(far, np.float32(1e-45), depth),
        "all denormal": np.full_like(depth, 1e-45),
        "huge": np.where(far, depth, np.float32(3e38)),
        "one pixel": np.where(columns == 60, depth, np.float32(np.nan)),
        "noise": np.random.default_rng(3).uniform(0.3, 9, depth.shape).astype(np.float32),
        "flat": np.full_like(depth, 2.0),
    }


def assert_sane(track: Track) -> None:
    """A finite box with an area, a score in [0, 1], a status; position and covariance both or neither."""
    assert np.isfinite(track.box).all()
    assert min(track.box.width, track.box.height) > 0
    assert 0 <= track.score <= 1
    assert isinstance(track.status, Status)
    assert (track.position is None) == (track.covariance is None)
    if track.covariance is not None:
        assert track.position is not None
        assert np.isfinite(track.position).all()
        assert track.position[2] > 0
        assert np.linalg.eigvalsh(track.covariance).min() > 0


def sane_from(tracker: Tracker, frame: FrameLike, box: Any, others: Iterable[FrameLike]) -> bool:
    """Whether it starts on the box, and is sane there and ever after; where not, the error names the box."""
    try:
        first = tracker.init(frame, box)
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return False
    for track in [first, *map(tracker.update, others)]:
        assert_sane(track)
    return True


def assert_init_comes_first(tracker: Tracker, frame: FrameLike) -> None:
    """Update before init, and after an init that failed, is a RuntimeError that says what to do."""
    for _ in range(2):
        with pytest.raises(RuntimeError, match=r"^update: expected init first"):
            tracker.update(frame)
        with pytest.raises(ValueError, match=r"^box: "):
            tracker.init(frame, (0, 0, 0, 0))


def assert_errors_leave_the_state(
    tracker: Any, kernel: str, frame: FrameLike, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An error in a kernel in the middle of an update leaves the tracker as it was."""
    expected = copy.deepcopy(tracker).update(frame)

    def fail(*_: Any, **__: Any) -> None:
        raise MemoryError

    with monkeypatch.context() as patch:
        patch.setattr(tracker._k, kernel, fail)
        with pytest.raises(MemoryError):
            tracker.update(frame)
    assert tracker.update(frame) == expected
