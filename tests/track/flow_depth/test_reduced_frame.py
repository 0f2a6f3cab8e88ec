# SPDX-License-Identifier: MIT
"""That frames are reduced to cells, depth is turned into disparity, and verged pairs into parallel ones."""

import math

import cv2
import numpy as np
import pytest
from tricue import Box, FlowDepthTracker, Frame, Intrinsics, Status, StereoRig
from tricue.track.flow_depth.reduced_frame import reduce_frame
from tricue.track.flow_depth.verged_geometry import VergedGeometry

Params = FlowDepthTracker.Params
WIDTH, HEIGHT = SIZE = (128, 96)
RIG = StereoRig(Intrinsics.from_fov(*SIZE, 60), 0.12)
GEOMETRY = VergedGeometry.of(RIG, 0.0)
BOX = (48, 29, 32, 38)
OURS, FAR, MARGIN = 12, 4, 60  # disparities, and columns that a turned camera sees in addition


def texture(height: int, width: int, seed: int) -> np.ndarray:
    """Clouds of gray with fine grain, as float."""
    rng = np.random.default_rng(seed)
    coarse = rng.normal(0, 40, (height // 5 + 1, width // 5 + 1))
    fine = cv2.GaussianBlur(rng.normal(0, 60, (height, width)), (0, 0), 1.2)
    return np.clip(cv2.resize(coarse, (width, height), interpolation=cv2.INTER_CUBIC) + fine + 128, 0, 255)


WALL = texture(HEIGHT, WIDTH + 2 * MARGIN + FAR, 0)
TARGET = texture(BOX[3], BOX[2], 1)


def verged(degrees: float, shift: int = 0) -> Frame:
    """A target before a wall, seen by a pair whose right camera is turned inwards; it has moved to the
    right.
    """
    left, right = WALL[:, : WIDTH + 2 * MARGIN].copy(), WALL[:, FAR:].copy()
    x, y, width, height = BOX
    for side, disparity in ((left, 0), (right, OURS)):
        first = MARGIN + x + shift - disparity
        side[y : y + height, first : first + width] = TARGET
    angle, k = math.radians(degrees), RIG.intrinsics.matrix
    turn = np.array(
        [[math.cos(angle), 0, math.sin(angle)], [0, 1, 0], [-math.sin(angle), 0, math.cos(angle)]]
    )
    back = np.array([[1.0, 0, -MARGIN], [0, 1, 0], [0, 0, 1]])
    turned = cv2.warpPerspective(right, k @ turn @ np.linalg.inv(k) @ back, SIZE)
    return Frame(np.rint(left[:, MARGIN:-MARGIN]).astype(np.uint8), right=np.rint(turned).astype(np.uint8))


@pytest.mark.parametrize("degrees", [-4.0, 2.0, 5.0, 9.0])
def test_positions_of_a_verged_pair_are_right(degrees):
    """With the angle given, the target of a verged pair is followed as that of a parallel one: its distance
    is right to 3 %, its box on it and not larger.
    """
    tracker = FlowDepthTracker(rig=RIG, vergence=degrees)
    tracks = [tracker.init(verged(degrees), BOX)]
    tracks += [tracker.update(verged(degrees, shift)) for shift in range(1, 13)]
    for shift, track in enumerate(tracks):
        assert track.status is Status.TRACKED
        assert track.position[2] == pytest.approx(RIG.depth(OURS), rel=0.03)
        true = Box(BOX[0] + shift, *BOX[1:])
        assert track.box.iou(true) > 0.7
        assert track.box.area == pytest.approx(true.area, rel=0.25)


@pytest.mark.filterwarnings("ignore:right. left and right seem to be swapped")
def test_a_verged_pair_needs_its_angle():
    """Without the angle the same pair's target is elsewhere: the test above has something to find."""
    try:
        track = FlowDepthTracker(rig=RIG).init(verged(5.0), BOX)
    except ValueError:
        return
    assert track.position is None or abs(track.position[2] / RIG.depth(OURS) - 1) > 0.2


@pytest.mark.parametrize("degrees", [-4.0, 5.0])
def test_a_verged_right_image_is_turned_back(degrees, kernels):
    """Turned back and moved by the geometry's offset, the right image is the parallel camera's, where both
    saw something: to 3 levels in the mean.
    """
    geometry = VergedGeometry.of(RIG, degrees)
    parallel = verged(0.0).right
    reduced = reduce_frame(kernels, verged(degrees), geometry, Params(vergence=degrees))
    moved = cv2.warpAffine(parallel, np.float32([[1, 0, geometry.offset], [0, 1, 0]]), SIZE)
    inside = np.s_[5:-5, 20 : WIDTH - 20]
    assert geometry.offset == pytest.approx(RIG.intrinsics.fx * math.tan(math.radians(degrees)))
    seen = (moved[inside] > 0) & (reduced.right[inside] > 0)
    assert seen.mean() > 0.9
    assert np.abs(moved[inside].astype(int) - reduced.right[inside])[seen].mean() < 3


@pytest.mark.parametrize("degrees", [0.0, 5.0])
def test_depth_is_a_pairs_disparity(degrees, kernels):
    """A depth image is turned into the disparities that a pair of the geometry has: the position is that of
    the depth, whatever the angle; NaN stays NaN.
    """
    depth = np.full((HEIGHT, WIDTH), 2.5, np.float32)
    depth[:9] = np.nan
    frame = Frame(np.rint(WALL[:, :WIDTH]).astype(np.uint8), depth=depth)
    geometry = VergedGeometry.of(RIG, degrees)
    reduced = reduce_frame(kernels, frame, geometry, Params(vergence=degrees))
    assert reduced.right is None
    assert np.isnan(reduced.disparity[:9]).all()
    np.testing.assert_allclose(
        reduced.disparity[9:] + geometry.offset, geometry.disparity_times_depth / 2.5, rtol=1e-5
    )
    track = FlowDepthTracker(rig=RIG, vergence=degrees).init(frame, BOX)
    assert track.position[2] == pytest.approx(2.5, rel=1e-4)


def test_the_angle_does_not_change_how_it_grows():
    """A target that comes nearer, from 2.5 to 1.9 m before a depth camera, grows by as much whatever angle a
    pair would have: its size goes with its distance, not with what a verged pair measures.
    """
    frames = []
    for z in np.linspace(2.5, 1.9, 20):
        depth = np.full((HEIGHT, WIDTH), 4.0, np.float32)
        half = round(40 / z)
        depth[48 - half : 48 + half, 64 - half : 64 + half] = z
        frames.append(Frame(depth=depth))
    ends = []
    for degrees in (0.0, 5.0, -5.0):
        tracker = FlowDepthTracker(rig=RIG, vergence=degrees, cues=("disparity",))
        tracker.init(frames[0], (48, 32, 32, 32))
        ends.append([tracker.update(frame) for frame in frames[1:]][-1])
    for track in ends:
        assert track.box.width == pytest.approx(32 * 2.5 / 1.9, rel=0.1)
        assert track.box == pytest.approx(ends[0].box, abs=0.5)


@pytest.mark.parametrize(
    ("width", "resolution", "step"),
    [(160, 160, 1), (640, 160, 4), (640, 320, 2), (100, 320, 1), (400, 320, 1)],
)
def test_a_cell_is_the_mean_of_its_square(width, resolution, step, kernels):
    """About ``resolution`` cells lie in a row, each the mean of a square of pixels; the disparity is in
    cells too, that of the square's middle.
    """
    gray = np.rint(texture(48, width, 3)).astype(np.uint8)
    depth = np.random.default_rng(0).uniform(1, 5, gray.shape).astype(np.float32)
    pair = reduce_frame(kernels, Frame(gray, right=gray[:, ::-1]), GEOMETRY, Params(resolution=resolution))
    assert pair.step == step
    assert pair.scale == width / step / 160
    for found, image in ((pair.gray, gray), (pair.right, gray[:, ::-1])):
        means = image.reshape(48 // step, step, width // step, step).mean(axis=(1, 3))
        assert np.abs(found - means).max() <= 0.5 + 1e-6
    sensor = reduce_frame(kernels, Frame(gray, depth=depth), GEOMETRY, Params(resolution=resolution))
    expected = GEOMETRY.disparity_times_depth / step / depth[step // 2 :: step, step // 2 :: step]
    np.testing.assert_allclose(sensor.disparity, expected, rtol=1e-6)


@pytest.mark.parametrize("shape", [(37, 501), (50, 999), (45, 642)], ids=str)
def test_sizes_that_step_does_not_divide(shape, kernels):
    """Where the step leaves a rest, gray, right and disparity still have one size, and the mask the
    picture's.
    """
    gray = np.rint(texture(*shape, 3)).astype(np.uint8)
    p = Params(resolution=160)
    pair = reduce_frame(kernels, Frame(gray, right=gray), GEOMETRY, p)
    sensor = reduce_frame(kernels, Frame(gray, depth=np.ones(shape, np.float32)), GEOMETRY, p)
    assert pair.gray.shape == pair.right.shape == sensor.disparity.shape
    tracker = FlowDepthTracker(resolution=160)
    tracker.init(Frame(gray, depth=np.ones(shape, np.float32)), (9, 9, 25, 20))
    assert tracker.mask.shape == shape


def test_color_is_turned_gray_as_by_cv2(kernels):
    """Color is turned to gray as cv2 does, in both pictures."""
    color = np.random.default_rng(0).integers(0, 256, (24, 32, 3)).astype(np.uint8)
    reduced = reduce_frame(kernels, Frame(color, right=color[::-1]), GEOMETRY, Params())
    np.testing.assert_array_equal(reduced.gray, cv2.cvtColor(color, cv2.COLOR_BGR2GRAY))
    np.testing.assert_array_equal(reduced.right, cv2.cvtColor(color[::-1], cv2.COLOR_BGR2GRAY))


@pytest.mark.parametrize("shape", [(24, 32), (24, 32, 3)], ids=str)
def test_nothing_of_the_frame_is_kept(shape, kernels):
    """What is written into the frame's array afterwards doesn't reach the reduced left image, which the next
    frame needs.
    """
    image = np.full(shape, 90, np.uint8)
    reduced = reduce_frame(kernels, Frame(image, right=image), GEOMETRY, Params())
    image[:] = 7
    assert (reduced.gray == 90).all()


def test_flow_alone_leaves_the_rest(kernels):
    """Without disparity neither right image nor depth is used; depth alone has a black gray image."""
    gray = np.full((24, 32), 90, np.uint8)
    for frame in (Frame(gray), Frame(gray, right=gray), Frame(gray, depth=np.ones((3, 3), np.float32))):
        reduced = reduce_frame(kernels, frame, GEOMETRY, Params(cues=("flow",)))
        assert (reduced.right, reduced.disparity) == (None, None)
    alone = reduce_frame(
        kernels, Frame(depth=np.ones((24, 32), np.float32)), GEOMETRY, Params(cues=("disparity",))
    )
    assert alone.gray.shape == (24, 32)
    assert not alone.gray.any()
