# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.rig import Intrinsics

from benchmarks.quality.common import target_surround

CAMERA = Intrinsics.from_fov(240, 180, 60.0)
BOX = np.array([100.0, 60, 40, 50])


def floor_and_wall(foot, distance, wall=2.0):
    """A floor that is ``distance`` away in the row ``foot``, its 1/z a tenth more 40 rows below; a wall."""
    inverse = (1 + (np.arange(180) - foot) / 400) / distance
    return np.tile(np.minimum(1 / inverse, wall)[:, None], (1, 240))


def test_a_floating_target_has_nothing_as_far_away():
    """Before a wall all four sides are behind it, and lie on one plane that it stands off."""
    depth = np.full((180, 240), 2.0)
    depth[60:110, 100:140] = 1.2
    found = target_surround.look_around(depth, BOX, CAMERA)
    assert found.same == (0, 0, 0, 0)
    assert (found.unmeasured, found.plane) == (0, 1)
    assert found.height == pytest.approx(0.8, abs=0.02)


def test_a_target_on_the_floor_has_the_floor_below():
    """Below it the floor is as far away as it is, above it the wall isn't."""
    depth = floor_and_wall(109, 1.6)
    depth[60:110, 100:140] = 1.6
    found = target_surround.look_around(depth, BOX, CAMERA)
    left, right, above, below = found.same
    assert above == 0
    assert below == 1
    assert 0.2 < left < 0.6
    assert right == left


def test_what_leans_on_a_wall_has_it_on_all_sides():
    """Two centimeters before the wall: everything around is as far away, and the plane is near."""
    depth = np.full((180, 240), 1.5)
    depth[60:110, 100:140] = 1.48
    found = target_surround.look_around(depth, BOX, CAMERA)
    assert found.same == (1, 1, 1, 1)
    assert found.height == pytest.approx(0.02, abs=0.015)


def test_holes_are_told_and_not_counted():
    """Shares are of what was measured; a target without depth has no surround."""
    depth = np.full((180, 240), 1.5)
    depth[:, 140:] = np.nan
    found = target_surround.look_around(depth, BOX, CAMERA)
    assert found.same[0] == 1
    assert np.isnan(found.same[1])
    assert found.unmeasured == pytest.approx(1 / 4, abs=0.03)
    depth[60:110, 100:140] = np.nan
    assert target_surround.look_around(depth, BOX, CAMERA) is None


def test_motion_is_in_sides_of_the_box():
    """A box of 20x20 that moves by 5 px steps a quarter; frames without it don't count."""
    boxes = np.array([[0.0, 0, 20, 20], [5, 0, 20, 20], [np.nan] * 4, [9, 9, 20, 20], [9, 14, 20, 20]])
    assert target_surround.motion(boxes).tolist() == [0.25, 0.25]
