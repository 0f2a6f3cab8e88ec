# SPDX-License-Identifier: MIT
"""That the tracker is the same on native and on reference kernels."""

import copy

import cv2
import numpy as np
import pytest
from tricue import Box, ColorParticleTracker
from tricue.scenes import Scene

EXACT = ("region", "lookup", "histogram", "rank-sections", "rank-spatial")
EPS32, EPS64 = float(np.finfo(np.float32).eps), float(np.finfo(np.float64).eps)


FRAMES = 20


def halved(image):
    """Half of the rows and columns: the reference kernels take each pixel by itself."""
    return cv2.resize(np.asarray(image), None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)


@pytest.fixture(scope="module")
def frames(scene: Scene):
    """The scene's first frames, 160x120."""
    return [halved(frame.color) for frame in scene.frames[:FRAMES]]


@pytest.fixture(scope="module")
def box(scene: Scene) -> Box:
    """Of the target in the first of them."""
    return Box(*(side / 2 for side in scene.boxes[0]))


def on_reference_kernels(tracker: ColorParticleTracker) -> ColorParticleTracker:
    """A tracker in the same state, which goes on with the reference kernels."""
    twin = ColorParticleTracker(kernels="reference")
    twin.__setstate__({**copy.deepcopy(tracker.__getstate__()), "kernels": "reference"})
    return twin


@pytest.mark.parametrize("likelihood", ["linear", "exponential"])
@pytest.mark.parametrize("observation", [*EXACT, "gaussian"])
def test_one_step_agrees(observation, likelihood, frames, box):
    """From one state, one update gives the same track on both sets of kernels, in each of ten frames.

    Rounding changes a log weight by at most e, so the normalized weights by at most a share of 2 e, and
    the weighted mean by at most 2 e times the particles' extent. The models that count pixels are exact
    to float64: e is a few hundred roundings of it (weights, color term, cumulative sums), 1e-13 with an
    allowance of ten. The Gaussian's float32 densities of the pixels are off by up to 16 EPS32 each (the
    squared Mahalanobis distance, some 10 where the density counts, times its roundings), the distance by
    that, and e by 2 sharpness d, at most 200, times that. Its whole tracks part where a sample crosses
    the border of a pixel, and aren't compared.
    """
    e = 200 * 16 * EPS32 if observation == "gaussian" else 5000 * EPS64
    tracker = ColorParticleTracker(seed=1, observation=observation, likelihood=likelihood)
    tracker.init(frames[0], box)
    for frame in frames[1:11]:
        twin = on_reference_kernels(tracker)
        ours, theirs = tracker.update(frame), twin.update(frame)
        extent = float(np.ptp(tracker.particles, axis=0).max())
        assert np.abs(np.subtract(ours.box, theirs.box)).max() <= 2 * (
            2 * e * extent
        )  # width is twice the semi-axis
        assert ours.score == pytest.approx(theirs.score, abs=16 * EPS32)
        assert ours.status is theirs.status


@pytest.mark.parametrize("likelihood", ["linear", "exponential"])
@pytest.mark.parametrize("observation", EXACT)
def test_whole_tracks_agree(observation, likelihood, frames, box, follow):
    """Over 20 frames the tracks agree within 1e-9 px.

    One step differs by up to 1e-10 px (see above). Later steps carry a difference on, they don't multiply
    it: the particles are drawn with the same noise and pulled to the same place. Only a sample that
    crosses the border of a pixel, or a resampled index that crosses a tooth, would; for 100 particles of
    136 samples over 20 frames and 1e-10 px that is a chance of about 1e-4. The largest difference seen is
    2e-13 px.
    """
    ours, theirs = (
        follow(
            ColorParticleTracker(seed=1, observation=observation, likelihood=likelihood, kernels=kernels),
            frames,
            box,
        )
        for kernels in ("native", "reference")
    )
    off = np.subtract([track.box for track in ours], [track.box for track in theirs])
    assert np.abs(off).max() <= 1e-9
    assert [track.status for track in ours] == [track.status for track in theirs]


def test_lost_and_found_alike(stage, follow):
    """The search for a lost target runs alike on both: the same statuses, and boxes within 1e-9 px."""
    here, there = (stage(6 * [place]) for place in ((100.0, 90.0), (200.0, 30.0)))
    frames = [*map(halved, here), *8 * [np.zeros((120, 160, 3), np.uint8)], *map(halved, there)]
    ours, theirs = (
        follow(ColorParticleTracker(seed=1, kernels=kernels), frames, (50, 45, 25, 31.5))
        for kernels in ("native", "reference")
    )
    assert [track.status for track in ours] == [track.status for track in theirs]
    assert np.abs(np.subtract([t.box for t in ours], [t.box for t in theirs])).max() <= 1e-9
