# SPDX-License-Identifier: MIT
"""What the fused tracker makes of input that isn't what it expects: a named error or a sane track."""

import copy
from typing import Any

import bad_input_cases as cases
import cv2
import numpy as np
import pytest
from bad_input_cases import HEIGHT, RIG, WIDTH
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue import Box, Frame, FusedTracker, Intrinsics, Status, Track

BOX = (48, 29, 32, 38)
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
    """The same scene's depth, meters."""
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


BAD_FRAMES: cases.BadFrames = {
    **cases.NO_FRAMES,
    **cases.NO_IMAGES,
    **cases.BARE_DEPTHS,
    **cases.NO_PAIRS,
    **cases.NO_DEPTHS,
    **cases.UNREGISTERED,
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


@pytest.mark.parametrize("rig", cases.NO_RIGS, ids=lambda each: type(each).__name__)
def test_what_is_no_calibration_is_named(rig):
    """A rig or camera of another type is a TypeError that names it, and so are both at once."""
    with pytest.raises(TypeError, match=r"^rig: expected tricue.StereoRig, got "):
        FusedTracker(rig=rig)
    if not isinstance(rig, Intrinsics):
        with pytest.raises(TypeError, match=r"^intrinsics: expected tricue.Intrinsics, got "):
            FusedTracker(intrinsics=rig)
    with pytest.raises(TypeError, match=r"^intrinsics: expected without rig"):
        FusedTracker(rig=RIG, intrinsics=RIG.intrinsics)


BAD_BOXES = {**cases.BAD_BOXES, "None": (None, ValueError, "expected")}
GOOD_BOXES = {**cases.same_box(BOX), **cases.ODD_BOXES, "fractions": (47.6, 29.3, 32.7, 37.9)}


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
    cases.assert_sane(first)
    black = np.zeros_like(LEFT)
    for frame in (seen_by(camera, 2), Frame(black, right=black), seen_by(camera, 3), seen_by(camera, 4)):
        cases.assert_sane(tracker.update(frame))


@settings(max_examples=100)
@given(cases.boxes, st.sampled_from(["color", "rgbd", "pair", "depth"]))
def test_any_four_numbers(box, camera):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning."""
    others = [seen_by(camera), seen_by("rgbd", 3)]
    cases.sane_from(FusedTracker(rig=RIG), seen_by(camera), box, others)


PAIRS = cases.odd_pairs(LEFT, RIGHT)
DEPTHS = cases.odd_depths(DEPTH)
ODD = {
    **{f"pair, {name}": lambda name=name: Frame(PAIRS[name][0], right=PAIRS[name][1]) for name in PAIRS},
    **{f"rgbd, {name}": lambda name=name: Frame(LEFT, depth=DEPTHS[name]) for name in DEPTHS},
    **{
        f"depth, {name}": lambda name=name: Frame(depth=DEPTHS[name])
        for name in DEPTHS
        if name != "all denormal"  # an error, see test_depth_trust.py
    },
    **{f"color, {name}": lambda name=name: Frame(PAIRS[name][0]) for name in PAIRS},
}


@pytest.mark.parametrize("name", ODD)
@pytest.mark.filterwarnings("ignore:depth. its median", "ignore:frame.depth. expected meters", "ignore:right")
def test_odd_frames_are_sane(name):
    """Pictures and depths with nothing in them, or nonsense, give sane tracks at the start and later, and so
    do good frames of any channels after them.
    """
    odd = ODD[name]()
    for camera in ("color", "rgbd", "pair", "depth"):
        tracker = FusedTracker(rig=RIG)
        frames = [odd, odd, seen_by(camera, 2), odd]
        for track in [tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])]:
            cases.assert_sane(track)
        tracker = started(camera, 2)
        for frame in [*(4 * [odd]), seen_by(camera, 2), seen_by(camera, 3)]:
            cases.assert_sane(tracker.update(frame))


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
@pytest.mark.parametrize("shape", [*cases.ANY_SHAPES, (2, 2), (3000, 4000)], ids=str)
@pytest.mark.filterwarnings(
    "ignore:right:", "ignore:depth. seems"
)  # a pattern that repeats itself matches anywhere
def test_images_of_any_size(shape, camera):
    """Tiny, thin and huge frames of all channels give sane tracks, without another warning."""
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
        cases.assert_sane(track)


@pytest.mark.parametrize("name", cases.VIEWS)
def test_views_are_read_as_they_look(name):
    """Crops, mirrored, reversed and read-only arrays give the track of a packed copy, bit for bit."""
    runs = []
    for layout in (cases.VIEWS[name], np.ascontiguousarray):
        frames = []
        for shift in range(3):
            images = [layout(image) for image in (*pair(shift), depth_of(shift))]
            for image in images:
                image.setflags(write=False)
            frames += [Frame(images[0], right=images[1]), Frame(images[0], images[2]), Frame(depth=images[2])]
        tracker = FusedTracker(rig=RIG)
        runs.append([tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])])
    assert runs[0] == runs[1]


@pytest.mark.parametrize("seconds", cases.STILL_TIMES, ids=str)
@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
def test_times_that_tell_nothing(camera, seconds):
    """Times that stand still, go back or are missing count as a frame at the usual rate."""
    usual, odd = FusedTracker(rig=RIG), FusedTracker(rig=RIG)
    usual.init(seen_by(camera), BOX)
    odd.init(seen_by(camera, timestamp=seconds[0]), BOX)
    assert odd.update(seen_by(camera, 1, timestamp=seconds[1])) == usual.update(seen_by(camera, 1))


@pytest.mark.parametrize("seconds", cases.LEAPING_TIMES, ids=str)
@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
def test_leaping_times_are_sane(camera, seconds):
    """Times that leap or hardly move give sane tracks."""
    tracker = FusedTracker(rig=RIG)
    tracker.init(seen_by(camera, timestamp=seconds[0]), BOX)
    for shift in range(1, 4):
        cases.assert_sane(tracker.update(seen_by(camera, shift, timestamp=seconds[1] * shift)))


@pytest.mark.parametrize("rig", cases.DEGENERATE_RIGS.values(), ids=cases.DEGENERATE_RIGS)
@pytest.mark.parametrize("camera", ["rgbd", "pair", "depth"])
def test_degenerate_rigs_are_sane(camera, rig):
    """A rig of numbers that no camera has gives sane tracks."""
    tracker = FusedTracker(rig=rig)
    black = Frame(np.zeros_like(LEFT), right=np.zeros_like(LEFT))
    frames = [seen_by(camera), seen_by(camera, 1), black, seen_by(camera, 2)]
    for track in [tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])]:
        cases.assert_sane(track)


@pytest.mark.parametrize("camera", ["color", "rgbd", "pair", "depth"])
def test_long_lost_is_sane(camera):
    """Sixty frames without the target leave a sane track, which is LOST: no number runs away."""
    tracker = started(camera)
    gone = Frame(np.zeros_like(LEFT), right=np.zeros_like(LEFT))
    if camera in ("rgbd", "depth"):
        gone = Frame(None if camera == "depth" else gone.color, np.full_like(DEPTH, np.nan))
    for _ in range(60):
        track = tracker.update(gone)
    cases.assert_sane(track)
    assert track.status is Status.LOST


def test_two_times_the_same_frame():
    """A frame that comes twice, as of a camera too slow, loses nothing."""
    tracker = started("rgbd")
    for shift in range(4, 14):
        for _ in range(2):
            track = tracker.update(seen_by("rgbd", shift))
            assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 13, *BOX[1:])) > 0.7


KERNELS = {
    "sample_windows": "color",
    "localize_target": "color",
    "log_polar_shift": "color",
    "learn_place_filter": "color",
    "learn_patch_colors": "color",
    "learn_size_filter": "color",
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
    camera, frames = KERNELS[kernel], round(30 * FusedTracker.Params().learn_every) - 1
    following = seen_by(camera, frames + 1)
    cases.assert_errors_leave_the_state(started(camera, frames), kernel, following, monkeypatch)
