# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.scenes.sensor.stereo_faults import StereoFaults


@pytest.mark.parametrize("rows", [-1.0, -0.5, 0.75])
def test_a_ramp_is_moved_by_rows_and_gained(rows):
    """On a vertical ramp a shift by rows is a difference of levels, exactly, away from the borders."""
    ramp = np.repeat(np.arange(60, dtype=np.float32), 80).reshape(60, 80)[..., None].repeat(3, axis=2)
    found = StereoFaults(1.25, rows).apply(ramp)
    inner = slice(2, -2)
    assert found[inner] == pytest.approx(1.25 * (ramp - rows)[inner], abs=1e-2)


def test_sampled_faults_span_their_ranges():
    """Half a row to one, up and down, and gains on both sides of 1 up to a third."""
    made = [StereoFaults.sample(np.random.default_rng(seed)) for seed in range(80)]
    rows = np.array([each.rows for each in made])
    gains = np.array([each.gain for each in made])
    assert (np.abs(rows) >= 0.5).all()
    assert (np.abs(rows) <= 1).all()
    assert {-1, 1} == set(np.sign(rows))
    assert 0.74 < gains.min() < 0.8
    assert 1.25 < gains.max() < 1.34
