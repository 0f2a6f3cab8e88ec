# SPDX-License-Identifier: MIT
"""What the flow and depth tracker makes of input that it doesn't expect: a named error or a sane track."""

import copy
from collections.abc import Iterable
from typing import Any

import bad_input_cases as cases
import cv2
import numpy as np
import pytest
from bad_input_cases import HEIGHT, RIG, WIDTH
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue import Box, FlowDepthTracker, Frame, Intrinsics, Status, StereoRig

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

BAD_FRAMES: cases.BadFrames = {
    **cases.NO_FRAMES,
    **cases.BARE_DEPTHS,
    **cases.NO_PAIRS,
    **cases.ONE_IMAGE,
    **cases.NO_DEPTHS,
    **cases.UNREGISTERED,
}

LACKING = [
    (FLOW, Frame(depth=DEPTH), "color"),
    (DISPARITY, Frame(LEFT), "right or depth"),
    ({}, Frame(LEFT), "right or depth"),
    ({}, Frame(depth=DEPTH), "color"),
]

BAD_BOXES = {**cases.BAD_BOXES, "none": (None, ValueError, "expected .*needs an initial box")}

GOOD_BOXES = {
    **cases.same_box(BOX),
    **{name: cases.ODD_BOXES[name] for name in ("the wall", "half outside", "the whole image")},
    "fractions": (47.6, 29.3, 32.7, 37.9),
}

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


def sane_from(tracker: FlowDepthTracker, frame: Frame, box: Any, others: Iterable[Frame]) -> bool:
    """Whether it starts on the box, and is sane there and ever after, as is its mask."""
    starts = cases.sane_from(tracker, frame, box, others)
    if starts:
        assert_mask(tracker)
    return starts


EXPECTED = started().update(NEXT)


def test_all_is_well():
    """The pair that the cases below spoil is followed: the target is where it was drawn, at its distance."""
    assert EXPECTED.status is Status.TRACKED
    assert EXPECTED.box.iou(Box(BOX[0] + 5, *BOX[1:])) > 0.8
    assert EXPECTED.position[2] == pytest.approx(RIG.depth(OURS), rel=0.03)


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_bad_frames_are_named(name):
    """What is no frame for both cues gets an error that says so, at init and update, and nothing changes."""
    frame, error, message = BAD_FRAMES[name]
    tracker = started()
    with pytest.raises(error, match=message):
        tracker.update(frame())
    with pytest.raises(error, match=message):
        tracker.init(frame(), BOX)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize(("cues", "frame", "channel"), LACKING, ids=str)
def test_missing_channels_are_named(cues, frame, channel):
    """Each choice of cues names the channel that it lacks, at init and at update."""
    tracker = FlowDepthTracker(**cues)
    message = f"^frame: expected the channel {channel}, "
    with pytest.raises(ValueError, match=message):
        tracker.init(frame, BOX)
    tracker.init(framed(), BOX)
    with pytest.raises(ValueError, match=message):
        tracker.update(frame)
    cases.assert_sane(tracker.update(NEXT))


@pytest.mark.parametrize(
    ("cues", "camera"),
    [
        ({}, "pair"),
        ({}, "rgbd"),
        (FLOW, "pair"),
        (FLOW, "rgbd"),
        (FLOW, "color"),
        (DISPARITY, "pair"),
        (DISPARITY, "rgbd"),
        (DISPARITY, "depth"),
    ],
    ids=str,
)
def test_enough_channels_are_enough(cues, camera):
    """Each choice of cues follows with the channels that it needs, and with more of them."""
    tracker = FlowDepthTracker(**cues)
    tracker.init(seen_by(camera, 0), BOX)
    for shift in range(1, 9):
        track = tracker.update(seen_by(camera, shift))
        cases.assert_sane(track)
    assert_mask(tracker)
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 8, *BOX[1:])) > 0.7


@pytest.mark.parametrize("name", BAD_BOXES)
def test_bad_boxes_are_named(name):
    """A box that can't be started on gets an error that names it, and the old target is followed on."""
    box, error, message = BAD_BOXES[name]
    tracker = started()
    with pytest.raises(error, match=f"^box: .*{message}"):
        tracker.init(framed(), box)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("name", ["black", "white", "gray", "right black", "noise"])
@pytest.mark.parametrize("cues", [{}, DISPARITY], ids=str)
def test_a_start_on_nothing_is_named(name, cues):
    """A pair in which nothing in the box has a disparity in common is an error that shows the box, and the
    old target is followed on.
    """
    tracker = started(**cues)
    expected = copy.deepcopy(tracker).update(NEXT)
    with pytest.raises(ValueError, match=r"^box: expected a target with a disparity, got hardly any in \(48"):
        tracker.init(odd(name), BOX)
    assert tracker.update(NEXT) == expected


@pytest.mark.parametrize("shape", cases.OTHER_SHAPES, ids=str)
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


def test_disparity_alone_does_without_color_in_some_frames():
    """Where only depth is measured, frames with color and without it give the same tracks, in any order."""
    with_color, without = Frame(LEFT, depth=DEPTH), Frame(depth=DEPTH)
    orders = [(without, without, without), (with_color, without, with_color), (without, with_color, without)]
    tracks = []
    for first, *others in orders:
        tracker = FlowDepthTracker(cues=("disparity",), intrinsics=cases.CAMERA)
        tracks.append([tracker.init(first, BOX), *map(tracker.update, others)])
    assert tracks[1] == tracks[2] == tracks[0]


def test_a_calibration_of_another_size_is_named():
    """A first frame of another size than the rig's or the camera's is an error that says both."""
    small = Frame(LEFT[::2, ::2], right=RIGHT[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.color: expected the rig's size, 128x96, got 64x48"):
        FlowDepthTracker(rig=RIG).init(small, (24, 15, 16, 19))
    small = Frame(LEFT[::2, ::2], depth=DEPTH[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.depth: expected the camera's size, 128x96, got 64x48"):
        FlowDepthTracker(intrinsics=RIG.intrinsics).init(small, (24, 15, 16, 19))
    with pytest.raises(ValueError, match=r"^frame.color: expected the camera's size, .*of the color image"):
        FlowDepthTracker(**FLOW, intrinsics=RIG.intrinsics).init(small, (24, 15, 16, 19))
    small = Frame(depth=DEPTH[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.depth: expected the rig's size, 128x96, got 64x48"):
        FlowDepthTracker(cues=("disparity",), rig=RIG).init(small, (24, 15, 16, 19))


@pytest.mark.parametrize("rig", cases.NO_RIGS, ids=lambda each: type(each).__name__)
def test_what_is_no_calibration_is_named(rig):
    """A rig or camera of another type is a TypeError that names it, and so are both at once."""
    with pytest.raises(TypeError, match=r"^rig: expected tricue.StereoRig, got "):
        FlowDepthTracker(rig=rig)
    if not isinstance(rig, Intrinsics):
        with pytest.raises(TypeError, match=r"^intrinsics: expected tricue.Intrinsics, got "):
            FlowDepthTracker(intrinsics=rig)
    with pytest.raises(TypeError, match=r"^intrinsics: expected without rig"):
        FlowDepthTracker(rig=RIG, intrinsics=RIG.intrinsics)


def test_update_before_init_is_named():
    """Update before init, and after an init that failed, is a RuntimeError that says what to do; there are
    neither mask nor blocks.
    """
    tracker = FlowDepthTracker()
    for _ in range(2):
        with pytest.raises(RuntimeError, match=r"^update: expected init first"):
            tracker.update(framed())
        assert tracker.mask is None
        assert tracker.blocks == ((), ())
        with pytest.raises(ValueError, match=r"^box: "):
            tracker.init(framed(), (0, 0, 0, 0))


@pytest.mark.parametrize("name", ["black", "white", "gray", "right black", "noise", "another scene"])
def test_a_frame_without_the_target_is_not_seen(name):
    """A frame without texture, or from another scene, is no error: the score is 0, the mask nearly empty, and
    the target is followed on in the next frames.
    """
    tracker = started(8)
    gone = tracker.update(odd(name))
    cases.assert_sane(gone)
    assert gone.score == 0
    assert np.mean(tracker.mask > 0) < 0.02
    tracks = [tracker.update(framed(shift)) for shift in range(10, 16)]
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].score > 0.5
    assert tracks[-1].box.iou(Box(BOX[0] + 15, *BOX[1:])) > 0.6


@pytest.mark.parametrize("name", ["black", "white", "gray"])
def test_the_second_frame_without_texture_is_not_seen(name):
    """Nor by flow alone, right after the first frame, when nobody knows how many pixels the target has."""
    tracker = FlowDepthTracker(cues=("flow",))
    tracker.init(framed(), BOX)
    assert tracker.update(odd(name)).score == 0
    assert not tracker.mask.any()


@pytest.mark.parametrize("name", ["black", "gray", "another scene", "another scene, nearer"])
def test_a_cut_is_lost(name):
    """After a cut to another scene, or to nothing, the target is LOST in the end, and nothing runs away."""
    tracker = started(8)
    tracks = [tracker.update(odd(name)) for _ in range(60)]
    for track in tracks:
        cases.assert_sane(track)
    assert tracks[-1].status is Status.LOST
    assert tracks[-1].score == 0


def test_two_times_the_same_frame():
    """A frame that comes twice, as of a camera too slow, loses nothing: the target is followed through."""
    tracker = started(8)
    for shift in range(9, 20):
        for _ in range(2):
            track = tracker.update(framed(shift))
            cases.assert_sane(track)
            assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 19, *BOX[1:])) > 0.6


def test_a_standing_target_is_followed():
    """Frames that are all the same keep the box where it is, to a tenth of its size."""
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    for _ in range(25):
        track = tracker.update(framed())
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(*BOX)) > 0.8


def test_dropped_frames_are_made_up_for():
    """Where every third frame is missing the target, two pixels on, is followed all the same."""
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    for shift in (shift for shift in range(1, 26) if shift % 3):
        track = tracker.update(framed(shift, timestamp=None))
        cases.assert_sane(track)
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 25, *BOX[1:])) > 0.6


def test_a_screen_is_an_occlusion():
    """Behind a nearer screen the target is OCCLUDED, and beyond it TRACKED again at its place."""
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    tracks = []
    for shift in range(1, 45):
        screen = 140 - 4 * shift  # comes from the right, and goes on to the left
        tracks.append(tracker.update(framed(shift, screen)))
        cases.assert_sane(tracks[-1])
    assert Status.OCCLUDED in {track.status for track in tracks}
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].box.iou(Box(BOX[0] + 44, *BOX[1:])) > 0.5


def test_leaving_the_picture_is_lost():
    """A target that walks out of the picture is LOST there, beside the picture, with finite boxes and an
    empty mask however long it stays away.
    """
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    for shift in range(1, 90):
        cases.assert_sane(tracker.update(framed(shift)))
    for _ in range(60):
        track = tracker.update(framed(90))
        cases.assert_sane(track)
    assert track.status is Status.LOST
    assert track.box.x > 0.7 * WIDTH
    assert_mask(tracker)
    assert not tracker.mask.any()


@pytest.mark.parametrize("kernels", ["native", "reference"])
@pytest.mark.parametrize("name", FRAMES)
def test_odd_frames_are_sane(name, kernels):
    """Empty, uniform, noisy and swapped pairs give sane tracks, as does the next good one."""
    tracker = started(2, kernels=kernels)
    for _ in range(2 if kernels == "reference" else 9):
        cases.assert_sane(tracker.update(odd(name)))
    cases.assert_sane(tracker.update(NEXT))
    assert_mask(tracker)


@pytest.mark.parametrize("cues", [{}, FLOW, DISPARITY], ids=str)
@pytest.mark.parametrize("name", FRAMES)
@pytest.mark.filterwarnings("ignore:right:")
def test_starts_on_odd_frames_are_sane(name, cues):
    """A box on an odd pair is refused by name or gives sane tracks, there and on good pairs."""
    others = (odd(name), NEXT, NEXT, NEXT, odd(name), NEXT)
    assert sane_from(FlowDepthTracker(rig=RIG, **cues), odd(name), BOX, others) or cues != FLOW


@pytest.mark.parametrize("cues", [{}, DISPARITY], ids=str)
@pytest.mark.parametrize("name", DEPTHS)
@pytest.mark.filterwarnings("ignore:depth. its median")
def test_odd_depths_are_sane(name, cues):
    """Depth images with nothing in them, or nonsense, give sane tracks, at the start and later, as does the
    next good one.
    """
    bad = Frame(LEFT, depth=DEPTHS[name])
    tracker = FlowDepthTracker(intrinsics=RIG.intrinsics, **cues)
    assert sane_from(tracker, seen_by("rgbd", 0), BOX, [seen_by("rgbd", 1), bad, bad, seen_by("rgbd", 4)])
    sane_from(tracker, bad, BOX, [bad, seen_by("rgbd", 2), bad])


def test_without_depth_the_target_is_not_seen():
    """Where the depth is NaN the target isn't seen, rather than followed by flow alone, and then LOST; with
    the depth it comes back.
    """
    tracker = FlowDepthTracker(intrinsics=RIG.intrinsics)
    tracker.init(seen_by("rgbd", 0), BOX)
    for shift in range(1, 8):
        tracker.update(seen_by("rgbd", shift))
    tracks = [tracker.update(Frame(pair(shift)[0], depth=DEPTHS["NaN"])) for shift in range(8, 18)]
    assert {track.score for track in tracks} == {0}
    assert tracks[-1].status is Status.LOST
    again = [tracker.update(seen_by("rgbd", shift)) for shift in range(18, 24)]
    assert again[-1].status is Status.TRACKED
    assert again[-1].box.iou(Box(BOX[0] + 23, *BOX[1:])) > 0.6


@pytest.mark.parametrize("gray", [False, True])
@pytest.mark.parametrize("name", cases.COLOR_VIEWS)
def test_views_are_read_as_they_look(name, gray):
    """Crops, mirrored, reversed and read-only arrays give the track of a packed copy, bit for bit; so do gray
    ones.
    """
    tracks = []
    for layout in (cases.COLOR_VIEWS[name], np.ascontiguousarray):
        tracker = FlowDepthTracker(rig=RIG)
        both = [
            [layout(side)[..., 1] if gray else layout(side) for side in pair(shift)] for shift in range(4)
        ]
        frames = [Frame(left, right=right) for left, right in both]
        tracks.append([tracker.init(frames[0], BOX), *map(tracker.update, frames[1:])])
    assert tracks[0] == tracks[1]


@pytest.mark.parametrize("name", GOOD_BOXES)
def test_good_boxes_are_followed(name):
    """Boxes of other number types, on the wall or over the edge give sane tracks that begin as given."""
    tracker = FlowDepthTracker(rig=RIG)
    first = tracker.init(framed(), GOOD_BOXES[name])
    assert first.box == pytest.approx(tuple(map(float, GOOD_BOXES[name])))
    for shift in range(8):
        cases.assert_sane(tracker.update(framed(shift)))


@pytest.mark.parametrize("cues", [{}, FLOW], ids=str)
@pytest.mark.parametrize("name", cases.ODD_BOXES)
def test_odd_boxes_are_sane(name, cues):
    """Boxes that are very small or larger than the image are refused by name or give sane tracks."""
    others = [*map(framed, range(6)), *6 * [odd("black")]]
    assert sane_from(FlowDepthTracker(rig=RIG, **cues), framed(), cases.ODD_BOXES[name], others) or not cues


@pytest.mark.parametrize("cues", [{}, FLOW, DISPARITY], ids=str)
@pytest.mark.parametrize("shape", cases.ANY_SHAPES, ids=str)
@pytest.mark.filterwarnings("ignore:right:")
def test_images_of_any_size(shape, cues):
    """Tiny, thin and huge pairs give sane tracks from a box over them, or name the box."""
    height, width = shape
    left = np.resize(LEFT.repeat(8, 0).repeat(8, 1) if height > 999 else LEFT, (*shape, 3))
    frame = Frame(left, right=np.roll(left, -max(1, width // 12), axis=1))
    tracker = FlowDepthTracker(rig=StereoRig(Intrinsics.from_fov(width, height, 60), 0.12), **cues)
    box = (width / 3 - 1, height / 4 - 1, width / 3 + 2, height / 2 + 2)
    moved = Frame(np.roll(left, 1, axis=1), right=np.roll(frame.right, 1, axis=1))
    if sane_from(tracker, frame, box, [frame, moved, frame]):
        assert tracker.mask.shape == shape


@pytest.mark.parametrize("seconds", cases.ODD_TIMES, ids=str)
def test_odd_times_are_sane(seconds):
    """Times that stand still, go back, leap or are missing give sane tracks."""
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(timestamp=seconds[0]), BOX)
    black = np.zeros_like(LEFT)
    for shift in (1, 2):
        cases.assert_sane(tracker.update(framed(shift, timestamp=seconds[1])))
        cases.assert_sane(tracker.update(Frame(black, right=black, timestamp=seconds[1])))


@pytest.mark.parametrize("rig", cases.DEGENERATE_RIGS.values(), ids=cases.DEGENERATE_RIGS)
def test_degenerate_rigs_are_sane(rig):
    """A rig of numbers that no camera has is refused by the box's name, or gives sane tracks."""
    sane_from(FlowDepthTracker(rig=rig), framed(), BOX, [framed(1), odd("black"), framed(3)])


@pytest.mark.parametrize("disparity", [3, 1, 0, -1, -4])
@pytest.mark.parametrize("later", [2, 0, -2, -5])
@pytest.mark.filterwarnings("ignore:right:")
def test_disparities_of_nothing_real_are_sane(disparity, later):
    """Pairs whose disparity gets zero or less, as of badly rectified ones, give sane tracks: no box turns
    inside out, nothing is divided by zero.
    """
    wide = texture((HEIGHT, WIDTH + 40), 5)

    def at(shift: int, d: int) -> Frame:
        first = 20 - shift
        return Frame(wide[:, first : first + WIDTH], right=wide[:, first + d : first + d + WIDTH])

    others = [at(shift, disparity) for shift in range(1, 4)] + [at(shift, later) for shift in range(4, 10)]
    assert sane_from(FlowDepthTracker(rig=RIG), at(0, disparity), BOX, others)


def test_long_lost_is_sane():
    """A thousand pairs without the target leave a sane track: no number runs away."""
    tracker = started()
    for _ in range(1000):
        track = tracker.update(odd("black"))
    cases.assert_sane(track)
    assert_mask(tracker)
    assert track.status is Status.LOST


@pytest.mark.parametrize(
    "kernel",
    [
        "pyramid_flow",
        "gradient_disparity",
        "target_model",
        "observe_target",
        "block_votes",
        "target_outline",
        "back_project",
    ],
)
def test_an_error_inside_leaves_the_state(kernel, monkeypatch: pytest.MonkeyPatch):
    """An error in the middle of an update, of whatever kind, leaves the tracker as it was."""
    tracker = started(kernels="reference")
    before = tracker.mask

    def fail(*_: Any, **__: Any) -> None:
        raise MemoryError

    with monkeypatch.context() as patch:
        patch.setattr(tracker._k, kernel, fail)
        with pytest.raises(MemoryError):
            tracker.update(NEXT)
    np.testing.assert_array_equal(tracker.mask, before)
    cases.assert_errors_leave_the_state(tracker, kernel, NEXT, monkeypatch)


PAIRS = [framed(shift) for shift in range(3)]


@settings(max_examples=100)
@given(cases.boxes)
def test_any_four_numbers(box):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning."""
    sane_from(FlowDepthTracker(rig=RIG), PAIRS[0], box, PAIRS[1:])


images = st.sampled_from([*FRAMES, *range(12)])


@settings(max_examples=60)
@given(st.lists(images, min_size=1, max_size=8))
def test_any_order_of_frames(names):
    """Good, odd and repeated frames in any order give sane tracks: no crash, no warning."""
    frames = [odd(name) if isinstance(name, str) else framed(name) for name in names]
    assert sane_from(FlowDepthTracker(rig=RIG), framed(), BOX, frames)


@settings(max_examples=40)
@given(st.integers(0, 2**32), st.integers(1, 40), st.integers(1, 40), st.integers(-20, 20))
@pytest.mark.filterwarnings("ignore:right:")
def test_any_picture(seed, height, width, disparity):
    """Pictures of noise of any small size, moved by any disparity, give sane tracks or name the box."""
    rng = np.random.default_rng(seed)
    frames = []
    for _ in range(3):
        left = rng.integers(0, 256, (height, width), np.uint8)
        frames.append(Frame(left, right=np.roll(left, -disparity, axis=1)))
    box = (width * 0.2, height * 0.2, max(width * 0.6, 2), max(height * 0.6, 2))
    for cues in ({}, FLOW, DISPARITY):
        sane_from(FlowDepthTracker(**cues), frames[0], box, frames[1:])


def test_angles_out_of_sight_are_named_or_sane():
    """Verged by more than the picture is wide, the pair has nothing in common: the box is named, or tracks
    are sane.
    """
    for angle in (-44.0, -1e-9, 1e-9, 20.0, 44.0):
        sane_from(FlowDepthTracker(rig=RIG, vergence=angle), framed(), BOX, [framed(1), framed(2)])
