# SPDX-License-Identifier: MIT
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tricue.scenes import motion

seeds = st.integers(0, 2**32 - 1)


@given(seeds, st.floats(1, 40), st.floats(10, 200), st.floats(10, 200))
def test_steps_never_exceed_the_speed_nor_positions_the_reach(seed, max_speed, reach_x, reach_y):
    """No step of the path is longer than the speed allowed, and no offset leaves the reach."""
    path = motion.sample_path(90, (reach_x, reach_y), max_speed, np.random.default_rng(seed))
    assert np.hypot(*np.diff(path, axis=0).T).max() <= max_speed * (1 + 1e-9)
    assert np.all(np.abs(path) <= [reach_x, reach_y])


@given(seeds)
def test_path_is_fast_somewhere_and_not_a_line(seed):
    """The path is fast somewhere, slow elsewhere, without jerks, and turns both ways on both axes."""
    path = motion.sample_path(90, (130, 90), 16, np.random.default_rng(seed))
    speed = np.hypot(*np.diff(path, axis=0).T)
    assert speed.max() > 8
    assert speed.min() < 6
    assert np.hypot(*np.diff(path, n=2, axis=0).T).max() < 5
    assert np.all(np.ptp(path, axis=0) > 60)
    assert np.all(np.ptp(np.sign(np.diff(path, axis=0)), axis=0) == 2)


@given(seeds)
def test_gains_step_within_bounds(seed):
    """Gains start at 1, stay in range, hold for 10 frames or more, and step by a quarter of it or more."""
    gains = motion.sample_gain_steps(90, 0.45, 1.3, np.random.default_rng(seed))
    moments = np.flatnonzero(np.diff(gains)) + 1
    assert gains[0] == 1
    assert np.all((gains >= 0.45) & (gains <= 1.3))
    assert 4 <= len(moments) <= 8
    assert np.all(np.diff(moments) >= 10)
    assert np.all(np.abs(np.diff(gains)[moments - 1]) >= (1.3 - 0.45) / 4 - 1e-12)
