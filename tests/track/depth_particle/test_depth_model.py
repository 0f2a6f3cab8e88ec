# SPDX-License-Identifier: MIT
"""What the depth model learns of a target, and how likely it finds a rectangle."""

import numpy as np
import pytest
from tricue import Box, DepthParticleTracker, Frame, Intrinsics
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.projection import back_project_box
from tricue.track.depth_particle.depth_model import DepthLikelihood, DepthModel
from tricue.track.depth_particle.measurement import NOT_MEASURED
from tricue.track.depth_particle.tracker import NO_OBJECT, NO_SIZE_PRIOR

Params = DepthParticleTracker.Params
CAMERA = Intrinsics.from_fov(176, 144, 47.5, 39.5).vector
TARGET, Z = Box(60, 40, 30, 80), 3.0
STATE = back_project_box(TARGET, Z, CAMERA)
FORMS = [{}, {"likelihood": "linear"}, {"histogram": "absolute"}, {"contrast": 0.0}]


def foreground(farther: float = 0.0) -> Foreground:
    """A target of some depth of its own before a wall, both so much farther, meters, than Z and 5 m."""
    depth = np.full((144, 176), 5.0, np.float32)
    depth[40:120, 60:90] = Z + np.linspace(-0.2, 0.2, 30, dtype=np.float32)
    return Foreground(depth + np.float32(farther), CAMERA, 1, (0, 0, 176, 144))


def learned(kernels, **choices) -> DepthModel:
    """A model that has learned the target."""
    model = DepthModel.empty(Params(**choices))
    return model.learn(model.histogram_in(kernels, foreground(), STATE), 1.0)


def moved(*by: float):
    """The target's state, changed by the numbers given."""
    return STATE + np.pad(by, (0, 5 - len(by)))


@pytest.mark.parametrize("form", FORMS, ids=str)
def test_the_filter_weighs_by_the_same_likelihood(form, kernels):
    """Weights of the particles are as the model's own likelihoods of their rectangles."""
    model, count = learned(kernels, **form), 20
    states = np.random.default_rng(0).normal(STATE, 0.1, (count, 5))
    still, unbounded = np.zeros(5), (np.full(5, -np.inf), np.full(5, np.inf))
    particles, weights, *_ = kernels.filter_rectangles(
        foreground().depth,
        CAMERA,
        (states, np.full(count, 1 / count), 0.5),
        np.zeros((1, count, 5)),
        (still, np.full(5, 1e-6)),
        unbounded,
        NO_OBJECT,
        (np.ones(5), 0.1),
        DepthLikelihood.create(model.p)._replace(model=model.histogram),
        ((STATE[3:], NO_SIZE_PRIOR), NOT_MEASURED),
    )
    ours = [model.observe(kernels, foreground(), each).log_likelihood for each in particles]
    likelihood = np.exp(np.array(ours) - max(ours))
    assert np.ptp(ours) > 0.1
    np.testing.assert_allclose(weights, likelihood / likelihood.sum(), rtol=1e-6)


@pytest.mark.parametrize("form", FORMS, ids=str)
def test_the_target_is_likelier_than_what_is_beside_it(form, kernels):
    """The farther a rectangle is moved off the target, the less likely it is, and the less of it is at the
    target's depth.
    """
    model = learned(kernels, **form)
    found = [model.observe(kernels, foreground(), moved(by)) for by in (0.0, 0.2, 0.4)]
    for values in zip(*((each.log_likelihood, each.inside, each.contrast) for each in found), strict=True):
        assert (np.diff(values) < 0).all()
    assert found[0].inside == 1
    assert found[0].contrast > 0.9
    assert model.observe(kernels, foreground(), moved(0.8)).inside == 0


def test_what_is_wholly_unlike_is_very_unlikely(kernels):
    """Of two rectangles whose depths have nothing in common the linear likelihood is tiny, and no error."""
    model = DepthModel.empty(Params(likelihood="linear", histogram="absolute", contrast=0.0))
    flat = [Foreground(np.full((144, 176), z, np.float32), CAMERA, 1, (0, 0, 176, 144)) for z in (3, 5)]
    model = model.learn(model.histogram_in(kernels, flat[0], STATE), 1.0)
    assert model.observe(kernels, flat[0], STATE).log_likelihood == pytest.approx(0)
    assert -50 < model.observe(kernels, flat[1], STATE).log_likelihood < -20


def test_a_relative_histogram_moves_with_the_target(kernels):
    """Of a target that is as much farther as its rectangle the depths are the same relative to it, and are
    others in the camera's range.
    """
    there = {}
    for histogram in ("relative", "absolute"):
        model = learned(kernels, histogram=histogram)
        farther = back_project_box(TARGET, Z + 0.5, CAMERA)
        assert model.distance(kernels, foreground(), STATE[None])[0] < 1e-6
        there[histogram] = model.distance(kernels, foreground(farther=0.5), farther[None])[0]
    assert there["relative"] < 0.1
    assert there["absolute"] > 0.3


@pytest.mark.parametrize(("z", "level"), [(0.31, 0), (7.99, -1), (4.14, 127)])
def test_an_absolute_histogram_is_over_the_cameras_range(z, level, kernels):
    """The first level is from near on, the last up to far, whatever the rectangle's own depth."""
    model = DepthModel.empty(Params(histogram="absolute", near=0.3, far=8.0, levels=256))
    fg = Foreground(np.full((144, 176), z, np.float32), CAMERA, 1, (0, 0, 176, 144))
    histogram = model.histogram_in(kernels, fg, STATE)
    assert np.flatnonzero(histogram).tolist() == [level % 256]


def test_what_covers_the_target_is_told(kernels):
    """The share of the rectangle that something in front covers is told, and is no part of the target."""
    fg = foreground()
    fg.depth[40:120, 60:75] = Z - 1.0
    found = learned(kernels).observe(kernels, fg, STATE)
    assert found.front == pytest.approx(0.5, abs=0.01)
    assert found.inside == pytest.approx(0.5, abs=0.01)


def test_the_first_histogram_is_taken_as_it_is(kernels):
    """A model takes the first histogram at any rate, later ones by their rate, and of an empty rectangle,
    such as one without a measurement, nothing.
    """
    empty = DepthModel.empty(Params())
    first, second = np.eye(64)[3], np.eye(64)[9]
    model = empty.learn(first, 0.1)
    np.testing.assert_array_equal(model.histogram, first)
    np.testing.assert_allclose(model.learn(second, 0.1).histogram, 0.9 * first + 0.1 * second)
    np.testing.assert_array_equal(model.learn(np.zeros(64), 0.1).histogram, first)


def test_a_tracker_knows_its_targets_depths_from_the_first_frame():
    """After ``init`` the target itself is like the model, and not only after the next frame."""
    tracker = DepthParticleTracker(floor=False)
    depth = foreground().depth
    tracker.init(Frame(depth=depth), TARGET)
    state = tracker._state
    fg = Foreground(depth, state.camera, 1, (0, 0, 176, 144))
    assert state.model.histogram.sum() == pytest.approx(1)
    assert state.model.distance(tracker._k, fg, state.motion.state[None])[0] < 1e-6
