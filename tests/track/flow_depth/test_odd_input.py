# SPDX-License-Identifier: MIT
"""Input that the flow and depth tracker accepts, however odd it is: its tracks stay sane."""

from collections.abc import Iterable
from typing import Any

import bad_input_cases as cases
import numpy as np
import pytest
from bad_input_cases import HEIGHT, RIG, WIDTH
from hypothesis import given, settings
from hypothesis import strategies as st
from tricue import FlowDepthTracker, Frame, Intrinsics, Status, StereoRig

from tests.track.flow_depth.drawn_target import (
    BOX,
    DEPTHS,
    DISPARITY,
    FLOW,
    FRAMES,
    LEFT,
    NEXT,
    assert_mask,
    framed,
    odd,
    pair,
    seen_by,
    started,
    texture,
)

GOOD_BOXES = {
    **cases.same_box(BOX),
    **{name: cases.ODD_BOXES[name] for name in ("the wall", "half outside", "the whole image")},
    "fractions": (47.6, 29.3, 32.7, 37.9),
}


def sane_from(tracker: FlowDepthTracker, frame: Frame, box: Any, others: Iterable[Frame]) -> bool:
    """Whether it starts on the box, and is sane there and ever after, as is its mask."""
    starts = cases.sane_from(tracker, frame, box, others)
    if starts:
        assert_mask(tracker)
    return starts


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
