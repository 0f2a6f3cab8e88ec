# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue import StereoRig, create, kernels
from tricue.evaluation.baselines import StillBox
from tricue.papers.kernel_probes import KERNEL_MODULES, ProbedKernels, ProbedTracker
from tricue.scenes import head

RIG = np.array([150.0, 150.0, 79.5, 59.5])
BASELINE = 0.11


def tracked(tracker, scene):
    """A tracker's tracks in each frame of a scene."""
    first = tracker.init(scene.frames[0], scene.boxes[0])
    return [first, *(tracker.update(frame) for frame in scene.frames[1:])]


@pytest.fixture(scope="module")
def scene():
    """A head in 12 frames."""
    return head(2, 12)


def test_probing_changes_nothing(scene):
    """Without noise, a probed tracker's tracks are those of the tracker alone, bit for bit."""
    alone, probed = (create("stereo-head", rig=scene.rig) for _ in range(2))
    assert tracked(alone, scene) == tracked(ProbedTracker(probed), scene)


def test_time_is_that_of_an_update(scene):
    """Each module has spent some time of an update, and the rest is what is left of it."""
    probed = ProbedTracker(create("stereo-head", rig=scene.rig))
    tracked(probed, scene)
    seconds = probed.seconds(np.full(11, 5.0))
    assert set(seconds) == {*KERNEL_MODULES.values(), "rest"}
    assert min(seconds.values()) > 0
    assert sum(seconds.values()) == pytest.approx(5, rel=0.01)


def test_noise_is_in_the_disparity_alone():
    """Back-projected points lie on their own line of sight, at a disparity with the noise's deviation."""
    pixels = np.tile([100.0, 40.0, 6.0], (4000, 1))
    variances = np.full(3, 0.1)
    points, covariances = ProbedKernels(kernels.load("native"), 0.3, 1).back_project(
        pixels, variances, RIG, BASELINE
    )
    sights = (pixels[:, :2] - RIG[2:]) / RIG[:2]
    np.testing.assert_allclose(points[:, :2] / points[:, 2:], sights, rtol=1e-12)
    disparities = RIG[0] * BASELINE / points[:, 2]
    assert disparities.mean() == pytest.approx(6, abs=4 * 0.3 / np.sqrt(4000))
    assert disparities.std() == pytest.approx(0.3, rel=4 / np.sqrt(2 * 4000))
    assert covariances.shape == (4000, 3, 3)


def test_seed_decides_the_noise():
    """The same seed gives the same noise, another one other noise."""
    pixels, variances = np.tile([100.0, 40.0, 6.0], (5, 1)), np.full(3, 0.1)
    first, again, other = (
        ProbedKernels(kernels.load("native"), 0.3, seed).back_project(pixels, variances, RIG, BASELINE)[0]
        for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert np.all(first != other)


def test_tracker_measures_one_disparity_an_update(scene):
    """The stereo head tracker back-projects one point in init and in each update: the
    measured disparity is the one that is perturbed.
    """
    calls = []
    tracker = create("stereo-head", rig=StereoRig(scene.rig.intrinsics, scene.rig.baseline))
    probed = ProbedTracker(tracker, 0.0)
    project = tracker._k.back_project
    tracker._k.back_project = lambda pixels, *others: calls.append(pixels.shape) or project(pixels, *others)
    tracked(probed, scene)
    assert calls == [(1, 3)] * 12


def test_baselines_run_as_they_are(scene):
    """A tracker without kernels is run, and has no times."""
    probed = ProbedTracker(StillBox(), 0.3)
    assert {track.box for track in tracked(probed, scene)} == {scene.boxes[0]}
    assert probed.seconds(np.arange(11.0)) == {"rest": 5}
