# SPDX-License-Identifier: MIT
"""A body from its pieces, and completed where something cuts it."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue.track.depth_objects.foreground import numbers
from tricue.track.depth_objects.metric import box_of
from tricue.track.depth_objects.objects import SLICES
from tricue.track.depth_particle.body import PIECE, ROOM, Body, completed, joined

CAMERA = numbers(Intrinsics.from_fov(176, 144, 47.5, 39.5))
EXPECTED = np.array([0.0, 0.0, 3.0, 0.6, 1.8])
SIZE = EXPECTED[3:]
BODY, LEG = [0.0, -0.3, 3.0, 0.6, 1.2], [0.1, 0.6, 3.0, 0.2, 0.5]
STRANGER = [1.5, 0.0, 3.0, 0.5, 1.7]


def test_one_object_is_a_body(objects_of):
    """A body of one object has its state, its cuts and its signature, and is whole as it is."""
    objects = objects_of([STRANGER, BODY], [[0, 0, 0, 0], [0, 1, 0, 0]])
    body = Body.of(objects, 1)
    np.testing.assert_array_equal(body.state, BODY)
    np.testing.assert_array_equal(body.cut, [False, True, False, False])
    np.testing.assert_array_equal(body.whole, [False, True])
    np.testing.assert_array_equal(body.whole, objects.whole[1])
    np.testing.assert_array_equal(body.signature.spread, np.full(2 * SLICES, 1 / SLICES, np.float32))


def test_whole_objects_are_complete(objects_of):
    """What nothing cuts stays as it is, however small."""
    objects = objects_of([[0.0, 0.0, 3.0, 0.5, 1.7], [1.0, 0.0, 3.0, 0.5, 0.9]])
    for i in range(2):
        np.testing.assert_array_equal(Body.of(objects, i).completed(EXPECTED, SIZE), objects.states[i])


@pytest.mark.parametrize(
    ("side", "axis", "sense"), [(0, 0, -1), (1, 0, 1), (2, 1, -1), (3, 1, 1)], ids=["l", "r", "t", "b"]
)
def test_cut_objects_are_completed_on_the_side_that_is_cut(side, axis, sense, objects_of):
    """An object cut at one side has the usual size, and its free side stays where it was."""
    half = EXPECTED.copy()
    half[3 + axis] /= 2
    cut = [[int(i == side) for i in range(4)]]
    state = Body.of(objects_of([half], cut), 0).completed(EXPECTED, SIZE)
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
    state = Body.of(objects_of([part], [cut]), 0).completed(place, SIZE)
    assert state[axis] == pytest.approx(middle)
    assert state[3 + axis] == pytest.approx(EXPECTED[3 + axis])


def test_larger_cut_objects_stay(objects_of):
    """What is cut but already larger than usual isn't shrunk, and the objects themselves stay."""
    large = [0.0, 0.0, 3.0, 0.9, 2.0]
    objects = objects_of([large, [0.0, 0.0, 3.0, 0.2, 1.7]], [[1, 0, 1, 0], [1, 0, 0, 0]])
    before = objects.states.copy()
    np.testing.assert_array_equal(Body.of(objects, 0).completed(EXPECTED, SIZE), large)
    assert Body.of(objects, 1).completed(EXPECTED, SIZE)[3] == SIZE[0]
    np.testing.assert_array_equal(objects.states, before)


def test_each_axis_is_completed_by_itself(objects_of):
    """An object cut in a corner grows in both directions, as the one and the other cut alone."""
    part = [0.1, 0.2, 3.0, 0.3, 1.0]
    x, y, z, width, height = completed(part, [True, False, False, True], EXPECTED.tolist(), SIZE.tolist())
    assert (z, width, height) == (3.0, 0.6, 1.8)
    assert (x + width / 2, y - height / 2) == pytest.approx((0.1 + 0.15, 0.2 - 0.5))


def test_pieces_are_joined(objects_of):
    """A body and the leg that a gap cut off become one, of the box round both, its centroid between theirs by
    area; depth and distributions stay the body's, and the objects as they were.
    """
    objects = objects_of([BODY, LEG, STRANGER])
    objects.columns[0] = np.eye(SLICES, dtype=np.float32)[3]
    objects = objects._replace(shift=np.array([[0.05, -0.1], [0.0, 0.02], [0.0, 0.0]]))
    before = objects.states.copy()
    both = joined(objects, 0, EXPECTED)
    np.testing.assert_allclose(both.state, [0.0, -0.025, 3.0, 0.6, 1.75], atol=1e-12)
    centroid = (0.72 * np.array([0.05, -0.4]) + 0.1 * np.array([0.1, 0.62])) / 0.82
    np.testing.assert_allclose(both.state[:2] + both.signature.shift, centroid, atol=1e-12)
    np.testing.assert_array_equal(both.signature.spread, Body.of(objects, 0).signature.spread)
    assert both.signature.spread[3] == 1
    np.testing.assert_array_equal(objects.states, before)


@pytest.mark.parametrize("z", [2.7, 3.3])
def test_a_union_is_the_box_round_its_pieces_as_the_camera_sees_them(z, objects_of):
    """The box of body and leg in pixels is that round both boxes, also where the leg is put forward or back;
    its depth is the body's.
    """
    body, leg = [0.8, -0.3, 3.0, 0.6, 1.2], [0.45, 0.6, z, 0.1, 0.5]
    both = joined(objects_of([body, leg]), 0, np.array([0.8, 0, 3, 0.6, 1.8]))
    corners = np.array([box_of(np.array(each), CAMERA).xyxy for each in (body, leg)])
    expected = [*corners[:, :2].min(axis=0), *corners[:, 2:].max(axis=0)]
    np.testing.assert_allclose(box_of(both.state, CAMERA).xyxy, expected, rtol=1e-12)
    assert both.state[3] > 0.65
    assert both.state[2] == 3.0


def test_many_pieces_are_joined_from_any_of_them(objects_of):
    """Body, leg and arm at one depth are the same box from whichever of them was found."""
    arm = [-0.32, -0.2, 3.0, 0.1, 0.6]
    objects = objects_of([BODY, LEG, arm])
    for i in range(3):
        both = joined(objects, i, EXPECTED)
        np.testing.assert_allclose(both.state, [-0.035, -0.025, 3.0, 0.67, 1.75], atol=1e-12)


@pytest.mark.parametrize(
    "other",
    [[0.0, 0.6, 3.5, 0.2, 0.5], [0.6, 0.0, 3.0, 0.3, 1.7], [0.0, 0.0, 3.0, 3.0, 3.0]],
    ids=["behind", "beside", "larger than both"],
)
def test_strangers_are_not_joined(other, objects_of):
    """What is at another depth, outside the expected rectangle, or larger than it is no piece of it: the body
    stays as it is.
    """
    objects = objects_of([BODY, other])
    alone = joined(objects, 0, EXPECTED)
    np.testing.assert_array_equal(alone.state, BODY)
    np.testing.assert_array_equal(alone.signature.shift, objects.shift[0])


@pytest.mark.parametrize(("by", "is_joined"), [(-0.01, True), (0.01, False)])
def test_a_piece_is_near_in_depth_and_mostly_in_the_room(by, is_joined, objects_of):
    """A piece may be up to 0.4 m before or behind, and stick out of the room round the expected rectangle by
    a fifth of its area.
    """
    behind = [0.0, 0.6, 3.0 + PIECE + by, 0.2, 0.5]
    aside = [ROOM * SIZE[0] / 2 - 0.3 * 0.1 + by * 0.2, 0.6, 3.0, 0.1, 0.5]
    for piece in (behind, aside):
        both = joined(objects_of([BODY, piece]), 0, EXPECTED)
        assert (both.state[4] > 1.2) == is_joined


def test_the_found_one_is_always_a_piece(objects_of):
    """What was found is the body wherever it was expected, and what is in the expected room joins it."""
    far = np.array([9.0, 0.0, 3.0, 0.6, 1.8])
    np.testing.assert_array_equal(joined(objects_of([BODY, LEG]), 0, far).state, BODY)


def test_a_union_is_cut_where_its_pieces_are(objects_of):
    """A body whole and a leg cut at the bottom make something cut at the bottom."""
    objects = objects_of([BODY, LEG], [[0, 0, 0, 0], [0, 0, 0, 1]])
    both = joined(objects, 0, EXPECTED)
    assert both.cut.tolist() == [False, False, False, True]
    assert both.whole.tolist() == [True, False]
