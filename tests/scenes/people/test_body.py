# SPDX-License-Identifier: MIT
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.scenes.people.body import (
    BodyPose,
    Person,
    build_body,
    build_oriented_body,
    place_body,
    rotation_about_y,
)

persons = st.builds(Person, st.floats(1.55, 1.95), st.floats(0.9, 1.15))
poses = st.builds(BodyPose, st.floats(0, 20), st.floats(0, 0.5), st.floats(0, 1), st.floats(0, 1))


def extent(bodies, axis):
    """The lowest and the highest coordinate that the ellipsoids reach on an axis, meters."""
    half = np.sqrt(bodies.shapes[:, axis, axis])
    return (bodies.centers[:, axis] - half).min(), (bodies.centers[:, axis] + half).max()


@given(persons, poses)
def test_body_stands_on_the_floor(person, pose):
    """In every pose the lowest point is on the floor, and every ellipsoid has a volume."""
    bodies = build_body(person, pose)
    assert extent(bodies, 1)[1] == pytest.approx(0, abs=1e-12)
    assert np.linalg.eigvalsh(bodies.shapes).min() > 0.01**2


@given(persons)
def test_at_ease_a_person_is_as_tall_as_said(person):
    """From the floor to the top of the head it is the person's height; breadth and depth are human."""
    bodies = build_body(person, BodyPose())
    assert extent(bodies, 1)[0] == pytest.approx(-person.height, abs=1e-9)
    assert 0.25 * person.height < np.ptp(extent(bodies, 0)) < 0.45 * person.height
    assert 0.12 * person.height < np.ptp(extent(bodies, 2)) < 0.30 * person.height


def test_poses_change_the_outline():
    """A squat takes a quarter of the height or more, raised arms reach over the head, a stride is long."""
    person = Person(1.8, 1.0)
    assert -extent(build_body(person, BodyPose(crouch=1)), 1)[0] < 0.75 * 1.8
    assert -extent(build_body(person, BodyPose(arms=1)), 1)[0] > 1.15 * 1.8
    stride = np.ptp(extent(build_body(person, BodyPose(gait=math.pi / 2, swing=0.4)), 2))
    assert 0.6 < stride < 1.2


def test_legs_swing_against_each_other():
    """Half a stride later left and right have changed places."""
    person = Person(1.7, 1.0)
    first, second = (build_body(person, BodyPose(gait=gait, swing=0.4)) for gait in (0.7, 0.7 + math.pi))
    mirrored = second.centers * [-1, 1, 1]
    distances = np.linalg.norm(first.centers[:, None] - mirrored[None], axis=2)
    assert distances.min(axis=1).max() < 1e-9


@pytest.mark.parametrize(("yaw", "ahead"), [(0, (0, 1)), (math.pi / 2, (1, 0)), (math.pi, (0, -1))])
def test_standing_turns_and_moves(yaw, ahead):
    """A yaw of 0 faces along z, of 90 degrees along x: that is where the feet point to from the heels."""
    bodies = place_body(Person(1.8, 1.0), BodyPose(), x=0.7, z=3.0, yaw=yaw, floor=1.4)
    assert extent(bodies, 1) == pytest.approx((1.4 - 1.8, 1.4))
    lowest = np.argsort(bodies.centers[:, 1])[-2:]
    feet = bodies.centers[lowest].mean(axis=0) - [0.7, 0, 3.0]
    np.testing.assert_allclose(feet[[0, 2]] / np.linalg.norm(feet[[0, 2]]), ahead, atol=1e-9)


def test_drawn_people_are_adults():
    """Heights spread over 1.55 to 1.95 m, and nobody is shorter than asked for."""
    rng = np.random.default_rng(0)
    heights = np.array([Person.sample(rng).height for _ in range(300)])
    assert 1.55 <= heights.min() < 1.58
    assert 1.92 < heights.max() <= 1.95
    assert min(Person.sample(rng, shortest=1.8).height for _ in range(100)) >= 1.8


@given(persons, poses)
def test_roots_are_turns_of_the_axes(person, pose):
    """A root's columns are at right angles and make a right hand: it only turns and stretches a ball."""
    for root in build_oriented_body(person, pose).roots:
        lengths = np.linalg.norm(root, axis=0)
        turn = root / lengths
        np.testing.assert_allclose(turn.T @ turn, np.eye(3), atol=1e-9)
        assert np.linalg.det(turn) > 0


@given(persons, st.floats(0, 20), st.floats(0, 0.5))
def test_a_limbs_poles_are_near_its_joints(person, gait, swing):
    """A thigh's -y pole is at the hip and its y pole at the knee, where the shank's -y pole is."""
    centers, roots = build_oriented_body(person, BodyPose(gait, swing))
    for thigh, shank in ((6, 7), (12, 13)):
        upper, lower = (centers[part] + np.outer([-1, 1], roots[part][:, 1]) for part in (thigh, shank))
        assert np.linalg.norm(upper[1] - lower[0]) < 0.07 * person.height  # each reaches over the knee
        assert upper[0, 1] < upper[1, 1] < lower[1, 1]


def test_moving_balls_moves_their_ellipsoids():
    """Ellipsoids of moved balls are the moved ellipsoids."""
    person, turn, offset = Person(1.7, 1.0), rotation_about_y(0.7), np.array([0.3, -0.2, 4.0])
    moved = build_oriented_body(person, BodyPose(1.0, 0.3)).transformed(turn, offset).ellipsoids
    same = build_body(person, BodyPose(1.0, 0.3)).transformed(turn, offset)
    np.testing.assert_allclose(moved.centers, same.centers, atol=1e-12)
    np.testing.assert_allclose(moved.shapes, same.shapes, atol=1e-12)
