# SPDX-License-Identifier: MIT
"""What the stereo head tracker makes of input that isn't what it expects: a named error or a sane track."""

from typing import Any

import bad_input_cases as cases
import cv2
import numpy as np
import pytest
from bad_input_cases import HEIGHT, RIG, WIDTH
from hypothesis import given, settings
from numpy.typing import NDArray
from tricue import Box, Frame, Intrinsics, Status, StereoHeadTracker, StereoRig

Image = NDArray[np.uint8]
BOX = (48, 29, 32, 38)
ODD_PAIRS_WARN = pytest.mark.filterwarnings("ignore:right. ")  # which is no matter there
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

BAD_FRAMES: cases.BadFrames = {
    **cases.NO_FRAMES,
    **cases.BARE_DEPTHS,
    **cases.NO_PAIRS,
    **cases.ONE_IMAGE,
    "color and depth": (
        lambda: Frame(LEFT, depth=cases.METERS),
        ValueError,
        r"^frame: expected the channel right.*got color and depth",
    ),
    "both gray": (
        lambda: Frame(LEFT[..., 0], right=RIGHT[..., 0]),
        ValueError,
        r"^frame.color: expected BGR .*gray .*cv2.COLOR_GRAY2BGR",
    ),
    "both of one channel": (
        lambda: Frame(LEFT[..., :1], right=RIGHT[..., :1]),
        ValueError,
        r"^frame.color: expected BGR .*gray",
    ),
}

GOOD_BOXES = {
    **cases.same_box(BOX),
    **{name: cases.ODD_BOXES[name] for name in ("the wall", "half outside", "the whole image")},
}

FRAMES = cases.odd_pairs(LEFT, RIGHT)


def odd(name: str) -> Frame:
    """The frame of that name."""
    left, right = FRAMES[name]
    return Frame(left, right=right)


def started(**parameters: Any) -> StereoHeadTracker:
    """A tracker that follows BOX in FIRST."""
    tracker = StereoHeadTracker(**{"rig": RIG, **parameters})
    tracker.init(FIRST, BOX)
    tracker.update(framed(1))
    return tracker


EXPECTED = started().update(NEXT)
SMALL_RIG = StereoRig(Intrinsics.from_fov(WIDTH // 2, HEIGHT // 2, 60), RIG.baseline)
SMALL_BOX = tuple(side / 2 for side in BOX)


def small(frame: Frame) -> Frame:
    """Half of the frame's rows and columns: what the twins need seconds for, they do there as well."""
    assert frame.right is not None
    return Frame(frame.color[::2, ::2], right=frame.right[::2, ::2])


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


@pytest.mark.parametrize("name", cases.BAD_BOXES)
def test_bad_boxes_are_named(name):
    """A box that can't be started on gets an error that names it, and the old target is followed on."""
    box, error, message = cases.BAD_BOXES[name]
    tracker = started()
    with pytest.raises(error, match=f"^box: .*{message}"):
        tracker.init(FIRST, box)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("name", ["black", "white", "gray", "right black"])
@ODD_PAIRS_WARN
def test_a_start_on_nothing_is_named(name):
    """A pair in which nothing in the box has a disparity is an error that shows box and range, and the old
    target is followed on.
    """
    tracker = started()
    message = r"^box: expected a head with a disparity between near and far, 0.4 and 6 m, got none in \(48"
    with pytest.raises(ValueError, match=message):
        tracker.init(odd(name), BOX)
    assert tracker.update(NEXT) == EXPECTED


@ODD_PAIRS_WARN
def test_a_box_on_a_bare_patch_is_named():
    """A box on a patch without texture is an error that shows it, though there is some round it."""
    left, right = (image.copy() for image in pair())
    left[5:60, 80:125] = right[5:60, 60:125] = 128
    tracker = started()
    with pytest.raises(ValueError, match=r"^box: expected .*a disparity .*got none in \(90.*12"):
        tracker.init(Frame(left, right=right), (90, 12, 25, 30))
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
    cases.assert_sane(track)
    assert 0.9 * near < track.position[2] < 1.1 * far


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


def test_a_rig_of_another_size_is_named():
    """A first pair of another size than the rig's is an error that says both, and nothing changes."""
    tracker = started()
    small = Frame(LEFT[::2, ::2], right=RIGHT[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.color: expected the rig's size, 128x96, got 64x48"):
        tracker.init(small, (24, 15, 16, 19))
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("rig", cases.NO_RIGS, ids=lambda each: type(each).__name__)
def test_what_is_no_rig_is_named(rig):
    """A rig of another type is a TypeError that names it."""
    with pytest.raises(TypeError, match=r"^rig: expected tricue.StereoRig, got "):
        StereoHeadTracker(rig=rig)


@pytest.mark.parametrize(
    "name", ["black", "white", "gray", "left black", "right black", "right white", "noise", "far apart"]
)
def test_a_pair_without_the_head_is_an_occlusion(name):
    """A pair in which the head isn't to be seen is OCCLUDED at score 0, no error; in the next it is TRACKED
    again.
    """
    tracker = started()
    hidden = tracker.update(odd(name))
    cases.assert_sane(hidden)
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
        cases.assert_sane(track)
        assert track.status is not Status.TRACKED
    again = [tracker.update(NEXT) for _ in range(15)]
    assert again[-1].status is Status.TRACKED
    assert again[-1].box.iou(EXPECTED.box) > 0.5


@pytest.mark.parametrize("far", [6.0, 20.0, 1e4])
@ODD_PAIRS_WARN
def test_a_start_on_two_times_the_left_image_is_sane(far):
    """Nothing but disparity 0, which is no distance, is an error that names the box, or gives sane tracks,
    however far a head may be.
    """
    same = odd("the same twice")
    cases.sane_from(StereoHeadTracker(rig=RIG, far=far), same, BOX, [same, NEXT])


@pytest.mark.parametrize("name", FRAMES)
def test_odd_frames_are_sane(name):
    """Empty, uniform, noisy and swapped pairs give sane tracks until long lost, as does the next good one."""
    tracker = started(lost_after=0.1, search_frame_after=0.05)
    for _ in range(5):
        cases.assert_sane(tracker.update(odd(name)))
    cases.assert_sane(tracker.update(NEXT))


@pytest.mark.parametrize("name", FRAMES)
def test_odd_frames_are_sane_to_the_twins(name):
    """The same of the reference kernels, on smaller frames and sooner lost."""
    tracker = StereoHeadTracker(
        rig=SMALL_RIG, kernels="reference", near=0.7, far=2.5, lost_after=0.05, search_frame_after=0.01
    )
    tracker.init(small(FIRST), SMALL_BOX)
    for _ in range(2):
        cases.assert_sane(tracker.update(small(odd(name))))
    cases.assert_sane(tracker.update(small(NEXT)))


@pytest.mark.parametrize("name", FRAMES)
@ODD_PAIRS_WARN
def test_starts_on_odd_frames_are_sane(name):
    """A box on an odd pair is refused by name or gives sane tracks, there and on good pairs."""
    others = [odd(name), NEXT, NEXT, NEXT, odd(name), NEXT]
    cases.sane_from(StereoHeadTracker(rig=RIG), odd(name), BOX, others)


@pytest.mark.parametrize("name", cases.COLOR_VIEWS)
def test_views_are_read_as_they_look(name):
    """Crops, mirrored, reversed and read-only arrays give the track of a packed copy, bit for bit."""
    tracks = []
    for layout in (cases.COLOR_VIEWS[name], np.ascontiguousarray):
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
        cases.assert_sane(tracker.update(framed(shift)))


@pytest.mark.parametrize("name", cases.ODD_BOXES)
def test_odd_boxes_are_sane(name):
    """Boxes that are very small or larger than the image are refused by name or give sane tracks."""
    others = [*map(framed, range(6)), *6 * [odd("black")]]
    cases.sane_from(StereoHeadTracker(rig=RIG), FIRST, cases.ODD_BOXES[name], others)


@pytest.mark.parametrize("shape", cases.ANY_SHAPES, ids=str)
@ODD_PAIRS_WARN
def test_images_of_any_size(shape):
    """Tiny, thin and huge pairs give sane tracks from a box over them, or name the box."""
    height, width = shape
    left = np.resize(LEFT.repeat(8, 0).repeat(8, 1) if height > 999 else LEFT, (*shape, 3))
    frame = Frame(left, right=np.roll(left, -max(1, width // 12), axis=1))
    tracker = StereoHeadTracker(rig=StereoRig(Intrinsics.from_fov(width, height, 60), 0.12))
    box = (width / 3 - 1, height / 4 - 1, width / 3 + 2, height / 2 + 2)
    cases.sane_from(tracker, frame, box, 3 * [frame])


@pytest.mark.parametrize("seconds", cases.ODD_TIMES, ids=str)
def test_odd_times_are_sane(seconds):
    """Times that stand still, go back, leap or are missing give sane tracks."""
    tracker = StereoHeadTracker(rig=RIG)
    tracker.init(framed(timestamp=seconds[0]), BOX)
    for shift in (1, 2):
        cases.assert_sane(tracker.update(framed(shift, timestamp=seconds[1])))


@pytest.mark.parametrize("rig", cases.DEGENERATE_RIGS.values(), ids=cases.DEGENERATE_RIGS)
def test_degenerate_rigs_are_sane(rig):
    """A rig of numbers that no camera has is refused by the box's name, or gives sane tracks."""
    cases.sane_from(StereoHeadTracker(rig=rig), FIRST, BOX, [NEXT, odd("black"), NEXT])


def test_long_lost_is_sane():
    """A thousand pairs without the head leave a sane track: no number runs away."""
    tracker = StereoHeadTracker(rig=SMALL_RIG)
    tracker.init(small(FIRST), SMALL_BOX)
    black = small(odd("black"))
    for _ in range(1000):
        track = tracker.update(black)
    cases.assert_sane(track)
    assert track.status is Status.LOST


@pytest.mark.parametrize(
    "kernel",
    [
        "image_mean",
        "kalman_predict",
        "head_cells",
        "best_ellipse",
        "ellipse_disparity",
        "back_project",
        "learn_histogram",
        "kalman_update",
    ],
)
def test_an_error_inside_leaves_the_state(kernel, monkeypatch: pytest.MonkeyPatch):
    """An error in the middle of an update, of whatever kind, leaves the tracker as it was."""
    cases.assert_errors_leave_the_state(started(kernels="reference"), kernel, NEXT, monkeypatch)


@settings(max_examples=200)
@given(cases.boxes)
def test_any_four_numbers(box):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning."""
    cases.sane_from(StereoHeadTracker(rig=RIG), FIRST, box, [FIRST, NEXT])
