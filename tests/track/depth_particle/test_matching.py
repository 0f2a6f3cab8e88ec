# SPDX-License-Identifier: MIT
"""Which object is the target."""

import numpy as np
import pytest
from tricue import _core
from tricue.track.depth_particle.matching import FOLLOWED, MISSED, best_match
from tricue.track.depth_particle.motion import BodyMotion
from tricue.track.depth_particle.signature import Signature

TARGET = [0.0, 0.0, 3.0, 0.6, 1.7]
EXPECTED = np.array(TARGET)
KNOWN = BodyMotion.start(EXPECTED, np.array([True, True]))
UNKNOWN = BodyMotion.start(EXPECTED, np.array([False, False]))
EVEN = Signature.uniform()
FRAME = 1 / 15
LENIENT, STRICT = FOLLOWED._replace(max_cost=6.0), FOLLOWED._replace(max_cost=1.0)


def moved(*by: float) -> list[float]:
    """The target's state, changed by the numbers given."""
    return (EXPECTED + np.pad(by, (0, 5 - len(by)))).tolist()


def match(objects, motion=KNOWN, seconds=FRAME, limits=FOLLOWED, signature=EVEN, **options):
    """The best match among objects."""
    return best_match(_core, objects, EXPECTED, motion, signature, seconds, limits, **options)


def test_nothing_matches_nothing(objects_of):
    """Without objects there is no match."""
    assert match(objects_of([])) is None


@pytest.mark.parametrize("axis", range(5), ids=["x", "y", "z", "width", "height"])
def test_the_nearest_in_position_and_size_matches(axis, objects_of):
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
    """An object that is far off in any one of position and size isn't the target, even when it is alone."""
    assert match(objects_of([moved(*by)])) is None


@pytest.mark.parametrize("by", [(0.8,), (0, 1.5), (0, 0, -0.8)], ids=str)
def test_time_widens_the_region(by, objects_of):
    """What is too far off a frame later may be the target two seconds later."""
    there = objects_of([moved(*by)])
    assert match(there) is None
    assert match(there, seconds=2.0) == 0


def test_a_stricter_limit_refuses_more(objects_of):
    """An object that passes for a target just seen is refused by a lower limit."""
    there = objects_of([moved(0.4)])
    assert match(there, limits=LENIENT) == 0
    assert match(there, limits=STRICT) is None


@pytest.mark.parametrize(("limits", "least"), [(FOLLOWED, 0.25), (MISSED, 0.45)])
def test_a_small_part_is_no_target(limits, least, objects_of):
    """An object of under a quarter of the target's area isn't the target, though completed to its size; after
    the target was missed it takes nearly half of it.
    """
    for share in (0.95 * least, 1.05 * least):
        part = objects_of([[0, 0, 3.0, 0.6, share * 1.7]], [[1, 1, 1, 1]])
        assert match(part, limits=limits) == (0 if share > least else None)


def test_what_is_cut_counts_as_completed(objects_of):
    """The half of the target that is visible beside an occluder is at its position. The same half, whole, is
    somebody narrow who stands aside.
    """
    half = [0.15, 0, 3.0, 0.3, 1.7]
    assert match(objects_of([half], [[1, 0, 0, 0]]), limits=STRICT) == 0
    assert match(objects_of([half]), limits=STRICT) is None
    assert match(objects_of([half, half], [[0, 0, 0, 0], [1, 0, 0, 0]])) == 1


def test_an_unknown_size_may_grow(objects_of):
    """A larger object is the target where its size was only a lower bound, and isn't where it was known."""
    larger = objects_of([moved(0, 0, 0, 0.4, 1.0)])
    assert match(larger, UNKNOWN, limits=LENIENT) == 0
    assert match(larger, KNOWN, limits=LENIENT) is None


def test_an_unknown_size_rather_grows_than_shrinks(objects_of):
    """A lower bound is one: of two objects as far off in height, the taller is the target; where the height
    was known, neither is nearer.
    """
    taller, shorter = moved(0, 0, 0, 0, 0.6), moved(0, 0, 0, 0, -0.6)
    assert match(objects_of([shorter, taller]), UNKNOWN) == 1
    assert match(objects_of([taller, shorter]), UNKNOWN) == 0
    assert match(objects_of([shorter, taller]), KNOWN) == 0


@pytest.mark.parametrize("cut", [False, True], ids=["whole", "cut"])
def test_a_whole_object_is_recognized_by_its_signature(cut, objects_of):
    """Of two at the same position the one with the target's distribution is the target. What is cut isn't
    compared by that, and the first is taken.
    """
    two = objects_of([TARGET, TARGET], 2 * [[0, 0, 0, int(cut)]])
    rows = two.rows.copy()
    rows[0] = np.eye(1, rows.shape[1], dtype=np.float32)
    assert match(two._replace(rows=rows)) == (0 if cut else 1)


def test_other_costs_come_on_top(objects_of):
    """The nearest object isn't the target where it costs more otherwise; an infinite cost excludes it."""
    two = objects_of([TARGET, moved(0.1)])
    assert match(two) == 0
    assert match(two, other_costs=np.array([1.0, 0.0])) == 1
    assert match(two, other_costs=np.array([np.inf, np.inf])) is None


def test_what_is_cut_may_count_as_it_is(objects_of):
    """Without completion the half that is visible beside an occluder is somebody narrow who stands aside."""
    half = objects_of([[0.15, 0, 3.0, 0.3, 1.7]], [[1, 0, 0, 0]])
    assert match(half, limits=STRICT) == 0
    assert match(half, limits=STRICT, complete=False) is None


def test_matching_changes_nothing(objects_of):
    """States, expected state and motion are only read."""
    objects = objects_of([moved(0.1), moved(0, 0, 0.2)])
    states, expected = objects.states.copy(), EXPECTED.copy()
    match(objects, UNKNOWN)
    np.testing.assert_array_equal(objects.states, states)
    np.testing.assert_array_equal(EXPECTED, expected)
