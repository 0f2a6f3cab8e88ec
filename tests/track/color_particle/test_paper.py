# SPDX-License-Identifier: MIT
"""The color particle tracker as the paper prints it."""

import copy
from dataclasses import replace

import cv2
import numpy as np
import pytest
from tricue import Box, ColorParticleTracker, Status, kernels
from tricue.track.color_particle.appearance import Appearance
from tricue.track.color_particle.motion import EllipseMotion, size_correlation
from tricue.track.color_particle.skin_detection import detect_skin

Params = ColorParticleTracker.Params
PAPER = Params.paper()
ELLIPSE = (60.0, 50.0, 10.0, 12.0)
SHAPE = (200, 300, 3)
SKIN = np.array([90, 120, 200], np.uint8)


@pytest.fixture(scope="module")
def small(scene):
    """The scene's first frames, 160x120, and the first box."""
    frames = [
        cv2.resize(frame.color, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
        for frame in scene.frames[:6]
    ]
    return frames, Box(*(side / 2 for side in scene.boxes[0]))


def test_noise_grows_with_the_last_step_and_the_mean_stays():
    """(30) with A = I: no drift and no way back to a mean size; K is larger by the step, along each axis."""
    still = EllipseMotion.start(ELLIPSE)
    moved = still.update((70.0, 46.0, 11.0, 12.5), PAPER)
    assert moved.velocity == (10.0, -4.0)  # not smoothed
    at_rest = still._replace(ellipse=moved.ellipse).predict(PAPER, SHAPE)
    in_motion = moved.predict(PAPER, SHAPE)
    np.testing.assert_array_equal(in_motion.drift, np.zeros(4))
    np.testing.assert_allclose(np.subtract(in_motion.scale, at_rest.scale), [10, 4, 0, 0])
    assert moved.predict(Params(), SHAPE).drift[0] == 10.0  # the default follows the velocity


def test_both_axes_walk_by_themselves():
    """The noise of the semi-axes isn't correlated, and 2 % of each."""
    assert size_correlation(PAPER) == 0
    np.testing.assert_allclose(EllipseMotion.start(ELLIPSE).predict(PAPER, SHAPE).scale[2:], [0.2, 0.24])


def test_particles_stay_within_40_pixels():
    """Also those of a target that is larger than that."""
    large = EllipseMotion.start((150.0, 100.0, 60.0, 80.0)).predict(PAPER, SHAPE)
    np.testing.assert_array_equal(large.lower[:2], [110, 60])
    np.testing.assert_array_equal(large.upper[:2], [190, 140])


def test_skin_of_the_whole_image_gives_the_gaussian():
    """(11), (12): skin at the far end of the image moves the mean, which is out of reach by default."""
    image = np.zeros(SHAPE, np.uint8)
    image[40:60, 50:70] = SKIN
    image[140:160, 250:270] = SKIN
    prediction = EllipseMotion.start(ELLIPSE).predict(PAPER, SHAPE)
    everywhere, near = (
        detect_skin(kernels.load("native"), image, SKIN, ELLIPSE, prediction, p)
        for p in (PAPER, replace(PAPER, skin_region="reach"))
    )
    np.testing.assert_allclose(everywhere.mean, [160, 100])
    np.testing.assert_allclose(near.mean, [60, 50])
    assert everywhere.share == 0.5


def test_only_pixels_in_the_ellipse_are_sampled():
    """The window's grid covers the ellipse, pi/4 of its box, and nothing outside of it."""
    radii = np.hypot(*Appearance.create(PAPER).pattern.inside.T)
    assert radii.max() <= 1
    assert len(radii) == pytest.approx(np.pi / 4 * 64 * 48, rel=0.01)
    assert len(Appearance.create(Params()).pattern.inside) == 12 * 8  # the default takes the box


def test_the_model_is_that_of_the_previous_frame(small):
    """After an update with a high score the model is that of the estimated window alone."""
    frames, box = small
    tracker = ColorParticleTracker(params=replace(PAPER, min_score_to_learn=0.0, min_score=0.0), seed=1)
    tracker.init(frames[0], box)
    tracker.update(frames[1])
    k, state = kernels.load("native"), tracker._state
    np.testing.assert_array_equal(
        state.appearance.model.sections, k.rank_sections(state.particles.seen.inside, 16)[0]
    )


def test_no_stage_of_ours_runs(small, monkeypatch):
    """Through frames of noise there is neither a wide search nor a re-detection, and it is never LOST."""

    def refuse(*_):
        raise AssertionError("not in the paper")

    for stage in ("_search_wide", "_redetect"):
        monkeypatch.setattr(ColorParticleTracker, stage, refuse)
    frames, box = small
    noise = [np.full_like(frames[0], 7), *np.random.default_rng(0).integers(0, 256, (30, *frames[0].shape))]
    tracker = ColorParticleTracker(params=PAPER)
    tracker.init(frames[0], box)
    tracks = [tracker.update(image.astype(np.uint8)) for image in noise]
    assert Status.LOST not in {track.status for track in tracks}
    assert Status.OCCLUDED in {track.status for track in tracks}


def test_one_step_agrees_on_both_sets_of_kernels(small):
    """From one state an update is the same but for the rounding of weights (see test_kernels)."""
    frames, box = small
    tracker = ColorParticleTracker(params=PAPER, seed=1)
    tracker.init(frames[0], box)
    twin = ColorParticleTracker(kernels="reference")
    twin.__setstate__({**copy.deepcopy(tracker.__getstate__()), "kernels": "reference"})
    np.testing.assert_allclose(twin.update(frames[1]).box, tracker.update(frames[1]).box, atol=1e-9)


def test_boundary_cannot_exceed_the_references_largest_channel():
    """(10): eta - delta is at most the largest channel of the reference color, whatever the pixel."""
    rng = np.random.default_rng(3)
    image = rng.integers(0, 256, (60, 80, 3), np.uint8)
    for reference in rng.integers(0, 256, (20, 3), np.uint8):
        image[0, 0] = reference
        assert kernels.load("native").skin_boundary(image, reference).max() == reference.max()
