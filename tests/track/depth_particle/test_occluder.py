# SPDX-License-Identifier: MIT
"""Which object hides the target, where it goes, and that it is no candidate for the target."""

import numpy as np
import pytest
from tricue.track.depth_particle.occluder import (
    MIN_OCCLUDER_STEP,
    find_occluder,
    follow_occluder,
    remove_occluder,
)

EXPECTED = np.array([0.0, 0.0, 3.0, 0.6, 1.7])
FRAME = 1 / 15


def moved(*by: float) -> list[float]:
    """The target's state, changed by the numbers given."""
    return (EXPECTED + np.pad(by, (0, 5 - len(by)))).tolist()


def test_nothing_hides_nothing(objects_of):
    """Without objects there is no occluder, and none that is followed or removed."""
    nothing = objects_of([])
    assert find_occluder(nothing, EXPECTED, 0.3) is None
    assert follow_occluder(nothing, EXPECTED[:3], 2.0, FRAME) is None
    assert len(remove_occluder(nothing, EXPECTED[:3]).states) == 0


def test_removal_takes_what_stands_there(objects_of):
    """Objects within half a meter of the occluder on the ground are removed, at whatever height. Others stay
    in order, all fields alike.
    """
    objects = objects_of([moved(1.0), moved(0.3, -1.5), moved(0, 0, 0.4), moved(0, 0, 0.6)])
    rest = remove_occluder(objects, EXPECTED[:3])
    for kept, each in zip(rest, objects, strict=True):
        np.testing.assert_array_equal(kept, each[[0, 3]])


def test_the_occluder_is_nearer_and_in_the_way(objects_of):
    """Of what is nearer, that which covers most of the rectangle, as the camera sees it, is the occluder."""
    behind, beside, partly, wholly = moved(0, 0, 1), moved(2, 0, -1), moved(0.3, 0, -1), moved(0, 0, -1)
    assert find_occluder(objects_of([behind, beside, partly, wholly]), EXPECTED, 0.3) == 3
    assert find_occluder(objects_of([behind, beside, partly]), EXPECTED, 0.3) == 2
    assert find_occluder(objects_of([behind, beside]), EXPECTED, 0.3) is None


def test_the_occluder_is_on_the_line_of_sight(objects_of):
    """A target at 2 m to the side and 4 m away is covered by what is 1 m to the side and 2 m away."""
    aside = np.array([2.0, 0.0, 4.0, 0.6, 1.7])
    on_the_line, at_its_side = [1.0, 0.0, 2.0, 0.5, 1.7], [2.0, 0.0, 2.0, 0.5, 1.7]
    assert find_occluder(objects_of([at_its_side, on_the_line]), aside, 0.3) == 1
    assert find_occluder(objects_of([at_its_side]), aside, 0.3) is None


@pytest.mark.parametrize("axis", [0, 1], ids=["beside", "above or below"])
@pytest.mark.parametrize("sense", [-1, 1])
def test_what_reaches_the_target_as_the_camera_sees_it_covers_it(axis, sense, objects_of):
    """An object half as far away looks twice as large: it covers the target from where their edges meet."""
    edge = sense * EXPECTED[3 + axis] / 2 / 2
    for by, covers in ((0.01, False), (-0.01, True)):
        there = np.array([0.0, 0.0, 1.5, 0.2, 0.4])
        there[axis] = edge + sense * (there[3 + axis] / 2 + by)
        assert find_occluder(objects_of([there]), EXPECTED, 0.3) == (0 if covers else None)


def test_what_is_hardly_nearer_covers_nothing(objects_of):
    """An object nearer by less than the margin isn't in front."""
    just = objects_of([moved(0, 0, -0.29)])
    assert find_occluder(just, EXPECTED, 0.3) is None
    assert find_occluder(just, EXPECTED, 0.2) == 0


def test_an_occluder_is_followed_within_reach(objects_of):
    """The occluder is the nearest object within the distance that it can have moved, and no other."""
    objects = objects_of([moved(0.35), moved(0.2)])
    assert follow_occluder(objects, EXPECTED[:3], 2.0, FRAME) == 1
    gone = objects_of([moved(MIN_OCCLUDER_STEP + 0.5)])
    assert follow_occluder(gone, EXPECTED[:3], 2.0, 0.1) is None
    assert follow_occluder(gone, EXPECTED[:3], 2.0, 0.3) == 0


def test_heights_count_less_for_an_occluder(objects_of):
    """A middle 0.3 m lower, as of somebody cut, is nearer than one 0.2 m aside."""
    assert follow_occluder(objects_of([moved(0.2), moved(0, 0.3)]), EXPECTED[:3], 2.0, FRAME) == 1
