# SPDX-License-Identifier: MIT
"""How the depth tracker's target moves: what a walk predicts, and what it learns from a place and a size."""

import numpy as np
import pytest
from tricue import DepthParticleTracker
from tricue.track.depth_particle.walk import RETURN, SMALLEST, STAND, UPRIGHT, Walk

P = DepthParticleTracker.Params(agility=0.5, size_noise=0.06, fastest=2.0, velocity_rate=0.5, size_rate=0.15)
STATE = np.array([0.2, -0.1, 3.0, 0.6, 1.7])
WHOLE, CUT = np.array([True, True]), np.array([False, False])
SECOND = 1.0


def walk(**changes: object) -> Walk:
    """A walk at rest in STATE, but for the changes."""
    return Walk.start(STATE, WHOLE)._replace(**changes)


def test_a_walk_starts_at_rest():
    """At the start the velocity is zero and the usual size is the size seen."""
    start = Walk.start(STATE, WHOLE)
    np.testing.assert_array_equal(start.velocity, 0)
    np.testing.assert_array_equal(start.size, STATE[3:])
    np.testing.assert_array_equal(start.known, WHOLE)


def test_the_start_shares_no_size_with_its_state():
    """The usual size is the walk's own: a change of the state given doesn't reach it."""
    given = STATE.copy()
    start = Walk.start(given, WHOLE)
    given[3:] = 9
    np.testing.assert_array_equal(start.size, STATE[3:])


@pytest.mark.parametrize("seconds", [1 / 30, 1 / 15, 0.5])
def test_prediction_is_metres_a_second(seconds):
    """The drift is velocity times time, in metres, and the size returns to the usual by its share."""
    prediction = walk(velocity=np.array([1.0, 0.0, -0.5]), size=np.array([0.8, 1.6])).predict(P, seconds, 0)
    expected = [seconds, 0, -0.5 * seconds, RETURN * 0.2, RETURN * -0.1]
    np.testing.assert_allclose(prediction.drift, expected, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(prediction.scale[:3], STAND + 0.5 * seconds * UPRIGHT, rtol=1e-12)
    np.testing.assert_allclose(prediction.scale[3:], 0.06 * np.array([0.8, 1.6]), rtol=1e-12)


def test_noise_grows_while_missed_up_to_a_second():
    """The seconds for which it was missed add to the noise of the place, up to one in all; sizes aren't
    touched.
    """
    scales = np.array([walk().predict(P, 0.1, 0.1 * missed).scale for missed in range(40)])
    assert (np.diff(scales[:10, :3], axis=0) > 0).all()
    np.testing.assert_allclose(scales[9:, :3] - (STAND + 0.5 * UPRIGHT), 0, atol=1e-12)
    assert np.ptp(scales[:, 3:], axis=0).max() == 0


def test_noise_of_a_long_frame_is_not_cut():
    """A single frame of two seconds has the noise of two seconds, though hidden targets stop at one."""
    np.testing.assert_allclose(walk().predict(P, 2.0, 5.0).scale[:3], STAND + 0.5 * 2 * UPRIGHT, rtol=1e-12)


def test_predictions_stay_in_range():
    """Depths stay between near and far, sizes above the smallest; sideways there is no bound."""
    prediction = walk().predict(P, SECOND, 0)
    np.testing.assert_array_equal(prediction.lower, [-np.inf, -np.inf, P.near, SMALLEST, SMALLEST])
    np.testing.assert_array_equal(prediction.upper, [np.inf, np.inf, P.far, np.inf, np.inf])


def test_velocity_is_learned_from_steady_places_only():
    """A step of 0.1 m in 0.1 s is 1 m/s, of which the smoothing takes its half; unsteady places teach
    nothing.
    """
    there = STATE + [0.1, 0, 0, 0, 0]
    seen = walk().seen(there, P, 0.1, steady=True)
    np.testing.assert_allclose(seen.velocity, [0.5, 0, 0], rtol=1e-9)
    np.testing.assert_array_equal(seen.state, there)
    hidden = walk(velocity=np.array([0.3, 0, 0])).seen(there, P, 0.1, steady=False)
    np.testing.assert_array_equal(hidden.velocity, [0.3, 0, 0])
    np.testing.assert_array_equal(hidden.state, there)


@pytest.mark.parametrize("rate", [15, 30, 60])
def test_velocity_does_not_depend_on_the_frame_rate(rate):
    """Somebody who walks at 1.2 m/s is learned to walk at 1.2 m/s, at 15, 30 and 60 frames/s."""
    now = walk()
    for i in range(1, 4 * rate):
        now = now.seen(STATE + np.array([1.2 * i / rate, 0, 0, 0, 0]), P, 1 / rate, steady=True)
    np.testing.assert_allclose(now.velocity, [1.2, 0, 0], rtol=1e-6, atol=1e-9)


def test_nobody_is_faster_than_the_fastest():
    """A jump of 3 m in a frame counts as the fastest speed in its direction."""
    far = STATE + [0, 0, 3.0, 0, 0]
    np.testing.assert_allclose(walk().seen(far, P, 0.1, steady=True).velocity, [0, 0, 1.0], rtol=1e-9)


def test_coasting_keeps_a_share_of_the_velocity():
    """A coasted walk is where it was predicted, with a share of its velocity; size and memory stay."""
    before = walk(velocity=np.array([1.0, 0.5, -1.0]))
    after = before.coasted(STATE + 1, 0.9)
    np.testing.assert_array_equal(after.state, STATE + 1)
    np.testing.assert_allclose(after.velocity, [0.9, 0.45, -0.9], rtol=1e-12)
    assert after.size is before.size
    assert after.known is before.known


def test_an_unknown_size_grows_only():
    """A size never seen whole grows to what is seen of it, never shrinks; a known one stays."""
    unknown = walk(known=np.array([False, False]))
    np.testing.assert_array_equal(unknown.outgrown(np.array([0.9, 1.2])).size, [0.9, 1.7])
    np.testing.assert_array_equal(walk().outgrown(np.array([0.9, 2.0])).size, STATE[3:])


def test_a_whole_size_is_blended_in():
    """A whole size moves a known one by the rate of its memory, larger or smaller."""
    after = walk().measured(np.array([0.8, 1.5]), WHOLE, P)
    np.testing.assert_allclose(after.size, [0.6 + 0.15 * 0.2, 1.7 - 0.15 * 0.2], rtol=1e-12)


def test_a_cut_size_is_a_lower_bound():
    """A cut size never makes the usual one smaller, and doesn't make it known."""
    after = walk(known=CUT).measured(np.array([0.4, 1.9]), CUT, P)
    assert after.size[0] == 0.6
    assert 1.7 < after.size[1] <= 1.9
    assert not after.known.any()


def test_the_first_whole_size_is_learned_fast():
    """A size seen whole for the first time is known from then on, and learned at once for the most part."""
    first = walk(known=CUT).measured(np.array([0.8, 1.7]), np.array([True, False]), P)
    np.testing.assert_array_equal(first.known, [True, False])
    assert first.size[0] > 0.6 + 0.5 * 0.2
    again = first.measured(np.array([0.6, 1.7]), CUT, P)
    np.testing.assert_array_equal(again.known, [True, False])
