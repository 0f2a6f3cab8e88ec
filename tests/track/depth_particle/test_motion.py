# SPDX-License-Identifier: MIT
"""The depth tracker's motion model: its predictions, and what it learns from a position and a size."""

from dataclasses import replace

import numpy as np
import pytest
from tricue import DepthParticleTracker
from tricue.track.depth_particle.motion import (
    AXIS_NOISE,
    MIN_POSITION_NOISE,
    MIN_SIZE,
    SIZE_RETURN,
    BodyMotion,
)

P = DepthParticleTracker.Params(
    position_noise=0.5, speed_noise=0.4, size_noise=0.06, max_speed=2.0, velocity_rate=0.5, size_rate=0.15
)
STATE = np.array([0.2, -0.1, 3.0, 0.6, 1.7])
WHOLE, CUT = np.array([True, True]), np.array([False, False])
SECOND = 1.0


def motion(**changes: object) -> BodyMotion:
    """A motion at rest in STATE, but for the changes."""
    return BodyMotion.start(STATE, WHOLE)._replace(**changes)


def test_a_motion_starts_at_rest():
    """At the start the velocity is zero and the mean size is the initial size."""
    start = BodyMotion.start(STATE, WHOLE)
    np.testing.assert_array_equal(start.velocity, 0)
    np.testing.assert_array_equal(start.mean_size, STATE[3:])
    np.testing.assert_array_equal(start.size_known, WHOLE)


def test_the_start_shares_no_size_with_its_state():
    """The mean size is a copy: a change of the given state doesn't reach it."""
    given = STATE.copy()
    start = BodyMotion.start(given, WHOLE)
    given[3:] = 9
    np.testing.assert_array_equal(start.mean_size, STATE[3:])


@pytest.mark.parametrize("seconds", [1 / 30, 1 / 15, 0.5])
def test_prediction_is_in_meters_per_second(seconds):
    """The drift is velocity times time, in meters, and the size returns to its mean by a share."""
    prediction = motion(velocity=np.array([0.8, 0.0, -0.6]), mean_size=np.array([0.8, 1.6])).predict(
        P, seconds, 0
    )
    expected = [0.8 * seconds, 0, -0.6 * seconds, SIZE_RETURN * 0.2, SIZE_RETURN * -0.1]
    np.testing.assert_allclose(prediction.drift, expected, rtol=1e-12, atol=1e-15)
    noise = 0.5 + 0.4 * 1.0  # of who stands, and of the speed of 1 m/s
    np.testing.assert_allclose(
        prediction.scale[:3], MIN_POSITION_NOISE + noise * seconds * np.array(AXIS_NOISE), rtol=1e-12
    )
    np.testing.assert_allclose(prediction.scale[3:], 0.06 * np.array([0.8, 1.6]), rtol=1e-12)


def test_k_increases_with_velocity():
    """Section IV.C of the paper: K of (39) "increases when the person is moving with higher velocity", so
    that samples are propagated over a larger area, whichever way the person moves.
    """
    default = DepthParticleTracker.Params()
    for way in ([1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.6, 0.0, 0.8]):
        speeds = np.array([0.0, 0.1, 0.5, 1.0, 2.0])
        scales = np.array(
            [motion(velocity=speed * np.array(way)).predict(default, 0.1, 0).scale for speed in speeds]
        )
        assert (np.diff(scales[:, :3], axis=0) > 0).all()
        assert np.ptp(scales[:, 3:], axis=0).max() == 0
        assert scales[-1, 0] > 1.5 * scales[0, 0]


def test_constant_motion_has_no_drift_and_the_same_noise():
    """(39) with A = I: neither the velocity nor the mean size moves a particle, and K is as with a drift."""
    moving = motion(velocity=np.array([0.8, 0.0, -0.6]), mean_size=np.array([0.8, 1.6]))
    constant = moving.predict(replace(P, motion="constant"), SECOND, 0)
    np.testing.assert_array_equal(constant.drift, np.zeros(5))
    np.testing.assert_array_equal(constant.scale, moving.predict(P, SECOND, 0).scale)
    assert moving.predict(P, SECOND, 0).drift.all(where=[True, False, True, True, True])


def test_noise_grows_while_missed_up_to_a_second():
    """The seconds for which it was missed add to the noise of the position, up to one in all. The noise
    of sizes stays.
    """
    scales = np.array([motion().predict(P, 0.1, 0.1 * missed).scale for missed in range(40)])
    assert (np.diff(scales[:10, :3], axis=0) > 0).all()
    np.testing.assert_allclose(
        scales[9:, :3] - (MIN_POSITION_NOISE + 0.5 * np.array(AXIS_NOISE)), 0, atol=1e-12
    )
    assert np.ptp(scales[:, 3:], axis=0).max() == 0


def test_noise_of_a_long_frame_is_not_cut():
    """A single frame of two seconds has the noise of two seconds, though hidden targets stop at one."""
    np.testing.assert_allclose(
        motion().predict(P, 2.0, 5.0).scale[:3],
        MIN_POSITION_NOISE + 0.5 * 2 * np.array(AXIS_NOISE),
        rtol=1e-12,
    )


def test_predictions_stay_in_range():
    """Depths stay between near and far, sizes above the smallest; sideways there is no bound."""
    prediction = motion().predict(P, SECOND, 0)
    np.testing.assert_array_equal(prediction.lower, [-np.inf, -np.inf, P.near, MIN_SIZE, MIN_SIZE])
    np.testing.assert_array_equal(prediction.upper, [np.inf, np.inf, P.far, np.inf, np.inf])


def test_velocity_is_learned_from_visible_positions_only():
    """A step of 0.1 m in 0.1 s is 1 m/s, of which the smoothing takes half. Positions that aren't
    visible change nothing.
    """
    there = STATE + [0.1, 0, 0, 0, 0]
    seen = motion().update(there, P, 0.1, visible=True)
    np.testing.assert_allclose(seen.velocity, [0.5, 0, 0], rtol=1e-9)
    np.testing.assert_array_equal(seen.state, there)
    hidden = motion(velocity=np.array([0.3, 0, 0])).update(there, P, 0.1, visible=False)
    np.testing.assert_array_equal(hidden.velocity, [0.3, 0, 0])
    np.testing.assert_array_equal(hidden.state, there)


@pytest.mark.parametrize("rate", [15, 30, 60])
def test_velocity_does_not_depend_on_the_frame_rate(rate):
    """Somebody who walks at 1.3 m/s, whichever way, is learned to do so, at 15, 30 and 60 frames/s."""
    velocity = np.array([1.2, -0.3, 0.4])
    now = motion()
    for i in range(1, 4 * rate):
        there = STATE + np.pad(velocity * i / rate, (0, 2))
        now = now.update(there, P, 1 / rate, visible=True)
    np.testing.assert_allclose(now.velocity, velocity, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("way", [(1, 0, 0), (0, -1, 0), (0, 0, 1), (0.48, 0.6, -0.64)], ids=str)
def test_velocity_is_limited_to_max_speed(way):
    """A jump of 3 m in a frame counts as the maximum speed in its direction."""
    jumped = motion().update(STATE + np.pad(3.0 * np.array(way), (0, 2)), P, 0.1, visible=True)
    np.testing.assert_allclose(jumped.velocity, P.velocity_rate * P.max_speed * np.array(way), rtol=1e-9)


def test_coasting_keeps_a_share_of_the_velocity():
    """A coasting target is where it was predicted, with a share of its velocity; the mean size stays."""
    before = motion(velocity=np.array([1.0, 0.5, -1.0]))
    after = before.coast(STATE + 1, 0.9)
    np.testing.assert_array_equal(after.state, STATE + 1)
    np.testing.assert_allclose(after.velocity, [0.9, 0.45, -0.9], rtol=1e-12)
    assert after.mean_size is before.mean_size
    assert after.size_known is before.size_known


def test_an_unknown_size_grows_only():
    """A size never visible as a whole grows to its visible part, and never shrinks; a known size stays."""
    unknown = motion(size_known=np.array([False, False]))
    np.testing.assert_array_equal(unknown.grow(np.array([0.9, 1.2])).mean_size, [0.9, 1.7])
    np.testing.assert_array_equal(motion().grow(np.array([0.9, 2.0])).mean_size, STATE[3:])
    half_known = motion(size_known=np.array([True, False]))
    np.testing.assert_array_equal(half_known.grow(np.array([0.9, 2.0])).mean_size, [0.6, 2.0])


def test_a_whole_size_is_blended_in():
    """A whole size moves a known one by size_rate, larger or smaller."""
    after = motion().learn_size(np.array([0.8, 1.5]), WHOLE, P)
    np.testing.assert_allclose(after.mean_size, [0.6 + 0.15 * 0.2, 1.7 - 0.15 * 0.2], rtol=1e-12)


def test_a_cut_size_is_not_learned():
    """A cut size neither changes the mean size nor makes it known: ``grow`` takes it as a lower bound."""
    after = motion(size_known=CUT).learn_size(np.array([0.4, 1.9]), CUT, P)
    np.testing.assert_array_equal(after.mean_size, STATE[3:])
    assert not after.size_known.any()


@pytest.mark.parametrize("axis", [0, 1], ids=["width", "height"])
def test_of_known_sizes_only_the_whole_one_is_learned(axis):
    """Where one size is cut, and both are known, the other alone is blended in."""
    whole = np.arange(2) == axis
    after = motion().learn_size(np.array([0.4, 1.5]), whole, P)
    assert (after.mean_size < STATE[3:]).tolist() == whole.tolist()
    assert after.mean_size[1 - axis] == STATE[4 - axis]


def test_the_first_whole_size_is_learned_fast():
    """Sizes visible as a whole for the first time are known from then on, and learned mostly at once."""
    first = motion(size_known=CUT).learn_size(np.array([0.8, 1.7]), WHOLE, P)
    assert first.size_known.all()
    assert first.mean_size[0] > 0.6 + 0.5 * 0.2
    assert first.learn_size(np.array([0.6, 1.7]), CUT, P).size_known.all()


def test_the_width_of_a_part_is_not_yet_known():
    """Of a head at the image's lower edge the width is followed, but not known: shoulders are wider."""
    head = motion(size_known=CUT).learn_size(np.array([0.8, 1.7]), np.array([True, False]), P)
    assert 0.6 < head.mean_size[0] < 0.8
    assert not head.size_known.any()


def test_the_height_of_a_part_is_not_yet_known():
    """Of an arm beside an occluder, visible from top to bottom, the height isn't that of the body."""
    arm = motion(size_known=CUT).learn_size(np.array([0.2, 1.8]), np.array([False, True]), P)
    assert 1.7 < arm.mean_size[1] < 1.8
    assert arm.mean_size[0] == STATE[3]
    assert not arm.size_known.any()


@pytest.mark.parametrize("axis", [0, 1], ids=["width", "height"])
def test_of_two_sizes_the_one_that_is_new_is_learned_fast(axis):
    """Where one size is known, the first whole one of the other is known, too, and taken mostly at once; the
    known one stays where it is cut, and is blended in as ever where it is whole.
    """
    half_known = motion(size_known=np.arange(2) != axis)
    size = np.array([0.8, 1.9])
    for whole in (np.arange(2) == axis, WHOLE):
        after = half_known.learn_size(size, whole, P)
        assert after.size_known.all()
        share = (after.mean_size - STATE[3:]) / (size - STATE[3:])
        assert 0.5 < share[axis] < 1
        assert share[1 - axis] == pytest.approx(P.size_rate if whole.all() else 0)
