# SPDX-License-Identifier: MIT
"""A body from its pieces, and completed where something cuts it."""

import numpy as np
import pytest
from tricue import Intrinsics, _core
from tricue.track.depth_objects.objects import DISTRIBUTION_BINS
from tricue.track.depth_objects.projection import project_box
from tricue.track.depth_particle.matching import MAX_PIECE_DEPTH, PIECE_REGION, complete_body
from tricue.track.depth_particle.motion import BodyMotion
from tricue.track.depth_particle.signature import Signature

CAMERA = Intrinsics.from_fov(176, 144, 47.5, 39.5).vector
EXPECTED = np.array([0.0, 0.0, 3.0, 0.6, 1.8])
SIZE = EXPECTED[3:]
BODY, LEG = [0.0, -0.3, 3.0, 0.6, 1.2], [0.1, 0.6, 3.0, 0.2, 0.5]
STRANGER = [1.5, 0.0, 3.0, 0.5, 1.7]


def motion(size, known=(True, True)):
    """The motion of a target at rest, of a mean size that is known or not."""
    return BodyMotion.start(np.array([0.0, 0.0, 3.0, *size]), np.array(known))


def body_of(objects, index, expected=EXPECTED, size=SIZE):
    """The body of which an object is a part."""
    return complete_body(_core, objects, index, expected, motion(size))[0]


def test_one_object_is_a_body(objects_of):
    """A body of one object has its signature and, where nothing cuts it, its state; it is as whole."""
    objects = objects_of([STRANGER, BODY], [[0, 0, 0, 0], [0, 1, 0, 0]])
    objects.centroid_offset[:] = 0.05, -0.1
    stranger, body = body_of(objects, 0), body_of(objects, 1)
    np.testing.assert_array_equal(stranger.state, STRANGER)
    np.testing.assert_array_equal([stranger.whole, body.whole], [[True, True], [False, True]])
    np.testing.assert_array_equal([stranger.whole, body.whole], objects.whole)
    np.testing.assert_array_equal(
        body.signature.distribution, np.full(2 * DISTRIBUTION_BINS, 1 / DISTRIBUTION_BINS, np.float32)
    )
    np.testing.assert_array_equal(body.signature.centroid_offset, [0.05, -0.1])


def test_an_unknown_size_grows_to_what_is_visible(objects_of):
    """A lower bound is at least the object's size. A known size stays, and so does a larger one."""
    objects = objects_of([[0.0, 0.0, 3.0, 0.7, 1.5]])
    sizes = {
        known: complete_body(_core, objects, 0, EXPECTED, motion(SIZE, known))[1].mean_size.tolist()
        for known in ((True, True), (False, True), (False, False))
    }
    assert list(sizes.values()) == [[0.6, 1.8], [0.7, 1.8], [0.7, 1.8]]


def test_whole_objects_are_complete(objects_of):
    """What nothing cuts stays as it is, however small."""
    objects = objects_of([[0.0, 0.0, 3.0, 0.5, 1.7], [1.0, 0.0, 3.0, 0.5, 0.9]])
    for i in range(2):
        np.testing.assert_array_equal(body_of(objects, i).state, objects.states[i])


@pytest.mark.parametrize(
    ("side", "axis", "sense"), [(0, 0, -1), (1, 0, 1), (2, 1, -1), (3, 1, 1)], ids=["l", "r", "t", "b"]
)
def test_cut_objects_are_completed_on_the_side_that_is_cut(side, axis, sense, objects_of):
    """An object cut at one side has the expected size, and its free side stays where it was."""
    half = EXPECTED.copy()
    half[3 + axis] /= 2
    cut = [[int(i == side) for i in range(4)]]
    state = body_of(objects_of([half], cut), 0).state
    assert state[3 + axis] == pytest.approx(EXPECTED[3 + axis])
    free = half[axis] - sense * half[3 + axis] / 2
    assert state[axis] - sense * state[3 + axis] / 2 == pytest.approx(free)
    others = [i for i in range(5) if i not in (axis, 3 + axis)]
    np.testing.assert_array_equal(state[others], half[others])


@pytest.mark.parametrize("axis", [0, 1], ids=["left and right", "top and bottom"])
@pytest.mark.parametrize(("expected", "middle"), [(0.0, 0.0), (0.1, 0.1), (5.0, 0.15), (-5.0, -0.15)])
def test_objects_cut_on_both_sides_are_where_they_are_expected(axis, expected, middle, objects_of):
    """Cut at opposite sides, an object lies as near to its expected place as covers what is seen."""
    part, place = EXPECTED.copy(), EXPECTED.copy()
    part[3 + axis] -= 0.3
    place[axis] += expected
    cut = [[1, 1, 0, 0], [0, 0, 1, 1]][axis]
    state = body_of(objects_of([part], [cut]), 0, place).state
    assert state[axis] == pytest.approx(middle)
    assert state[3 + axis] == pytest.approx(EXPECTED[3 + axis])


def test_larger_cut_objects_stay(objects_of):
    """What is cut but already larger than expected isn't shrunk, and the objects themselves stay."""
    large = [0.0, 0.0, 3.0, 0.9, 2.0]
    objects = objects_of([large, [0.0, 0.0, 3.0, 0.2, 1.7]], [[1, 0, 1, 0], [1, 0, 0, 0]])
    before = objects.states.copy()
    np.testing.assert_array_equal(body_of(objects, 0).state, large)
    assert body_of(objects, 1).state[3] == SIZE[0]
    np.testing.assert_array_equal(objects.states, before)


def test_each_axis_is_completed_by_itself(objects_of):
    """An object cut in a corner grows in both directions, as the one and the other cut alone."""
    part = objects_of([[0.1, 0.2, 3.0, 0.3, 1.0]], [[1, 0, 0, 1]])
    x, y, z, width, height = body_of(part, 0).state
    assert (z, width, height) == (3.0, 0.6, 1.8)
    assert (x + width / 2, y - height / 2) == pytest.approx((0.1 + 0.15, 0.2 - 0.5))


def test_pieces_are_joined(objects_of):
    """A body and the leg that a gap cut off become one, of the box around both and their common
    centroid. Depth and distributions stay the body's, and the objects as they were.
    """
    objects = objects_of([BODY, LEG, STRANGER])
    objects.columns[0] = np.eye(DISTRIBUTION_BINS, dtype=np.float32)[3]
    objects.centroid_offset[:] = [[0.05, -0.1], [0.0, 0.02], [0.0, 0.0]]
    before = objects.states.copy()
    both = body_of(objects, 0)
    np.testing.assert_allclose(both.state, [0.0, -0.025, 3.0, 0.6, 1.75], atol=1e-12)
    centroid = (0.72 * np.array([0.05, -0.4]) + 0.1 * np.array([0.1, 0.62])) / 0.82
    np.testing.assert_allclose(both.state[:2] + both.signature.centroid_offset, centroid, atol=1e-12)
    np.testing.assert_array_equal(both.signature.distribution, Signature.from_object(objects, 0).distribution)
    assert both.signature.distribution[3] == 1
    np.testing.assert_array_equal(objects.states, before)


@pytest.mark.parametrize(("z", "x"), [(2.7, 0.45), (3.3, 0.53)])
def test_a_union_is_the_box_around_its_pieces_as_the_camera_sees_them(z, x, objects_of):
    """The box of body and leg in pixels is that around both boxes, also where the leg is put forward or back;
    its depth is the body's.
    """
    body, leg = [0.8, -0.3, 3.0, 0.6, 1.2], [x, 0.6, z, 0.1, 0.5]
    both = body_of(objects_of([body, leg]), 0, np.array([0.8, 0, 3, 0.6, 1.8]), SIZE)
    corners = np.array([project_box(np.array(each), CAMERA).xyxy for each in (body, leg)])
    expected = [*corners[:, :2].min(axis=0), *corners[:, 2:].max(axis=0)]
    np.testing.assert_allclose(project_box(both.state, CAMERA).xyxy, expected, rtol=1e-12)
    assert both.state[3] > 0.65
    assert both.state[2] == 3.0


def test_many_pieces_are_joined_from_any_of_them(objects_of):
    """Body, leg and arm at one depth are the same box whichever of them is the start."""
    arm = [-0.32, -0.2, 3.0, 0.1, 0.6]
    objects = objects_of([BODY, LEG, arm])
    for i in range(3):
        both = body_of(objects, i, EXPECTED, np.array([0.67, 1.8]))
        np.testing.assert_allclose(both.state, [-0.035, -0.025, 3.0, 0.67, 1.75], atol=1e-12)


@pytest.mark.parametrize(
    "other",
    [[0.0, 0.6, 3.5, 0.2, 0.5], [0.6, 0.0, 3.0, 0.3, 1.7], [0.0, 0.0, 3.0, 3.0, 3.0]],
    ids=["behind", "beside", "larger than both"],
)
def test_other_objects_are_not_joined(other, objects_of):
    """What is at another depth, outside the expected rectangle, or larger than it is no piece of it: the body
    stays as it is.
    """
    objects = objects_of([BODY, other])
    alone = body_of(objects, 0)
    np.testing.assert_array_equal(alone.state, BODY)
    np.testing.assert_array_equal(alone.signature.centroid_offset, objects.centroid_offset[0])


@pytest.mark.parametrize(("by", "is_joined"), [(-0.01, True), (0.01, False)])
def test_a_piece_is_near_in_depth_and_mostly_in_the_region(by, is_joined, objects_of):
    """A piece may be up to 0.4 m nearer or farther, and outside the region around the expected rectangle by a
    fifth of its area.
    """
    behind = [0.0, 0.6, 3.0 + MAX_PIECE_DEPTH + by, 0.2, 0.5]
    aside = [PIECE_REGION * SIZE[0] / 2 - 0.3 * 0.1 + by * 0.2, 0.6, 3.0, 0.1, 0.5]
    for piece in (behind, aside):
        both = body_of(objects_of([BODY, piece]), 0, EXPECTED, np.array([0.75, 1.8]))
        assert (both.state[4] > 1.2) == is_joined


def test_the_matched_object_is_always_a_piece(objects_of):
    """The matched object is the body wherever it was expected; what is in the expected region joins it."""
    far = np.array([9.0, 0.0, 3.0, 0.6, 1.8])
    np.testing.assert_array_equal(body_of(objects_of([BODY, LEG]), 0, far, SIZE).state, BODY)


def test_a_union_is_cut_where_its_pieces_are(objects_of):
    """A body whole and a leg cut at the bottom make something cut at the bottom, which is completed there."""
    objects = objects_of([BODY, LEG], [[0, 0, 0, 0], [0, 0, 0, 1]])
    both = body_of(objects, 0)
    assert both.whole.tolist() == [True, False]
    np.testing.assert_allclose(both.state, [0.0, 0.0, 3.0, *SIZE], atol=1e-12)


def test_what_makes_a_body_larger_than_usual_is_no_piece(objects_of):
    """Of somebody who turns sideways, and is narrower than usual, a chair at the side is no piece, though
    both together would be nearer to the mean width; a body of the mean size has no pieces at all.
    """
    sideways, chair = [0.0, 0.0, 3.0, 0.35, 1.7], [0.45, 0.3, 3.0, 0.2, 0.8]
    wide = np.array([0.2, 0.0, 3.0, 0.9, 1.8])
    alone = body_of(objects_of([sideways, chair]), 0, wide, SIZE)
    np.testing.assert_array_equal(alone.state, sideways)
    body = [0.0, 0.0, 3.0, *SIZE]
    np.testing.assert_array_equal(body_of(objects_of([body, chair]), 0, wide, SIZE).state, body)
