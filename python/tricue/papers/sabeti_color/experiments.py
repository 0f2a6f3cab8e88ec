# SPDX-License-Identifier: MIT
"""Figures 1 and 2 of Sabeti, Parvizi and Wu (2008): observation models in color, as the light changes."""

from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.sabeti_color import curves, figures
from tricue.papers.sabeti_color.curves import ColorCurve
from tricue.scenes import BACKGROUNDS, Scene, face_over_clutter, light_change


def measure(case: Case, make: Maker, scene: Scene) -> ColorCurve:
    """Center errors and overlaps of a tracker that starts on the first true box."""
    truth = np.array(scene.boxes)
    boxes = run(make(seed=case.seed), scene.frames, scene.boxes[0]).boxes
    return ColorCurve(
        *case,
        overlaps=metrics.overlaps(boxes, truth),
        errors=metrics.center_errors(boxes, truth),
        boxes=boxes,
    )


def _particles(observation: str, **parameters: Any) -> Maker:
    return partial(tricue.create, "color-particle", observation=observation, particles=100, **parameters)


def _without_contrast(observation: str, likelihood: str = "exponential") -> Maker:
    """One observation model without the color contrast, which the tracker adds by default."""
    return _particles(observation, likelihood=likelihood, color_weight=0.0)


DEFAULT_MODEL = {"spatial ranks, color (default)": _particles("rank-spatial")}

_experiment = partial(
    Experiment[Scene, ColorCurve], measure=measure, summarize=curves.summarize, write_csv=curves.write_csv
)

EXPERIMENTS: dict[str, Experiment[Scene, ColorCurve]] = {
    "sabeti-fig1": _experiment(
        models={
            **DEFAULT_MODEL,
            "spatial ranks": _without_contrast("rank-spatial"),
            "rank sections": _without_contrast("rank-sections"),
            "rank sections, linear (18)": _without_contrast("rank-sections", "linear"),
            "16-bin histogram": _without_contrast("histogram"),
            "look-up table": _without_contrast("lookup"),
            "Gaussian": _without_contrast("gaussian"),
            "region": _without_contrast("region"),
        },
        scenes={name: partial(face_over_clutter, background=name) for name in BACKGROUNDS},
        draw=figures.error_curves,
    ),
    "sabeti-fig2": _experiment(
        models={
            **DEFAULT_MODEL,
            "spatial ranks": _without_contrast("rank-spatial"),
            "16-bin histogram": _without_contrast("histogram"),
            "rank sections, linear (18)": _without_contrast("rank-sections", "linear"),
        },
        scenes={"light change": light_change},
        draw=figures.overlap_curves,
    ),
}
