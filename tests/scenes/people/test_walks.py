# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.scenes.people import walks
from tricue.scenes.people.body import Person

seeds = st.integers(0, 2**32 - 1)
FLOOR = walks.WalkableArea(2.4, 6.0, 0.44, 2.5)


def steps(path):
    """The lengths (M - 1,) of a path's steps."""
    return np.hypot(*np.diff(path, axis=0).T)


@given(seeds, st.integers(1, 200), st.sampled_from([15.0, 30.0]))
def test_a_loop_keeps_a_walkers_pace_and_the_floor(seed, frames, rate):
    """No step is slower than 0.3 or faster than 1.5 m/s, and no place is off the floor that is seen."""
    rng = np.random.default_rng(seed)
    crouch = walks.sample_gestures(frames, rate, rng).crouch
    path = walks.sample_loop(FLOOR, crouch, rate, rng)
    assert path.shape == (frames, 2)
    assert np.all(steps(path) * rate > 0.9 * walks.MIN_WALKING_SPEED)  # a chord is shorter than its arc
    assert np.all(steps(path) * rate <= walks.MAX_WALKING_SPEED + 1e-9)
    x, z = path.T
    assert np.all((z >= FLOOR.near) & (z <= FLOOR.far))
    assert np.all(np.abs(x) <= FLOOR.reach(z) + 1e-9)


@given(seeds)
def test_a_loop_leads_nearer_and_away(seed):
    """In six seconds a walker comes more than 0.6 m nearer and goes as far away."""
    z = walks.sample_loop(FLOOR, np.zeros(90), 15, np.random.default_rng(seed))[:, 1]
    nearer = (np.maximum.accumulate(z) - z).max()
    away = (z - np.minimum.accumulate(z)).max()
    assert min(nearer, away) > 0.6  # the least of 20,000 seeds is 0.64


@given(seeds)
def test_gestures_take_turns(seed):
    """In six seconds all three gestures happen, in [0, 1] or a whole turn, and never two at a time."""
    crouch, arms, turn = walks.sample_gestures(90, 15, np.random.default_rng(seed))
    for amount in (crouch, arms):
        assert amount.min() == 0
        assert 0.55 < amount.max() <= 1
    assert np.abs(turn).max() > 3
    assert not np.any((crouch > 0) & (arms > 0))


def test_sweeps_go_to_and_fro():
    """Time runs from -3 to 3 s and back at its own rate; a shorter scene is centered."""
    time = walks.compute_sweep_times(181, 15)
    assert (time.min(), time.max()) == pytest.approx((-3, 3))
    np.testing.assert_allclose(time[:91], np.linspace(-3, 3, 91), atol=1e-12)
    np.testing.assert_allclose(time[90:], np.linspace(3, -3, 91), atol=1e-12)
    np.testing.assert_allclose(walks.compute_sweep_times(31, 30), np.linspace(-0.5, 0.5, 31), atol=1e-12)
    np.testing.assert_array_equal(walks.compute_sweep_times(1, 30), [0])


def test_linger_slows_time_down_in_the_middle():
    """Round 0 time passes at a tenth, elsewhere at 1, without a jump."""
    time = np.linspace(-2, 2, 401)
    rates = np.gradient(walks.slow_down_time(time, 1.0, 0.1), time)
    assert rates[np.abs(time) < 0.45] == pytest.approx(0.1)
    assert rates[np.abs(time) > 0.55] == pytest.approx(1.0)


def test_headings_follow_the_path_at_a_persons_rate():
    """One who walks straight faces ahead; who turns back does so within TURN; who looks, faces the camera."""
    there = np.stack([np.linspace(-1, 1, 31), np.full(31, 3.0)], axis=1)
    path = np.concatenate([there, there[::-1]])
    facing = walks.compute_headings(path, 15)
    np.testing.assert_allclose(facing[:30], np.pi / 2, atol=1e-9)
    assert np.cos(facing[-1] + np.pi / 2) == pytest.approx(1)
    assert np.abs(np.diff(facing)).max() == pytest.approx(walks.MAX_TURN_RATE / 15)
    looking = walks.compute_headings(there + [0.0, 1.0], 15, np.ones(31, dtype=bool))
    bearing = np.arctan2(there[:, 0], 4.0)
    np.testing.assert_allclose(np.cos(looking - bearing), -1, atol=1e-9)


def test_feet_swing_with_the_pace():
    """Who stands has still legs; a stride, two steps, takes 0.8 heights of way; speed widens the swing."""
    person = Person(1.8, 1.0)
    still = walks.compute_poses(person, np.zeros((5, 2)) + 3, 15)
    assert {pose.swing for pose in still} == {0.0}
    z = np.linspace(3, 3 + 0.8 * 1.8, 31)
    brisk = walks.compute_poses(person, np.stack([np.zeros(31), z], axis=1), 15)
    slow = walks.compute_poses(person, np.stack([np.zeros(31), z], axis=1), 7.5)
    assert brisk[-1].gait - brisk[0].gait == pytest.approx(2 * np.pi)
    assert brisk[3].swing == pytest.approx(2 * slow[3].swing)


@given(seeds)
def test_clutter_leaves_the_sight_free(seed):
    """No piece of furniture comes within an arm's reach of a line from the camera to a walker."""
    rng = np.random.default_rng(seed)
    path = walks.sample_loop(FLOOR, np.zeros(60), 15, rng)
    for piece in walks.place_furniture(8, 8.0, 4.0, path, rng):
        sight = (path[:, None] * np.linspace(0, 1, 200)[:, None]).reshape(-1, 2)
        away = np.hypot(sight[:, 0] - piece.x, sight[:, 1] - piece.z).min()
        assert away - np.hypot(piece.width, piece.depth) / 2 > walks.ARM_CLEARANCE - 1e-9
