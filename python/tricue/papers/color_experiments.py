# SPDX-License-Identifier: MIT
"""Figures 1 and 2 of Sabeti, Parvizi and Wu (2008): observation models in color, under changes of light."""

from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers import color_figures, curves
from tricue.papers.curves import Curve
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.scenes import BACKGROUNDS, Scene, face_over_clutter, light_change


def measure(case: Case, make: Maker, scene: Scene) -> Curve:
    """Center errors and overlaps of a tracker that starts on the first true box."""
    truth = np.array(scene.boxes)
    boxes = run(make(seed=case.seed), scene.frames, scene.boxes[0]).boxes
    return Curve(*case, metrics.center_errors(boxes, truth), metrics.overlaps(boxes, truth), boxes)


def _particles(observation: str, **parameters: Any) -> Maker:
    return partial(tricue.create, "color-particle", observation=observation, particles=100, **parameters)


def _alone(observation: str, likelihood: str = "exponential") -> Maker:
    """An observation model without the color contrast that the tracker adds to each by default."""
    return _particles(observation, likelihood=likelihood, color_weight=0.0)


DEFAULT = {"spatial ranks, color (default)": _particles("rank-spatial")}

_experiment = partial(
    Experiment[Scene, Curve], measure=measure, summarize=curves.summarize, write_csv=curves.write_csv
)

EXPERIMENTS: dict[str, Experiment[Scene, Curve]] = {
    "sabeti-fig1": _experiment(
        models={
            **DEFAULT,
            "spatial ranks": _alone("rank-spatial"),
            "rank sections": _alone("rank-sections"),
            "rank sections, linear (18)": _alone("rank-sections", "linear"),
            "16-bin histogram": _alone("histogram"),
            "look-up table": _alone("lookup"),
            "Gaussian": _alone("gaussian"),
            "region": _alone("region"),
        },
        scenes={name: partial(face_over_clutter, background=name) for name in BACKGROUNDS},
        draw=color_figures.error_curves,
    ),
    "sabeti-fig2": _experiment(
        models={
            **DEFAULT,
            "spatial ranks": _alone("rank-spatial"),
            "16-bin histogram": _alone("histogram"),
            "rank sections, linear (18)": _alone("rank-sections", "linear"),
        },
        scenes={"light change": light_change},
        draw=color_figures.overlap_curves,
    ),
}
