# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue.scenes.overtakings.hall import Hall
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.overtakings.truth import LazySequence, WalkGeometry
from tricue.scenes.people.pedestrian import Pedestrian
from tricue.scenes.rendering.ellipsoids import OrientedEllipsoids
from tricue.scenes.rendering.stereo_camera import TexturedRectangle

RIG = StereoRig(Intrinsics.from_fov(160, 120, 40), 0.12)


def ball(*centers, radius=0.2, turns=None):
    """One ball that is at a center in each frame, turned so."""
    turns = [np.eye(3)] * len(centers) if turns is None else turns
    parts = [
        OrientedEllipsoids(np.array([center], float), radius * np.array([turn]))
        for center, turn in zip(centers, turns, strict=True)
    ]
    return Pedestrian(parts, [])


def truth(*people, angles=(0.0, 0.0), wall=6.0):
    """Balls before a wall, and a pan."""
    texture = [np.full((8, 8, 3), 100, np.float32)]
    sides = np.array([-9.0, -9.0, wall]), np.array([18.0, 0, 0]), np.array([0, 18.0, 0])
    return WalkGeometry(
        Pan(RIG, 1.0, np.array(angles)), Hall([TexturedRectangle(*sides, texture)]), list(people)
    )


FAR = ball((0, 0, 5.9), (0, 0, 5.9), radius=0.01)


def test_lazy_items_are_made_when_asked_for():
    """Items, from both ends and in slices, are those that the function makes, and only the ones asked for."""
    made = []
    items = LazySequence(5, lambda index: made.append(index) or 10 * index)
    assert (len(items), items[1], items[-1]) == (5, 10, 40)
    assert list(items[1:4]) == [10, 20, 30]
    assert items[3:0:-2][1] == 10
    assert made == [1, 4, 1, 2, 3, 1]
    assert list(items) == [0, 10, 20, 30, 40]
    for index in (5, -6):
        with pytest.raises(IndexError):
            items[index]


def test_a_ball_that_moves_aside_has_the_flow_of_a_projected_point():
    """At the ball's middle flow is f x / z, what is before and behind it stays, its disparity is f b / z."""
    scene = truth(ball((0, 0, 2.2), (0.01, 0, 2.2)), FAR, FAR)
    flow, disparity = scene.flow(1), scene.disparity(1)
    f = RIG.intrinsics.fx
    assert flow[59, 80] == pytest.approx([f * 0.01 / 2.0, 0], rel=0.01)
    assert disparity[59, 80] == pytest.approx(f * 0.12 / 2.0, rel=0.01)
    assert flow[10, 10] == pytest.approx([0, 0], abs=1e-5)
    assert disparity[10, 10] == pytest.approx(f * 0.12 / 6.0, rel=1e-5)
    assert np.isnan(scene.flow(0)).all()


def test_a_ball_that_turns_moves_where_it_is():
    """Turning about the vertical by a, the point nearest to the camera moves by f r sin a / z."""
    cos, sin = np.cos(0.05), np.sin(0.05)
    turned = np.array([[cos, 0, -sin], [0, 1, 0], [sin, 0, cos]])
    scene = truth(ball((0, 0, 2.2), (0, 0, 2.2), turns=[np.eye(3), turned]), FAR, FAR)
    middle = scene.flow(1)[59:61, 79:81].mean(axis=(0, 1))
    assert middle == pytest.approx([RIG.intrinsics.fx * 0.2 * sin / 2.0, 0], rel=0.02, abs=1e-3)


def test_a_pan_moves_what_stands_still():
    """Turning right by a the middle of the picture moves left by f tan a, whatever its distance."""
    standing = ball((0, 0, 2.2), (0, 0, 2.2))
    scene = truth(standing, FAR, FAR, angles=(0.0, 0.004))
    flow = scene.flow(1)
    for v, u in ((59, 80), (5, 80)):
        assert flow[v, u, 0] == pytest.approx(-RIG.intrinsics.fx * np.tan(0.004), rel=0.01)


def test_who_hides_whom_follows_from_the_depths():
    """A nearer ball of half the angle takes a quarter of the target's pixels; a farther one takes none."""
    target = ball((0, 0, 4.0))
    for z, share in ((2.0, 0.75), (5.0, 1.0)):
        scene = truth(target, ball((0, 0, z), radius=0.05 * z / 2), ball((3, 0, 5.0)), angles=(0.0,))
        found = scene.truth_at(0)
        assert found.visible == pytest.approx(share, abs=0.025)  # of some 380 pixels
        assert found.mask.sum() == pytest.approx(share * np.pi * (0.05 * RIG.intrinsics.fx) ** 2, rel=0.05)
        assert [other.position[2] > 4 for other in found.others] == [z > 4, True]
    gone = truth(ball((9, 0, 4.0)), target, target, angles=(0.0,)).truth_at(0)
    assert (gone.visible, gone.visible_box, gone.mask.any()) == (0.0, None, False)
