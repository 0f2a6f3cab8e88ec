# SPDX-License-Identifier: MIT
"""The color experiments: which trackers run on which scenes, and how a run is measured."""

from dataclasses import asdict
from itertools import combinations

import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.papers.experiment import Case
from tricue.papers.sabeti_color.experiments import EXPERIMENTS, measure
from tricue.scenes import BACKGROUNDS, Scene, face_over_clutter, hand, hidden_face, jump, light_change
from tricue.track.color_particle.params import ColorParticleParams

CASE = Case("m", "s", 0)
MODELS = [(name, model, make) for name, each in EXPERIMENTS.items() for model, make in each.models.items()]


def made(make):
    """The parameters of a model's tracker."""
    return make(seed=0).params


class Beside:
    """Reports boxes, whatever it sees."""

    def __init__(self, boxes):
        self._boxes = iter(boxes)

    def init(self, frame, box=None):
        return self.update(frame)

    def update(self, frame):
        return Track(next(self._boxes), 1.0, Status.TRACKED)


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_as_printed_is_paper_alone(name):
    """In each experiment the default has no parameter of its own, and "as printed" is paper()."""
    models = EXPERIMENTS[name].models
    assert made(models["spatial ranks, color (default)"]) == ColorParticleParams()
    assert made(models["as printed"]) == ColorParticleParams.paper()


@pytest.mark.parametrize(("name", "model", "make"), MODELS)
def test_others_differ_in_the_observation_model_alone(name, model, make):
    """All have the default's filter or the printed one; what differs is the observation and its contrast."""
    base = ColorParticleParams.paper() if "print" in model else ColorParticleParams()
    different = {key for key, value in asdict(made(make)).items() if value != asdict(base)[key]}
    assert different <= {"observation", "color_weight"}


def test_figure_1_compares_all_observation_models():
    """It has all six models, the paper's four also in the printed filter, on every background."""
    experiment = EXPERIMENTS["sabeti-fig1"]
    models = [made(make) for make in experiment.models.values()]
    observations = {"region", "gaussian", "lookup", "histogram", "rank-sections", "rank-spatial"}
    assert {each.observation for each in models} == observations
    printed = {each.observation for each in models if each.likelihood == "linear"}
    assert printed == observations - {"rank-spatial"}
    assert {each.particles for each in models} == {100}
    assert all(a != b for a, b in combinations(models, 2))
    assert set(experiment.scenes) == set(BACKGROUNDS)


def test_scenes_are_those_of_the_figures():
    """Clutter, light, a hidden face and a hand, a jump."""
    makes = [
        {getattr(make, "func", make) for make in experiment.scenes.values()}
        for experiment in EXPERIMENTS.values()
    ]
    assert makes == [{face_over_clutter}, {light_change}, {hidden_face, hand}, {jump}]


def test_steps_and_visible_shares_are_the_scenes():
    """A curve has the true steps, the shares of the scene, and ones where nothing hides the target."""
    boxes = (Box(0, 0, 10, 10), Box(3, 4, 10, 10), Box(3, 4, 10, 10))
    frames = 3 * (Frame(np.zeros((40, 40, 3), np.uint8)),)
    curve = measure(CASE, lambda seed: Beside(3 * boxes[:1]), Scene("s", frames, boxes, (), (1.0, 0.5, 0.1)))
    np.testing.assert_allclose(curve.steps, [0, 5, 0])
    np.testing.assert_allclose(curve.errors, [0, 5, 5])
    np.testing.assert_array_equal(curve.visible, [1.0, 0.5, 0.1])
    shown = measure(CASE, lambda seed: Beside(boxes), Scene("s", frames, boxes))
    np.testing.assert_array_equal(shown.visible, np.ones(3))
    np.testing.assert_array_equal(shown.overlaps, np.ones(3))
