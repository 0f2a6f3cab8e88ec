# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.rig import Intrinsics
from tricue.scenes.sensor.depth_camera import DepthFaults, FaultyDepthCamera
from tricue.scenes.sensor.holes import HoleShares
from tricue.scenes.sensor.surfaces import SurfaceFaults

CAMERA = Intrinsics.from_fov(160, 120, 60.0)
GRAY, MATT = np.full((120, 160), 120, np.uint8), np.zeros((120, 160), bool)
NONE = DepthFaults(
    near=0.4,
    far=8.0,
    step=1e-7,
    noise=0.0,
    grain=0.6,
    baseline=1e-9,
    surfaces=SurfaceFaults(1, 0.0, 0.0, 0.0),
    holes=HoleShares(0.0, 0.0, 0.0, 0.0, 0.0, 0, 2.0),
    shift=(0.0, 0.0),
    margin=0.0,
    delay=0,
)


def measure(depth, **faults):
    """One frame by a camera without faults but these."""
    camera = FaultyDepthCamera(CAMERA, NONE._replace(**faults), np.random.default_rng(0))
    return camera.measure(depth, GRAY, MATT)


def wall(z):
    """Before the whole image."""
    return np.full((120, 160), float(z))


@pytest.mark.parametrize(
    ("z", "inside"), [(0.39, False), (0.5, True), (7.9, True), (8.1, False), (np.inf, False)]
)
def test_without_faults_it_measures_the_geometry(z, inside):
    """Depth as it is where it is in the range, else none."""
    found = measure(wall(z))
    assert (np.isfinite(found) == inside).all()
    assert not inside or found == pytest.approx(z, rel=1e-5)


@pytest.mark.parametrize("z", [0.8, 2.0, 4.0])
def test_noise_grows_with_the_square_of_depth(z):
    """Its deviation is that at 1 m times z², and its mean 0."""
    found = measure(wall(z), noise=1.2e-3)
    assert found.std() == pytest.approx(1.2e-3 * z**2, rel=0.03)
    assert found.mean() == pytest.approx(z, abs=1e-4 * z**2)


@pytest.mark.parametrize("z", [1.0, 3.0])
def test_levels_are_steps_of_inverse_depth(z):
    """Neighboring levels are step · z² apart, as of the Kinect: 2.85 mm at 1 m, 26 mm at 3 m."""
    found = measure(wall(z), noise=3e-3, step=2.85e-3)
    gaps = np.diff(np.unique(found))
    assert np.median(gaps) == pytest.approx(2.85e-3 * z**2, rel=0.05)


@pytest.mark.parametrize("shift", [(3.0, -2.0), (-1.0, 1.0)])
def test_depth_lies_beside_color(shift):
    """By the told pixels; what comes in from outside isn't measured."""
    depth = wall(2)
    depth[40:60, 50:80] = 1
    found = measure(depth, shift=shift)
    rows, columns = np.nonzero(found < 1.5)
    assert (columns.min() - 50, rows.min() - 40) == shift
    assert np.isnan(found).any()


def test_margins_have_no_depth():
    """A tenth of each side of the image."""
    found = np.isfinite(measure(wall(2), margin=0.1))
    assert found[12:108, 16:144].all()
    assert found.sum() == 96 * 128


def test_sampled_cameras_are_within_what_was_measured():
    """Shift of one to three pixels at a width of 640, quantization and noise of docs/scenes.md; both sides of
    the projector and all three delays are met.
    """
    made = [DepthFaults.sample(640, np.random.default_rng(seed)) for seed in range(60)]
    sizes = np.array([np.hypot(*each.shift) for each in made])
    assert (sizes.min() >= 1, sizes.max() <= 3) == (True, True)
    assert {np.sign(each.baseline) for each in made} == {-1, 1}
    assert {each.delay for each in made} == {-1, 0, 1}
    half = [DepthFaults.sample(320, np.random.default_rng(seed)) for seed in range(60)]
    assert [np.hypot(*each.shift) for each in half] == pytest.approx(sizes / 2)


def test_the_generator_decides_everything():
    """The same generator's state gives the same depth, another one another."""
    faults = DepthFaults.sample(160, np.random.default_rng(1))
    first, again, other = (
        FaultyDepthCamera(CAMERA, faults, np.random.default_rng(seed)).measure(wall(2), GRAY, MATT)
        for seed in (5, 5, 6)
    )
    assert np.array_equal(first, again, equal_nan=True)
    assert not np.array_equal(first, other, equal_nan=True)
