# SPDX-License-Identifier: MIT
"""What the fused tracker makes of input that isn't what it expects: a named error or a sane track."""

import copy
from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue import Box, Frame, FusedTracker, Intrinsics, Status, StereoRig, Track

WIDTH, HEIGHT = SIZE = (128, 96)
BOX = (48, 29, 32, 38)
RIG = StereoRig(Intrinsics.from_fov(*SIZE, 60), 0.12)
OURS, FAR = 12, 4  # disparities of the target and of the wall, pixels


def texture(shape: tuple[int, int], seed: int) -> NDArray[np.uint8]:
    """Fine and coarse grain, BGR."""
    rng = np.random.default_rng(seed)
    height, width = shape
    coarse = rng.normal(0, 40, (height // 5 + 1, width // 5 + 1, 3))
    coarse = cv2.resize(coarse, (width, height), interpolation=cv2.INTER_CUBIC)
    levels = coarse + cv2.GaussianBlur(rng.normal(0, 40, (*shape, 3)), (0, 0), 1.0) + 128
    return np.clip(levels, 0, 255).astype(np.uint8)


WALL = texture((HEIGHT, WIDTH + FAR), 0)
TARGET = texture((BOX[3], BOX[2]), 1)


def pair(shift: int = 0) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """Left and right of a target of 32x38 pixels before a wall, which has moved to the right."""
    sides = []
    for wall, nearer in ((WALL[:, :WIDTH], 0), (WALL[:, FAR:], OURS)):
        image, x = wall.copy(), BOX[0] + shift - nearer
        image[BOX[1] : BOX[1] + BOX[3], x : x + BOX[2]] = TARGET
        sides.append(image)
    return sides[0], sides[1]


def depth_of(shift: int = 0) -> NDArray[np.float32]:
    """The same scene's depth, metres."""
    disparity = np.full((HEIGHT, WIDTH), FAR, np.float32)
    disparity[BOX[1] : BOX[1] + BOX[3], BOX[0] + shift : BOX[0] + shift + BOX[2]] = OURS
    return np.float32(RIG.intrinsics.fx * RIG.baseline) / disparity


CAMERAS = ("color", "gray", "rgbd", "pair", "gray pair", "depth")


def seen_by(camera: str, shift: int = 0, **others: Any) -> Frame:
    """The scene as one of CAMERAS has it."""
    left, right = pair(shift)
    images = {
        "color": {"color": left},
        "gray": {"color": left[..., 1]},
        "rgbd": {"color": left, "depth": depth_of(shift)},
        "pair": {"color": left, "right": right},
        "gray pair": {"color": left[..., 1], "right": right[..., 1]},
        "depth": {"depth": depth_of(shift)},
    }[camera]
    return Frame(**images, **others)


LEFT, RIGHT = pair()
DEPTH = depth_of()


def started(camera: str = "rgbd", frames: int = 3, **values: Any) -> FusedTracker:
    """A tracker that has followed BOX, which moves a pixel a frame."""
    tracker = FusedTracker(**{"rig": RIG, **values})
    tracker.init(seen_by(camera), BOX)
    for shift in range(1, 1 + frames):
        tracker.update(seen_by(camera, shift))
    return tracker


def next_of(tracker: FusedTracker, camera: str = "rgbd", shift: int = 4) -> Track:
    """What it makes of the next good frame, without being changed by that."""
    return copy.deepcopy(tracker).update(seen_by(camera, shift))


def assert_sane(track: Track) -> None:
    """A finite box with an area, a score in [0, 1], a status; position and covariance both or neither."""
    assert np.isfinite(track.box).all()
    assert min(track.box.width, track.box.height) > 0
    assert 0 <= track.score <= 1
    assert isinstance(track.status, Status)
    assert (track.position is None) == (track.covariance is None)
    if track.covariance is not None:
        assert np.isfinite(track.position).all()
        assert track.position[2] > 0
        assert np.linalg.eigvalsh(track.covariance).min() > 0


BAD_FRAMES: dict[str, tuple[Callable[[], Any], type[Exception], str]] = {
    "None": (lambda: None, TypeError, r"^frame: expected .*NoneType"),
    "list": (LEFT.tolist, TypeError, r"^frame: expected a BGR image or a tricue.Frame, got list"),
    "string": (lambda: "left.png", TypeError, r"^frame: .*got str"),
    "two images": (lambda: (LEFT, RIGHT), TypeError, r"^frame: expected .*got tuple"),
    "uint16": (lambda: LEFT.astype(np.uint16), TypeError, r"^frame.color: expected uint8 .*uint16"),
    "float": (lambda: LEFT / 255, TypeError, r"^frame.color: expected uint8 .*float64"),
    "bare depth": (lambda: DEPTH, TypeError, r"^frame.color: .*depth comes as tricue.Frame"),
    "alpha": (lambda: np.dstack([LEFT, LEFT[..., 0]]), ValueError, r"^frame.color: expected BGR .*alpha"),
    "batch": (lambda: LEFT[None], ValueError, r"^frame.color: expected BGR"),
    "empty": (lambda: LEFT[:0], ValueError, r"^frame.color: expected an image with pixels"),
    "right alone": (lambda: Frame(right=RIGHT), ValueError, r"^frame: .*got right alone"),
    "right of another size": (
        lambda: Frame(LEFT, right=RIGHT[:, 1:]),
        ValueError,
        r"^right: expected the shape of color, \(96, 128, 3\), got \(96, 127, 3\)",
    ),
    "right gray": (
        lambda: Frame(LEFT, right=RIGHT[..., 0]),
        ValueError,
        r"^right: expected the shape of color",
    ),
    "right float": (lambda: Frame(LEFT, right=RIGHT / 255), TypeError, r"^right: expected uint8 .*float64"),
    "right without color": (
        lambda: Frame(depth=DEPTH, right=RIGHT),
        ValueError,
        r"^right: expected together with color",
    ),
    "depth of another size": (
        lambda: Frame(LEFT, depth=DEPTH[::2, ::2]),
        ValueError,
        r"^frame.depth: expected shape \(96, 128\), got \(48, 64\); .*color image's pixels",
    ),
    "depth of integers": (
        lambda: Frame(LEFT, depth=(1000 * DEPTH).astype(np.uint16)),
        ValueError,
        r"^depth: expected depth_scale with integers",
    ),
    "depth in color": (lambda: Frame(LEFT, depth=LEFT), ValueError, r"^depth: expected one value a pixel"),
    "empty depth": (lambda: Frame(depth=DEPTH[:0]), ValueError, r"^depth: expected one value a pixel"),
    "smaller": (
        lambda: LEFT[:-1],
        ValueError,
        r"^frame.color: expected .* \(?(96, 128|128x96)\)?, got \(?(95, 128|128x95)",
    ),
    "smaller depth": (
        lambda: Frame(depth=DEPTH[:-1]),
        ValueError,
        r"^frame.depth: expected .* \(?(96, 128|128x96)\)?, got \(?(95, 128|128x95)",
    ),
    "turned": (lambda: LEFT.transpose(1, 0, 2).copy(), ValueError, r"^frame.color: expected .*128"),
    "seconds in words": (lambda: Frame(LEFT, timestamp="now"), TypeError, r"^timestamp: expected"),
    "NaN seconds": (lambda: Frame(LEFT, timestamp=np.nan), ValueError, r"^timestamp: expected"),
}


@pytest.mark.parametrize("camera", ["color", "rgbd"])
@pytest.mark.parametrize("case", BAD_FRAMES)
def test_bad_frames_are_named(case, camera):
    """What is no frame gets an error that says so, at init and update, and the old target is followed on as
    if it had not come.
    """
    frame, error, words = BAD_FRAMES[case]
    tracker = started(camera)
    expected = next_of(tracker, camera)
    with pytest.raises(error, match=words):
        tracker.update(frame())
    if case != "smaller depth":  # what init refuses it for is another test
        with pytest.raises(error, match=words):
            tracker.init(frame(), BOX)
    assert tracker.update(seen_by(camera, 4)) == expected


@pytest.mark.parametrize("first", CAMERAS)
@pytest.mark.parametrize("then", CAMERAS)
@pytest.mark.parametrize("shape", [(48, 64), (128, 96)], ids=str)
def test_another_size_is_named(shape, first, then):
    """A frame of another size than the first, whatever channels either has, is an error that names the
    channel and says both sizes; nothing changes by it.
    """
    tracker = FusedTracker()
    tracker.init(seen_by(first), BOX)
    expected = next_of(tracker, first, 1)
    frame = seen_by(then)
    others = {name: getattr(frame, name) for name in frame.channels}
    images = {name: np.resize(image, shape + image.shape[2:]) for name, image in others.items()}
    channel = "depth" if then == "depth" else "color"
    sizes = rf"expected the first frame's size \(96, 128\), got \({shape[0]}, {shape[1]}\)"
    with pytest.raises(ValueError, match=f"^frame.{channel}: {sizes}"):
        tracker.update(Frame(**images))
    assert tracker.update(seen_by(first, 1)) == expected


def test_init_takes_another_size():
    """init starts again on another size, and follows there."""
    tracker = started("rgbd", rig=None)
    images = (np.ascontiguousarray(pair(shift)[0][10:90, 20:]) for shift in range(4))
    tracks = [tracker.init(next(images), (28, 19, 32, 38)), *map(tracker.update, images)]
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].box.iou(Box(31, 19, 32, 38)) > 0.8


@pytest.mark.parametrize("camera", CAMERAS)
def test_every_camera_is_followed(camera):
    """Each set of channels, gray images among them, is followed; those with depth give the right distance."""
    tracker = started(camera, 7)
    track = tracker.update(seen_by(camera, 8))
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 8, *BOX[1:])) > 0.7
    if camera in ("color", "gray"):
        assert track.position is None
    else:
        assert track.position[2] == pytest.approx(RIG.depth(OURS), rel=0.05)


def test_gray_is_three_equal_channels():
    """A gray frame, (H, W) or (H, W, 1), gives the track of the same levels in all three, bit for bit."""
    runs = []
    for layout in (lambda g: g, lambda g: g[..., None], lambda g: np.dstack([g, g, g])):
        tracker = FusedTracker(rig=RIG)
        pairs = [[layout(image[..., 0]) for image in pair(shift)] for shift in range(4)]
        frames = [Frame(left, right=right) for left, right in pairs]
        runs.append([tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])])
    assert runs[0] == runs[1] == runs[2]


def test_calibrations_of_another_size_are_named():
    """A first frame of another size than the rig's camera's or the camera's is an error that says both."""
    small, box = Frame(LEFT[::2, ::2], right=RIGHT[::2, ::2]), (24, 15, 16, 19)
    with pytest.raises(ValueError, match=r"^frame.color: expected the camera's size, 128x96, got 64x48"):
        FusedTracker(rig=RIG).init(small, box)
    small = Frame(depth=DEPTH[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.depth: expected the camera's size, 128x96, got 64x48"):
        FusedTracker(intrinsics=RIG.intrinsics).init(small, box)


@pytest.mark.parametrize(
    ("cameras", "frame", "channel"),
    [
        ({"rig": RIG}, Frame(LEFT[::2, ::2]), "color"),
        ({"intrinsics": RIG.intrinsics}, Frame(depth=DEPTH[::2, ::2]), "depth"),
        ({"rig": RIG}, Frame(depth=DEPTH[::2, ::2]), "depth"),
        ({"intrinsics": RIG.intrinsics}, Frame(LEFT[::2, ::2]), "color"),
    ],
    ids=["rig, color", "camera, depth", "rig, depth", "camera, color"],
)
def test_calibrations_of_another_size_name_the_channel(cameras, frame, channel):
    """The error begins with the channel that the frame has."""
    with pytest.raises(ValueError, match=rf"^frame.{channel}: expected .*128x96, got 64x48"):
        FusedTracker(**cameras).init(frame, (24, 15, 16, 19))


@pytest.mark.parametrize(
    "rig", [RIG.intrinsics, 0.12, "rig.yml", StereoRig, np.eye(3), {}], ids=lambda r: type(r).__name__
)
def test_what_is_no_calibration_is_named(rig):
    """A rig or camera of another type is a TypeError that names it, and so are both at once."""
    with pytest.raises(TypeError, match=r"^rig: expected tricue.StereoRig, got "):
        FusedTracker(rig=rig)
    if not isinstance(rig, Intrinsics):
        with pytest.raises(TypeError, match=r"^intrinsics: expected tricue.Intrinsics, got "):
            FusedTracker(intrinsics=rig)
    with pytest.raises(TypeError, match=r"^intrinsics: expected without rig"):
        FusedTracker(rig=RIG, intrinsics=RIG.intrinsics)


@pytest.mark.parametrize(
    ("seed", "error"),
    [(-1, ValueError), (0.5, TypeError), ("0", TypeError), (None, TypeError), (True, TypeError)],
)
def test_bad_seeds_are_named(seed, error):
    """A seed that isn't a whole number from 0 on is an error that names it."""
    with pytest.raises(error, match=r"^seed: expected"):
        FusedTracker(seed=seed)


def test_bad_kernels_are_named():
    """A set of kernels that there isn't is an error that names it."""
    with pytest.raises(ValueError, match=r"^kernels: expected"):
        FusedTracker(kernels="fast")


BAD_BOXES: dict[str, tuple[Any, type[Exception], str]] = {
    "None": (None, ValueError, "expected"),
    "string": ("1,2,3,4", TypeError, "expected four numbers"),
    "bools": ([True, True, True, True], TypeError, "expected four numbers"),
    "three numbers": ((1, 2, 3), ValueError, "expected four numbers"),
    "matrix": (np.ones((1, 4)), TypeError, "expected four numbers"),
    "NaN": ((1, np.nan, 3, 4), ValueError, "expected finite numbers"),
    "infinite": ((1, 2, np.inf, 4), ValueError, "expected finite numbers"),
    "zero": ((0, 0, 0, 0), ValueError, "expected width and height above 0"),
    "negative height": ((50, 50, 9, -9), ValueError, "corners swapped"),
    "1 px": ((50, 50, 1, 1), ValueError, "at least 2 pixels"),
    "1 px by 300": ((50, -100, 1, 300), ValueError, "at least 2 pixels"),
    "right of the image": ((128, 10, 20, 20), ValueError, "a part inside the image of 128x96"),
    "above the image": ((10, -20, 20, 20), ValueError, "a part inside the image of 128x96"),
    "far away": ((1e300, 0, 10, 10), ValueError, "expected at most a million pixels"),
    "denormal": ((50, 50, 5e-324, 5e-324), ValueError, "at least 2 pixels"),
}
GOOD_BOXES: dict[str, Any] = {
    "list": list(BOX),
    "array": np.array(BOX, np.float32),
    "uint8": tuple(np.array(BOX, np.uint8)),
    "fractions": (47.6, 29.3, 32.7, 37.9),
    "the wall": (90, 10, 25, 25),
    "half outside": (-15, -12, 40, 60),
    "the whole image": (0, 0, *SIZE),
    "2 px": (60, 45, 2, 2),
    "2 px by 300": (60, -100, 2, 300),
    "300 px by 2": (-100, 45, 300, 2),
    "2 px by a million": (60, -5e5, 2, 1e6),
    "a corner": (-30, -30, 31, 31),
    "a corner inside": (127.5, 95.5, 30, 30),
    "larger than the image": (-500, -500, 2000, 2000),
    "a million pixels": (-5e5, -5e5, 1e6, 1e6),
}


@pytest.mark.parametrize("case", BAD_BOXES)
def test_bad_boxes_are_named(case):
    """init refuses a bad box, and the old target is followed on."""
    box, error, words = BAD_BOXES[case]
    tracker = started()
    expected = next_of(tracker)
    with pytest.raises(error, match=f"^box: .*{words}"):
        tracker.init(seen_by("rgbd"), box)
    assert tracker.update(seen_by("rgbd", 4)) == expected


@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
@pytest.mark.parametrize("case", GOOD_BOXES)
def test_unusual_boxes_are_followed(case, camera):
    """Any box with a part in the image starts a sane track, which begins as given, in any channels."""
    tracker = FusedTracker(rig=RIG)
    first = tracker.init(seen_by(camera), GOOD_BOXES[case])
    assert first.box == pytest.approx(tuple(map(float, GOOD_BOXES[case])))
    assert_sane(first)
    black = np.zeros_like(LEFT)
    for frame in (seen_by(camera, 2), Frame(black, right=black), seen_by(camera, 3), seen_by(camera, 4)):
        assert_sane(tracker.update(frame))


anything = st.floats() | st.floats(-300, 300) | st.integers(-(10**9), 10**9)


@settings(max_examples=100)
@given(st.tuples(*4 * [anything]), st.sampled_from(["color", "rgbd", "pair", "depth"]))
def test_any_four_numbers(box, camera):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning."""
    tracker = FusedTracker(rig=RIG)
    try:
        tracks = [tracker.init(seen_by(camera), box)]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    for track in [*tracks, tracker.update(seen_by(camera)), tracker.update(seen_by("rgbd", 3))]:
        assert_sane(track)


STRIPES = np.tile(np.uint8([[[0] * 3, [255] * 3]]), (HEIGHT, WIDTH // 2, 1))
PAIRS: dict[str, tuple[NDArray[np.uint8], NDArray[np.uint8]]] = {
    "black": (np.zeros_like(LEFT), np.zeros_like(LEFT)),
    "white": (np.full_like(LEFT, 255), np.full_like(LEFT, 255)),
    "left black": (np.zeros_like(LEFT), RIGHT),
    "right black": (LEFT, np.zeros_like(LEFT)),
    "noise": tuple(np.random.default_rng(1).integers(0, 256, (2, *LEFT.shape), np.uint8)),
    "the same twice": (LEFT, LEFT),
    "swapped": (RIGHT, LEFT),
    "far apart": (LEFT, np.roll(LEFT, -60, axis=1)),
    "rows apart": (LEFT, np.roll(RIGHT, 5, axis=0)),
    "stripes": (STRIPES, STRIPES),
    "mirrored": (LEFT[:, ::-1], RIGHT[:, ::-1]),
    "negative": (255 - LEFT, 255 - RIGHT),
}
DEPTHS: dict[str, NDArray[np.float32]] = {
    "NaN": np.full_like(DEPTH, np.nan),
    "zero": np.zeros_like(DEPTH),
    "infinite": np.full_like(DEPTH, np.inf),
    "negative": -DEPTH,
    "denormal": np.where(DEPTH > 2, np.float32(1e-45), DEPTH),
    "all denormal": np.full_like(DEPTH, 1e-45),
    "huge": np.where(DEPTH > 2, DEPTH, np.float32(3e38)),
    "one pixel": np.where(np.arange(WIDTH) == 60, DEPTH, np.float32(np.nan)),
    "noise": np.random.default_rng(3).uniform(0.3, 9, DEPTH.shape).astype(np.float32),
    "flat": np.full_like(DEPTH, 2.0),
}
ODD = {
    **{f"pair, {name}": lambda name=name: Frame(PAIRS[name][0], right=PAIRS[name][1]) for name in PAIRS},
    **{f"rgbd, {name}": lambda name=name: Frame(LEFT, depth=DEPTHS[name]) for name in DEPTHS},
    **{f"depth, {name}": lambda name=name: Frame(depth=DEPTHS[name]) for name in DEPTHS},
    **{f"color, {name}": lambda name=name: Frame(PAIRS[name][0]) for name in PAIRS},
}


@pytest.mark.parametrize("name", ODD)
@pytest.mark.filterwarnings("ignore:depth. its median")
def test_odd_frames_are_sane(name):
    """Pictures and depths with nothing in them, or nonsense, give sane tracks at the start and later, and so
    do good frames of any channels after them.
    """
    odd = ODD[name]()
    for camera in ("color", "rgbd", "pair", "depth"):
        tracker = FusedTracker(rig=RIG)
        frames = [odd, odd, seen_by(camera, 2), odd]
        for track in [tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])]:
            assert_sane(track)
        tracker = started(camera, 2)
        for frame in [*(4 * [odd]), seen_by(camera, 2), seen_by(camera, 3)]:
            assert_sane(tracker.update(frame))


@pytest.mark.parametrize("name", ["NaN", "zero"])
def test_depth_that_measures_nothing_gives_no_position(name):
    """Color with an empty depth image is followed by color, without a position."""
    tracker = FusedTracker(rig=RIG)
    frames = [Frame(pair(shift)[0], depth=DEPTHS[name]) for shift in range(6)]
    tracks = [tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])]
    assert all(track.position is None for track in tracks)
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].box.iou(Box(BOX[0] + 5, *BOX[1:])) > 0.7


@pytest.mark.parametrize("name", ["black", "white", "noise"])
@pytest.mark.parametrize("camera", ["color", "pair", "rgbd", "depth"])
def test_a_frame_without_the_target_is_not_tracked(camera, name):
    """A frame without the target is no error: it isn't TRACKED, and is in the third good one after two."""
    tracker = started(camera, 6)
    blank = {
        "color": Frame(PAIRS[name][0]),
        "pair": Frame(PAIRS[name][0], right=PAIRS[name][1]),
        "rgbd": Frame(PAIRS[name][0], depth=DEPTHS["NaN"]),
        "depth": Frame(depth=2 * DEPTHS[{"black": "NaN", "white": "flat", "noise": "noise"}[name]]),
    }[camera]
    assert Status.TRACKED not in {tracker.update(blank).status for _ in range(2)}
    track = [tracker.update(seen_by(camera, shift)) for shift in (9, 10, 11)][-1]
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 11, *BOX[1:])) > 0.6


@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
@pytest.mark.parametrize(
    "shape", [(1, 1), (1, 2), (2, 2), (3, 3), (1, 300), (300, 1), (16, 16), (3000, 4000), (4, 5000)], ids=str
)
def test_images_of_any_size(shape, camera):
    """Tiny, thin and huge frames of all channels give sane tracks, without a warning."""
    height, width = shape
    left = np.resize(np.tile(LEFT, (32, 32, 1)) if height > 999 else LEFT, (*shape, 3))
    images = {
        "color": {"color": left},
        "rgbd": {"color": left, "depth": 1 + left[..., 0] / np.float32(99)},
        "pair": {"color": left, "right": np.roll(left, -max(1, width // 12), axis=1)},
        "depth": {"depth": 1 + left[..., 0] / np.float32(99)},
    }[camera]
    frame, tracker = Frame(**images), FusedTracker()
    box = (-2, -2, max(0.4 * width, 4), max(0.5 * height, 4))
    others = [frame, Frame(255 - left), frame]
    for track in [tracker.init(frame, box), *map(tracker.update, others)]:
        assert_sane(track)


VIEWS: dict[str, Callable[[NDArray[Any]], NDArray[Any]]] = {
    "crop": lambda image: np.pad(image, ((5, 3), (7, 9), *(image.ndim - 2) * [(0, 0)]))[5:-3, 7:-9],
    "mirrored": lambda image: image[:, ::-1].copy()[:, ::-1],
    "upside down": lambda image: image[::-1].copy()[::-1],
    "Fortran": np.asfortranarray,
    "big endian": lambda image: image.astype(image.dtype.newbyteorder(">")),
    "every second": lambda image: image.repeat(2, 0).repeat(2, 1)[::2, ::2],
}


@pytest.mark.parametrize("name", VIEWS)
def test_views_are_read_as_they_look(name):
    """Crops, mirrored, reversed and read-only arrays give the track of a packed copy, bit for bit."""
    runs = []
    for layout in (VIEWS[name], np.ascontiguousarray):
        frames = []
        for shift in range(3):
            images = [layout(image) for image in (*pair(shift), depth_of(shift))]
            for image in images:
                image.setflags(write=False)
            frames += [Frame(images[0], right=images[1]), Frame(images[0], images[2]), Frame(depth=images[2])]
        tracker = FusedTracker(rig=RIG)
        runs.append([tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])])
    assert runs[0] == runs[1]


@pytest.mark.parametrize(
    "seconds", [(0.0, 0.0), (5.0, 4.0), (-1e300, -1e301), (None, 1.0), (1.0, None)], ids=str
)
@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
def test_times_that_tell_nothing(camera, seconds):
    """Times that stand still, go back or are missing count as a frame at the usual rate."""
    usual, odd = FusedTracker(rig=RIG), FusedTracker(rig=RIG)
    usual.init(seen_by(camera), BOX)
    odd.init(seen_by(camera, timestamp=seconds[0]), BOX)
    assert odd.update(seen_by(camera, 1, timestamp=seconds[1])) == usual.update(seen_by(camera, 1))


@pytest.mark.parametrize("seconds", [(0.0, 1e12), (-1e300, 1e300), (0.0, 1e-300), (0.0, 5e-324)], ids=str)
@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
def test_leaping_times_are_sane(camera, seconds):
    """Times that leap or hardly move give sane tracks."""
    tracker = FusedTracker(rig=RIG)
    tracker.init(seen_by(camera, timestamp=seconds[0]), BOX)
    for shift in range(1, 4):
        assert_sane(tracker.update(seen_by(camera, shift, timestamp=seconds[1] * shift)))


@pytest.mark.parametrize(
    "rig",
    [
        StereoRig(Intrinsics.from_fov(*SIZE, 179.0), 0.12),
        StereoRig(Intrinsics.from_fov(*SIZE, 0.5), 0.12),
        StereoRig(RIG.intrinsics, 1e-6),
        StereoRig(RIG.intrinsics, 1.9),
        StereoRig(Intrinsics(110.0, 1e-3, 64, 48, *SIZE), 0.12),
        StereoRig(Intrinsics(110.0, 110.0, -1e6, 1e6, *SIZE), 0.12),
    ],
    ids=["fisheye", "telescope", "no baseline", "wide baseline", "flat pixels", "far principal point"],
)
@pytest.mark.parametrize("camera", ["rgbd", "pair", "depth"])
def test_degenerate_rigs_are_sane(camera, rig):
    """A rig of numbers that no camera has gives sane tracks."""
    tracker = FusedTracker(rig=rig)
    black = Frame(np.zeros_like(LEFT), right=np.zeros_like(LEFT))
    frames = [seen_by(camera), seen_by(camera, 1), black, seen_by(camera, 2)]
    for track in [tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])]:
        assert_sane(track)


@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
def test_long_lost_is_sane(camera):
    """Sixty frames without the target leave a sane track, which is LOST: no number runs away."""
    tracker = started(camera)
    gone = Frame(np.zeros_like(LEFT), right=np.zeros_like(LEFT))
    if camera in ("rgbd", "depth"):
        gone = Frame(None if camera == "depth" else gone.color, np.full_like(DEPTH, np.nan))
    for _ in range(60):
        track = tracker.update(gone)
    assert_sane(track)
    assert track.status is Status.LOST


def test_two_times_the_same_frame():
    """A frame that comes twice, as of a camera too slow, loses nothing."""
    tracker = started("rgbd")
    for shift in range(4, 14):
        for _ in range(2):
            track = tracker.update(seen_by("rgbd", shift))
            assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 13, *BOX[1:])) > 0.7


def test_update_before_init():
    """update says that init comes first, also after an init that failed."""
    tracker = FusedTracker()
    for _ in range(2):
        with pytest.raises(RuntimeError, match=r"^update: expected init first"):
            tracker.update(LEFT)
        with pytest.raises(ValueError, match=r"^box: "):
            tracker.init(LEFT, (0, 0, 0, 0))


KERNELS = {
    "sample_windows": "color",
    "gradient_color_cells": "color",
    "correlation_response": "color",
    "correlation_train": "color",
    "scale_response": "color",
    "learn_contrast": "color",
    "joint_histogram": "color",
    "pyramid_flow": "color",
    "flow_scale": "color",
    "depth_posterior": "rgbd",
    "kalman_predict": "rgbd",
    "kalman_update": "rgbd",
    "back_project": "rgbd",
    "sad_disparity": "pair",
}


@pytest.mark.parametrize("kernel", KERNELS)
def test_an_error_inside_leaves_the_state(kernel, monkeypatch: pytest.MonkeyPatch):
    """An error in the middle of an update, of whatever kind, leaves the tracker as it was; the update is one
    in which it learns.
    """
    camera, frames = KERNELS[kernel], FusedTracker.Params().learn_every - 1
    tracker = started(camera, frames)
    expected = next_of(tracker, camera, frames + 1)

    def fail(*_: Any) -> None:
        raise MemoryError

    with monkeypatch.context() as patch:
        patch.setattr(tracker._k, kernel, fail)
        with pytest.raises(MemoryError):
            tracker.update(seen_by(camera, frames + 1))
    assert tracker.update(seen_by(camera, frames + 1)) == expected
