# SPDX-License-Identifier: MIT
"""Which object is the target, what covers it, and what is set aside."""

import numpy as np
import pytest
from tricue.track.depth_particle.matching import MAX_COST, REACHED, best_match, cover, same, without
from tricue.track.depth_particle.signature import Signature
from tricue.track.depth_particle.walk import Walk

TARGET = [0.0, 0.0, 3.0, 0.6, 1.7]
EXPECTED = np.array(TARGET)
KNOWN = Walk.start(EXPECTED, np.array([True, True]))
UNKNOWN = Walk.start(EXPECTED, np.array([False, False]))
EVEN = Signature.unknown()
FRAME = 1 / 15


def moved(*by: float) -> list[float]:
    """The target's state, changed by the numbers given."""
    return (EXPECTED + np.pad(by, (0, 5 - len(by)))).tolist()


def match(objects, walk=KNOWN, seconds=FRAME, worst=MAX_COST, signature=EVEN):
    """The best match among objects."""
    return best_match(objects, EXPECTED, walk, signature, seconds, worst)


def test_nothing_matches_nothing(objects_of):
    """Without objects there is no match, no cover and nothing that is the same."""
    nothing = objects_of([])
    assert match(nothing) is None
    assert cover(nothing, EXPECTED, 0.3) is None
    assert same(nothing, EXPECTED[:3], 2.0, FRAME) is None
    assert len(without(nothing, EXPECTED[:3]).states) == 0


@pytest.mark.parametrize("axis", range(5), ids=["x", "y", "z", "width", "height"])
def test_the_nearest_in_place_and_size_matches(axis, objects_of):
    """Of two objects the one whose position and size are nearer to those expected is the target, whatever
    their order.
    """
    near, far = (list(TARGET), list(TARGET))
    near[axis] += 0.05
    far[axis] += 0.25
    assert match(objects_of([near, far])) == 0
    assert match(objects_of([far, near])) == 1


@pytest.mark.parametrize("by", [(1.5,), (0, 1.5), (0, 0, 1.5), (0, 0, 0, 1.5), (0, 0, 0, 0, 3.0)], ids=str)
def test_too_far_off_is_no_match(by, objects_of):
    """An object that is far off in any one of place and size isn't the target, even when it is alone."""
    assert match(objects_of([moved(*by)])) is None


def test_time_widens_the_place(objects_of):
    """What is too far off a frame later may be the target two seconds later."""
    there = objects_of([moved(0.8)])
    assert match(there) is None
    assert match(there, seconds=2.0) == 0


def test_a_stricter_limit_refuses_more(objects_of):
    """An object that passes for a target just seen is refused by a lower limit."""
    there = objects_of([moved(0.4)])
    assert match(there, worst=6.0) == 0
    assert match(there, worst=1.0) is None


def test_a_crumb_is_no_target(objects_of):
    """An object of under a quarter of the target's area isn't the target, though completed to its size."""
    assert match(objects_of([[0, 0, 3.0, 0.2, 0.5]], [[1, 1, 1, 1]])) is None
    assert match(objects_of([[0, 0, 3.0, 0.6, 0.85]], [[1, 1, 1, 1]])) == 0


def test_what_is_cut_counts_as_completed(objects_of):
    """The half of the target that is seen beside what hides the other is in its place; the same half, whole,
    is somebody narrow who stands aside.
    """
    half = [0.15, 0, 3.0, 0.3, 1.7]
    assert match(objects_of([half], [[1, 0, 0, 0]]), worst=1.0) == 0
    assert match(objects_of([half]), worst=1.0) is None
    assert match(objects_of([half, half], [[0, 0, 0, 0], [1, 0, 0, 0]])) == 1


def test_an_unknown_size_may_grow(objects_of):
    """A larger object is the target where its size was only a lower bound, and isn't where it was known."""
    larger = objects_of([moved(0, 0, 0, 0.4, 1.0)])
    assert match(larger, UNKNOWN, worst=6.0) == 0
    assert match(larger, KNOWN, worst=6.0) is None


def test_an_unknown_size_rather_grows_than_shrinks(objects_of):
    """A lower bound is one: of two objects as far off in height, the taller is the target; where the height
    was known, neither is nearer.
    """
    taller, shorter = moved(0, 0, 0, 0, 0.6), moved(0, 0, 0, 0, -0.6)
    assert match(objects_of([shorter, taller]), UNKNOWN) == 1
    assert match(objects_of([taller, shorter]), UNKNOWN) == 0
    assert match(objects_of([shorter, taller]), KNOWN) == 0


@pytest.mark.parametrize("cut", [False, True], ids=["whole", "cut"])
def test_a_whole_object_is_known_by_its_signature(cut, objects_of):
    """Of two in the same place the one spread over its box as the target is the target; what is cut isn't
    judged by that, and the first is taken.
    """
    two = objects_of([TARGET, TARGET], 2 * [[0, 0, 0, int(cut)]])
    rows = two.rows.copy()
    rows[0] = np.eye(1, rows.shape[1], dtype=np.float32)
    assert match(two._replace(rows=rows)) == (0 if cut else 1)


def test_matching_changes_nothing(objects_of):
    """States, expectation and walk are only read."""
    objects = objects_of([moved(0.1), moved(0, 0, 0.2)])
    states, expected = objects.states.copy(), EXPECTED.copy()
    match(objects, UNKNOWN)
    np.testing.assert_array_equal(objects.states, states)
    np.testing.assert_array_equal(EXPECTED, expected)


def test_without_takes_out_what_stands_there(objects_of):
    """Objects within half a metre on the ground are taken out, at whatever height; others stay in order, all
    fields alike.
    """
    objects = objects_of([moved(1.0), moved(0.3, -1.5), moved(0, 0, 0.4), moved(0, 0, 0.6)])
    rest = without(objects, EXPECTED[:3])
    for kept, each in zip(rest, objects, strict=True):
        np.testing.assert_array_equal(kept, each[[0, 3]])


def test_the_cover_is_nearer_and_in_the_way(objects_of):
    """Of what is nearer, that which covers most of the rectangle, as the camera sees it, is the cover."""
    behind, beside, partly, wholly = moved(0, 0, 1), moved(2, 0, -1), moved(0.3, 0, -1), moved(0, 0, -1)
    assert cover(objects_of([behind, beside, partly, wholly]), EXPECTED, 0.3) == 3
    assert cover(objects_of([behind, beside, partly]), EXPECTED, 0.3) == 2
    assert cover(objects_of([behind, beside]), EXPECTED, 0.3) is None


def test_the_cover_is_judged_along_the_line_of_sight(objects_of):
    """A target at 2 m to the side and 4 m away is covered by what is 1 m to the side and 2 m away."""
    aside = np.array([2.0, 0.0, 4.0, 0.6, 1.7])
    on_the_line, at_its_side = [1.0, 0.0, 2.0, 0.5, 1.7], [2.0, 0.0, 2.0, 0.5, 1.7]
    assert cover(objects_of([at_its_side, on_the_line]), aside, 0.3) == 1
    assert cover(objects_of([at_its_side]), aside, 0.3) is None


def test_what_is_hardly_nearer_covers_nothing(objects_of):
    """An object nearer by less than ``nearer`` isn't in front."""
    just = objects_of([moved(0, 0, -0.29)])
    assert cover(just, EXPECTED, 0.3) is None
    assert cover(just, EXPECTED, 0.2) == 0


def test_the_same_is_the_nearest_within_reach(objects_of):
    """What was somewhere is the nearest object as far as it can have gone in the time, and no other."""
    objects = objects_of([moved(0.35), moved(0.2)])
    assert same(objects, EXPECTED[:3], 2.0, FRAME) == 1
    gone = objects_of([moved(REACHED + 0.5)])
    assert same(gone, EXPECTED[:3], 2.0, 0.1) is None
    assert same(gone, EXPECTED[:3], 2.0, 0.3) == 0


def test_heights_say_less_of_what_is_the_same(objects_of):
    """A middle 0.3 m lower, as of somebody cut, is nearer than one 0.2 m aside."""
    assert same(objects_of([moved(0.2), moved(0, 0.3)]), EXPECTED[:3], 2.0, FRAME) == 1
