# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.scenes.sensor.surfaces import SurfaceFaults, smooth_noise

NONE = SurfaceFaults(thin=1, ragged=0.0, smear=0.0, flying=0.0)


@pytest.fixture
def rng():
    """The same for each test."""
    return np.random.default_rng(0)


def scene(width):
    """A post of this width at 1 m, before a wall at 2 m."""
    depth = np.full((60, 80), 2.0)
    depth[:, 40 : 40 + width] = 1.0
    return depth


def test_without_faults_surfaces_stay(rng):
    """A camera without faults measures the geometry."""
    assert np.array_equal(NONE.apply(scene(10), rng), scene(10))


@pytest.mark.parametrize(("width", "lost"), [(2, True), (3, True), (4, False)])
def test_thin_things_are_lost(width, lost, rng):
    """Up to the given width the wall is measured instead; wider things keep their shape."""
    seen = NONE._replace(thin=3).apply(scene(width), rng)
    assert np.array_equal(seen, np.full((60, 80), 2.0) if lost else scene(width))


def test_ragged_edges_keep_their_mean_place(rng):
    """Edges go to and fro by about the told deviation, and no third depth comes up."""
    faults = NONE._replace(ragged=1.5)
    left = [(faults.apply(scene(20), rng) == 2.0)[:, :50].sum(axis=1) for _ in range(40)]
    assert np.mean(left) == pytest.approx(40, abs=0.4)
    assert 0.8 < np.std(left) < 2.2
    assert set(np.unique(faults.apply(scene(20), rng))) == {1.0, 2.0}


def test_flying_pixels_are_between_at_edges_only(rng):
    """The told share of the pixels on both sides of edges lies between both surfaces."""
    seen = NONE._replace(flying=0.3).apply(scene(20), rng)
    between = (seen > 1) & (seen < 2)
    assert set(np.flatnonzero(between.any(axis=0))) <= {39, 40, 59, 60}
    assert between[:, [39, 40, 59, 60]].mean() == pytest.approx(0.3, abs=0.08)


def test_smear_blurs_edges(rng):
    """A step becomes a ramp of the told width."""
    step = np.diff(NONE._replace(smear=1.5).apply(scene(20), rng)[30, 34:46])
    assert step.min() == pytest.approx(
        -1 / (1.5 * np.sqrt(2 * np.pi)), rel=0.05
    )  # of a Gaussian, at its middle


@pytest.mark.parametrize("grain", [0.6, 2.0])
def test_noise_has_its_grain(grain, rng):
    """Deviation 1, and a correlation between neighbors of exp(-1 / (4 grain²)), a Gaussian's with itself."""
    noise = smooth_noise((200, 300), grain, rng)
    assert noise.std() == pytest.approx(1)
    found = (noise[:, 1:] * noise[:, :-1]).mean()
    assert found == pytest.approx(np.exp(-1 / (4 * grain**2)), abs=0.06)
