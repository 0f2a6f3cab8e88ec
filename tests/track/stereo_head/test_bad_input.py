# SPDX-License-Identifier: MIT
"""What the stereo head tracker makes of input that isn't what it expects: a named error or a sane track."""

import contextlib
import copy
import warnings
from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue import Box, Frame, Intrinsics, Status, StereoHeadTracker, StereoRig, Track

Image = NDArray[np.uint8]
WIDTH, HEIGHT = SIZE = (128, 96)
BOX = (48, 29, 32, 38)
RIG = StereoRig(Intrinsics.from_fov(*SIZE, 60), 0.12)
NEAR, FAR = 12, 4  # disparities of the head and of the wall, pixels: 1.1 and 3.3 m


def texture(shape: tuple[int, int], color: tuple[int, ...], spread: int, seed: int) -> Image:
    """Fine and coarse grain about a color, BGR."""
    rng = np.random.default_rng(seed)
    height, width = shape
    coarse = cv2.resize(
        rng.normal(0, spread, (height // 5 + 1, width // 5 + 1)),
        (width, height),
        interpolation=cv2.INTER_CUBIC,
    )
    levels = coarse + rng.normal(0, spread / 3, shape)
    return np.clip(levels[..., None] + color, 0, 255).astype(np.uint8)


WALL = texture((HEIGHT, WIDTH + FAR), (130, 150, 90), 40, 0)
FACE = texture((BOX[3], BOX[2]), (110, 140, 200), 25, 1)


def pair(shift: int = 0) -> tuple[Image, Image]:
    """Left and right of a head of 32x38 pixels before a wall, which has moved to the right."""
    left, right = WALL[:, :WIDTH].copy(), WALL[:, FAR:].copy()
    x, y, width, height = BOX
    rows, columns = np.indices((height, width)) + 0.5
    oval = ((columns / width - 0.5) ** 2 + (rows / height - 0.5) ** 2 < 0.25)[..., None]
    for side, at in ((left, x + shift), (right, x + shift - NEAR)):
        place = np.s_[y : y + height, at : at + width]
        side[place] = np.where(oval, FACE, side[place])
    return left, right


def framed(shift: int = 0, **others: Any) -> Frame:
    """That pair as a frame."""
    left, right = pair(shift)
    return Frame(left, right=right, **others)


LEFT, RIGHT = pair()
FIRST, NEXT = framed(), framed(2)
DEPTH = np.full((HEIGHT, WIDTH), 2.0, np.float32)

BAD_FRAMES: dict[str, tuple[Callable[[], Any], type[Exception], str]] = {
    "None": (lambda: None, TypeError, r"^frame: expected .*NoneType"),
    "list": (LEFT.tolist, TypeError, r"^frame: expected .*got list"),
    "string": (lambda: "left.png", TypeError, r"^frame: .*got str"),
    "two images": (lambda: (LEFT, RIGHT), TypeError, r"^frame: expected .*got tuple"),
    "bare image": (lambda: LEFT, ValueError, r"^frame: expected the channel right.*got color"),
    "no right image": (lambda: Frame(LEFT), ValueError, r"^frame: expected the channel right.*got color"),
    "right alone": (
        lambda: Frame(right=RIGHT),
        ValueError,
        r"^frame: expected color or depth, got right alone",
    ),
    "depth alone": (lambda: Frame(depth=DEPTH), ValueError, r"^frame: expected the channel color.*got depth"),
    "color and depth": (
        lambda: Frame(LEFT, depth=DEPTH),
        ValueError,
        r"^frame: expected the channel right.*got color and depth",
    ),
    "right of another size": (
        lambda: Frame(LEFT, right=RIGHT[:, 1:]),
        ValueError,
        r"^right: expected the shape of color, \(96, 128, 3\), got \(96, 127, 3\)",
    ),
    "right grey": (
        lambda: Frame(LEFT, right=RIGHT[..., 0]),
        ValueError,
        r"^right: expected the shape of color, \(96, 128, 3\), got \(96, 128\)",
    ),
    "both grey": (
        lambda: Frame(LEFT[..., 0], right=RIGHT[..., 0]),
        ValueError,
        r"^frame.color: expected BGR .*grey .*cv2.COLOR_GRAY2BGR",
    ),
    "both of one channel": (
        lambda: Frame(LEFT[..., :1], right=RIGHT[..., :1]),
        ValueError,
        r"^frame.color: expected BGR .*grey",
    ),
    "alpha": (
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
    "right a file": (
        lambda: Frame(LEFT, right="right.png"),
        TypeError,
        r"^right: expected a NumPy .*got str",
    ),
    "empty": (lambda: Frame(LEFT[:0], right=RIGHT[:0]), ValueError, r"^color: expected an image with pixels"),
    "right empty": (
        lambda: Frame(LEFT, right=RIGHT[:0]),
        ValueError,
        r"^right: expected an image with pixels",
    ),
    "batch": (lambda: Frame(LEFT[None], right=RIGHT[None]), ValueError, r"^color: expected BGR"),
    "side by side": (lambda: np.hstack([LEFT, RIGHT]), ValueError, r"^frame: expected the channel right"),
    "seconds in words": (lambda: framed(timestamp="now"), TypeError, r"^timestamp: expected"),
    "NaN seconds": (lambda: framed(timestamp=np.nan), ValueError, r"^timestamp: expected"),
}

VIEWS: dict[str, Callable[[Image], Image]] = {
    "crop": lambda image: np.pad(image, ((3, 2), (5, 7), (0, 0)))[3:-2, 5:-7],
    "mirrored": lambda image: np.ascontiguousarray(image[:, ::-1])[:, ::-1],
    "upside down": lambda image: np.ascontiguousarray(image[::-1])[::-1],
    "channels reversed": lambda image: np.ascontiguousarray(image[..., ::-1])[..., ::-1],
    "Fortran": np.asfortranarray,
    "every other pixel": lambda image: image.repeat(2, 0).repeat(2, 1)[::2, ::2],
    "three of four channels": lambda image: np.dstack([image, image[..., 0]])[..., :3],
    "read-only": lambda image: np.frombuffer(image.tobytes(), np.uint8).reshape(image.shape),
}

BAD_BOXES: dict[str, tuple[Any, type[Exception], str]] = {
    "string": ("1,2,3,4", TypeError, "expected four numbers"),
    "bools": ([True, True, True, True], TypeError, "expected four numbers"),
    "three numbers": ((1, 2, 3), ValueError, "expected four numbers"),
    "matrix": (np.ones((1, 4)), TypeError, "expected four numbers"),
    "number": (7, TypeError, "expected four numbers"),
    "NaN": ((1, np.nan, 3, 4), ValueError, "expected finite numbers"),
    "infinite": ((1, 2, np.inf, 4), ValueError, "expected finite numbers"),
    "zero": ((0, 0, 0, 0), ValueError, "expected width and height above 0"),
    "negative height": ((50, 50, 9, -9), ValueError, "corners swapped"),
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
    "the wall": (90, 10, 25, 25),
    "half outside": (-15, -12, 40, 60),
    "the whole image": (0, 0, *SIZE),
}

ODD_BOXES: dict[str, Any] = {
    "2 px": (60, 45, 2, 2),
    "2 px by 300": (60, -100, 2, 300),
    "300 px by 2": (-100, 45, 300, 2),
    "a corner": (-30, -30, 31, 31),
    "larger than the image": (-500, -500, 2000, 2000),
    "much larger": (-5000, -5000, 10_100, 10_100),
    "a million pixels": (-5e5, -5e5, 1e6, 1e6),
}

FRAMES: dict[str, tuple[Image, Image]] = {
    "black": (np.zeros_like(LEFT), np.zeros_like(LEFT)),
    "white": (np.full_like(LEFT, 255), np.full_like(LEFT, 255)),
    "grey": (np.full_like(LEFT, 127), np.full_like(LEFT, 127)),
    "left black": (np.zeros_like(LEFT), RIGHT),
    "right black": (LEFT, np.zeros_like(LEFT)),
    "right white": (LEFT, np.full_like(LEFT, 255)),
    "noise": tuple(np.random.default_rng(1).integers(0, 256, (2, *LEFT.shape), np.uint8)),
    "the same noise": tuple(2 * [np.random.default_rng(2).integers(0, 256, LEFT.shape, np.uint8)]),
    "the same twice": (LEFT, LEFT),
    "swapped": (RIGHT, LEFT),
    "far apart": (LEFT, np.roll(LEFT, -60, axis=1)),
    "rows apart": (LEFT, np.roll(RIGHT, 5, axis=0)),
    "stripes": tuple(2 * [np.tile(np.uint8([[[0] * 3, [255] * 3]]), (HEIGHT, WIDTH // 2, 1))]),
    "one pixel": tuple(
        np.where(np.arange(WIDTH)[None, :, None] == 64 - d, np.uint8(255), np.zeros_like(LEFT))
        for d in (0, 12)
    ),
    "mirrored": (LEFT[:, ::-1], RIGHT[:, ::-1]),
    "negative": (255 - LEFT, 255 - RIGHT),
}


def odd(name: str) -> Frame:
    """The frame of that name."""
    left, right = FRAMES[name]
    return Frame(left, right=right)


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


def started(**parameters: Any) -> StereoHeadTracker:
    """A tracker that follows BOX in FIRST."""
    tracker = StereoHeadTracker(**{"rig": RIG, **parameters})
    tracker.init(FIRST, BOX)
    tracker.update(framed(1))
    return tracker


def quiet_init(tracker: StereoHeadTracker, frame: Frame, box: Any) -> Track:
    """Init without the warnings of pairs that look swapped or unrectified, which are no matter here."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "right: ", UserWarning)
        return tracker.init(frame, box)


EXPECTED = started().update(NEXT)


def test_all_is_well():
    """The pair that the cases below spoil is followed: the head is where it was drawn, at its distance."""
    assert EXPECTED.status is Status.TRACKED
    assert EXPECTED.box.iou(Box(BOX[0] + 2, *BOX[1:])) > 0.8
    assert EXPECTED.position[2] == pytest.approx(RIG.depth(NEAR), rel=0.02)


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_bad_frames_are_named(name):
    """What is no pair of color images gets an error that says so, at init and update, and nothing changes."""
    frame, error, message = BAD_FRAMES[name]
    tracker = started()
    with pytest.raises(error, match=message):
        tracker.update(frame())
    with pytest.raises(error, match=message):
        tracker.init(frame(), BOX)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("name", BAD_BOXES)
def test_bad_boxes_are_named(name):
    """A box that can't be started on gets an error that names it, and the old target is followed on."""
    box, error, message = BAD_BOXES[name]
    tracker = started()
    with pytest.raises(error, match=f"^box: .*{message}"):
        tracker.init(FIRST, box)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("name", ["black", "white", "grey", "right black"])
def test_a_start_on_nothing_is_named(name):
    """A pair in which nothing in the box has a disparity is an error that shows box and range, and the old
    target is followed on.
    """
    tracker = started()
    message = r"^box: expected a head with a disparity between near and far, 0.4 and 6 m, got none in \(48"
    with pytest.raises(ValueError, match=message):
        quiet_init(tracker, odd(name), BOX)
    assert tracker.update(NEXT) == EXPECTED


def test_a_box_on_a_bare_patch_is_named():
    """A box on a patch without texture is an error that shows it, though there is some round it."""
    left, right = (image.copy() for image in pair())
    left[5:60, 80:125] = right[5:60, 60:125] = 128
    tracker = started()
    with pytest.raises(ValueError, match=r"^box: expected .*a disparity .*got none in \(90.*12"):
        quiet_init(tracker, Frame(left, right=right), (90, 12, 25, 30))
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize(("near", "far"), [(0.4, 0.9), (1.3, 1.6)])
def test_a_box_on_what_is_out_of_range_is_no_head_there(near, far):
    """A head nearer or farther than it may be isn't measured at its own distance: an error, or a track inside
    the range.
    """
    tracker = StereoHeadTracker(rig=RIG, near=near, far=far)
    try:
        track = tracker.init(FIRST, BOX)
    except ValueError as error:
        assert str(error).startswith("box: expected a head with a disparity")  # noqa: PT017
        return
    assert_sane(track)
    assert 0.9 * near < track.position[2] < 1.1 * far


@pytest.mark.parametrize("shape", [(48, 64), (192, 256), (96, 127), (128, 96)], ids=str)
def test_another_size_is_named(shape):
    """A pair of another size than the first is an error that says both, and nothing changes by it."""
    tracker = started()
    other = np.zeros((*shape, 3), np.uint8)
    expected = (
        rf"^frame.color: expected the first frame's shape \(96, 128, 3\), got \({shape[0]}, {shape[1]}, 3\)"
    )
    with pytest.raises(ValueError, match=expected):
        tracker.update(Frame(other, right=other))
    assert tracker.update(NEXT) == EXPECTED


def test_a_rig_of_another_size_is_named():
    """A first pair of another size than the rig's is an error that says both, and nothing changes."""
    tracker = started()
    small = Frame(LEFT[::2, ::2], right=RIGHT[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.color: expected the rig's size, 128x96, got 64x48"):
        tracker.init(small, (24, 15, 16, 19))
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize(
    "rig", [RIG.intrinsics, 0.12, "rig.yml", StereoRig, np.eye(3)], ids=lambda r: str(type(r))
)
def test_what_is_no_rig_is_named(rig):
    """A rig of another type is a TypeError that names it."""
    with pytest.raises(TypeError, match=r"^rig: expected tricue.StereoRig, got "):
        StereoHeadTracker(rig=rig)


def test_update_before_init_is_named():
    """Update before init, and after an init that failed, is a RuntimeError that says what to do."""
    tracker = StereoHeadTracker()
    with pytest.raises(RuntimeError, match=r"^update: expected init first"):
        tracker.update(FIRST)
    with pytest.raises(ValueError, match=r"^box: "):
        tracker.init(FIRST, (0, 0, 0, 0))
    with pytest.raises(RuntimeError, match=r"^update: expected init first"):
        tracker.update(FIRST)


def test_swapped_images_are_warned_of():
    """A start with left and right swapped warns, and points at the line that called init."""
    tracker, frame = StereoHeadTracker(rig=RIG), Frame(RIGHT, right=LEFT)
    expected = pytest.warns(UserWarning, match=r"^right: left and right seem to be swapped")
    with expected as caught, contextlib.suppress(ValueError):
        tracker.init(frame, BOX)
    assert [each.filename for each in caught] == [__file__]


def test_an_unrectified_pair_is_warned_of():
    """A start on a pair whose rows are off warns, and says what to do."""
    frame = Frame(LEFT, right=np.roll(RIGHT, 4, axis=0))
    tracker = StereoHeadTracker(rig=RIG)
    message = r"^right: .*not to be rectified.*differ by 4.0 px.*rectify"
    with pytest.warns(UserWarning, match=message), contextlib.suppress(ValueError):
        tracker.init(frame, BOX)


def test_a_good_pair_is_not_warned_of():
    """Neither a start nor an update on a rectified pair warns, nor an update on any: it is checked once."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tracker = started()
        tracker.update(odd("swapped"))
        tracker.update(odd("rows apart"))


@pytest.mark.parametrize(
    "name", ["black", "white", "grey", "left black", "right black", "right white", "noise", "far apart"]
)
def test_a_pair_without_the_head_is_an_occlusion(name):
    """A pair in which the head isn't to be seen is OCCLUDED at score 0, no error; in the next it is TRACKED
    again.
    """
    tracker = started()
    hidden = tracker.update(odd(name))
    assert_sane(hidden)
    assert hidden.status is Status.OCCLUDED
    assert hidden.score == 0
    assert tracker.update(NEXT).status is Status.TRACKED


def test_two_times_the_left_image_is_no_head():
    """A pair whose right image is the left one once more has no depth: disparity 0 is never taken for the
    head's, until long lost, and the head is found again after it.
    """
    tracker = started()
    for _ in range(30):
        track = tracker.update(odd("the same twice"))
        assert_sane(track)
        assert track.status is not Status.TRACKED
    again = [tracker.update(NEXT) for _ in range(15)]
    assert again[-1].status is Status.TRACKED
    assert again[-1].box.iou(EXPECTED.box) > 0.5


@pytest.mark.parametrize("far", [6.0, 20.0, 1e4])
def test_a_start_on_two_times_the_left_image_is_sane(far):
    """Nothing but disparity 0, which is no distance, is an error that names the box, or gives sane tracks,
    however far a head may be.
    """
    tracker = StereoHeadTracker(rig=RIG, far=far)
    try:
        tracks = [quiet_init(tracker, odd("the same twice"), BOX)]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    for track in [*tracks, tracker.update(odd("the same twice")), tracker.update(NEXT)]:
        assert_sane(track)


@pytest.mark.parametrize("kernels", ["native", "reference"])
@pytest.mark.parametrize("name", FRAMES)
def test_odd_frames_are_sane(name, kernels):
    """Empty, uniform, noisy and swapped pairs give sane tracks until long lost, as does the next good one."""
    tracker = started(kernels=kernels, lost_after=0.1, again_after=0.05)
    for _ in range(5):
        assert_sane(tracker.update(odd(name)))
    assert_sane(tracker.update(NEXT))


@pytest.mark.parametrize("name", FRAMES)
def test_starts_on_odd_frames_are_sane(name):
    """A box on an odd pair is refused by name or gives sane tracks, there and on good pairs."""
    tracker = StereoHeadTracker(rig=RIG)
    try:
        tracks = [quiet_init(tracker, odd(name), BOX)]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    tracks += [tracker.update(each) for each in (odd(name), NEXT, NEXT, NEXT, odd(name), NEXT)]
    for track in tracks:
        assert_sane(track)


@pytest.mark.parametrize("name", VIEWS)
def test_views_are_read_as_they_look(name):
    """Crops, mirrored, reversed and read-only arrays give the track of a packed copy, bit for bit."""
    tracks = []
    for layout in (VIEWS[name], np.ascontiguousarray):
        tracker = StereoHeadTracker(rig=RIG)
        frames = [Frame(*map(layout, pair(shift)[:1]), right=layout(pair(shift)[1])) for shift in (0, 2)]
        tracks.append([tracker.init(frames[0], BOX), tracker.update(frames[1])])
    assert tracks[0] == tracks[1]


@pytest.mark.parametrize("name", GOOD_BOXES)
def test_good_boxes_are_followed(name):
    """Boxes of other number types, on the wall or over the edge give sane tracks that begin as given."""
    tracker = StereoHeadTracker(rig=RIG)
    first = tracker.init(FIRST, GOOD_BOXES[name])
    assert first.box == pytest.approx(tuple(map(float, GOOD_BOXES[name])))
    for shift in range(8):
        assert_sane(tracker.update(framed(shift)))


@pytest.mark.parametrize("name", ODD_BOXES)
def test_odd_boxes_are_sane(name):
    """Boxes that are very small or larger than the image are refused by name or give sane tracks."""
    tracker = StereoHeadTracker(rig=RIG)
    try:
        tracks = [tracker.init(FIRST, ODD_BOXES[name])]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    tracks += [tracker.update(framed(shift)) for shift in range(6)]
    tracks += [tracker.update(odd("black")) for _ in range(6)]
    for track in tracks:
        assert_sane(track)


@pytest.mark.parametrize(
    "shape", [(1, 1), (1, 2), (3, 3), (1, 300), (300, 1), (16, 16), (1500, 2000), (4, 5000)], ids=str
)
def test_images_of_any_size(shape):
    """Tiny, thin and huge pairs give sane tracks from a box over them, or name the box."""
    height, width = shape
    left = np.resize(LEFT.repeat(8, 0).repeat(8, 1) if height > 999 else LEFT, (*shape, 3))
    frame = Frame(left, right=np.roll(left, -max(1, width // 12), axis=1))
    tracker = StereoHeadTracker(rig=StereoRig(Intrinsics.from_fov(width, height, 60), 0.12))
    box = (width / 3 - 1, height / 4 - 1, width / 3 + 2, height / 2 + 2)
    try:
        tracks = [quiet_init(tracker, frame, box)]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    for track in [*tracks, *(tracker.update(frame) for _ in range(3))]:
        assert_sane(track)


@pytest.mark.parametrize(
    "seconds", [(0.0, 0.0), (5.0, 4.0), (0.0, 1e12), (-1e300, 1e300), (None, 1.0), (1.0, None)], ids=str
)
def test_odd_times_are_sane(seconds):
    """Times that stand still, go back, leap or are missing give sane tracks."""
    tracker = StereoHeadTracker(rig=RIG)
    tracker.init(framed(timestamp=seconds[0]), BOX)
    for shift in (1, 2):
        assert_sane(tracker.update(framed(shift, timestamp=seconds[1])))


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
def test_degenerate_rigs_are_sane(rig):
    """A rig of numbers that no camera has is refused by the box's name, or gives sane tracks."""
    tracker = StereoHeadTracker(rig=rig)
    try:
        tracks = [tracker.init(FIRST, BOX)]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    tracks += [tracker.update(frame) for frame in (NEXT, odd("black"), NEXT)]
    for track in tracks:
        assert_sane(track)


def test_long_lost_is_sane():
    """A thousand pairs without the head leave a sane track: no number runs away."""
    tracker = started()
    for _ in range(1000):
        track = tracker.update(odd("black"))
    assert_sane(track)
    assert track.status is Status.LOST


@pytest.mark.parametrize(
    "kernel",
    ["color_bins", "sad_disparity", "ellipse_search", "back_project", "kalman_predict", "kalman_update"],
)
def test_an_error_inside_leaves_the_state(kernel, monkeypatch: pytest.MonkeyPatch):
    """An error in the middle of an update, of whatever kind, leaves the tracker as it was."""
    tracker = started(kernels="reference")
    expected = copy.deepcopy(tracker).update(NEXT)

    def fail(*_: Any) -> None:
        raise MemoryError

    with monkeypatch.context() as patch:
        patch.setattr(tracker._k, kernel, fail)
        with pytest.raises(MemoryError):
            tracker.update(NEXT)
    assert tracker.update(NEXT) == expected


anything = st.floats() | st.floats(-300, 300) | st.integers(-(10**9), 10**9)


@settings(max_examples=200)
@given(st.tuples(*4 * [anything]))
def test_any_four_numbers(box):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning."""
    tracker = StereoHeadTracker(rig=RIG)
    try:
        tracks = [tracker.init(FIRST, box)]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    tracks += [tracker.update(FIRST), tracker.update(NEXT)]
    for track in tracks:
        assert_sane(track)
