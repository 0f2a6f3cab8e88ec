# SPDX-License-Identifier: MIT
"""Figures 1 to 4 of Sabeti, Parvizi and Wu (2008): observation models in color.

The light changes, a hand hides the face or is the target itself, and a person jumps.
"""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers.experiment import Case, Experiment, Maker, Models
from tricue.papers.sabeti_color import curves, figures
from tricue.papers.sabeti_color.curves import ColorCurve
from tricue.scenes import BACKGROUNDS, Scene, face_over_clutter, hand, hidden_face, jump, light_change
from tricue.track.color_particle.params import ColorParticleParams

MAX_RENDERED_SEEDS = 10
"""Seeds for the scenes of figures 3 and 4, which are slow to render."""


def measure(case: Case, make: Maker, scene: Scene) -> ColorCurve:
    """Center errors and overlaps of a tracker that starts on the first true box."""
    truth = np.array(scene.boxes)
    boxes = run(make(seed=case.seed), scene.frames, scene.boxes[0]).boxes
    centers = truth[:, :2] + truth[:, 2:] / 2
    return ColorCurve(
        *case,
        overlaps=metrics.overlaps(boxes, truth),
        errors=metrics.center_errors(boxes, truth),
        boxes=boxes,
        visible=np.array(scene.visible) if scene.visible else np.ones(len(truth)),
        steps=np.hypot(*np.diff(centers, axis=0, prepend=centers[:1]).T),
    )


def _particles(observation: str, **parameters: Any) -> Maker:
    return partial(tricue.create, "color-particle", observation=observation, particles=100, **parameters)


def _alone(observation: str) -> Maker:
    """One observation model without the color contrast, which the tracker adds by default."""
    return _particles(observation, color_weight=0.0)


def _printed(**other: Any) -> Maker:
    """The tracker as printed, or with another observation model instead of its own."""
    return partial(tricue.create, "color-particle", params=replace(ColorParticleParams.paper(), **other))


DEFAULT_MODEL = {"spatial ranks, color (default)": _particles("rank-spatial")}
AS_PRINTED = {"as printed": _printed()}
BASELINES = {
    "16-bin histogram": _alone("histogram"),
    "look-up table": _alone("lookup"),
    "Gaussian": _alone("gaussian"),
    "region": _alone("region"),
}
PRINTED_BASELINES = {
    "16-bin histogram, printed filter": _printed(observation="histogram"),
    "look-up table, printed filter": _printed(observation="lookup"),
    "Gaussian, printed filter": _printed(observation="gaussian"),
    "region, printed filter": _printed(observation="region"),
}


def _among(models: Models, *names: str) -> Models:
    return {name: models[name] for name in names}


OTHERS = {**DEFAULT_MODEL, "spatial ranks": _alone("rank-spatial"), **BASELINES, **AS_PRINTED}
RENDERED_MODELS = _among(
    OTHERS, *DEFAULT_MODEL, "spatial ranks", "16-bin histogram", "Gaussian", "region", *AS_PRINTED
)

_experiment = partial(Experiment[Scene, ColorCurve], measure=measure, write_csv=curves.write_csv)

EXPERIMENTS: dict[str, Experiment[Scene, ColorCurve]] = {
    "sabeti-fig1": _experiment(
        models={
            **DEFAULT_MODEL,
            "spatial ranks": _alone("rank-spatial"),
            "rank sections": _alone("rank-sections"),
            **AS_PRINTED,
            **BASELINES,
            **PRINTED_BASELINES,
        },
        scenes={name: partial(face_over_clutter, background=name) for name in BACKGROUNDS},
        summarize=curves.summarize,
        draw=figures.error_curves,
    ),
    "sabeti-fig2": _experiment(
        models={
            **_among(OTHERS, *DEFAULT_MODEL, "spatial ranks", "16-bin histogram", *AS_PRINTED),
            **_among(PRINTED_BASELINES, "16-bin histogram, printed filter"),
        },
        scenes={"light change": light_change},
        summarize=curves.summarize,
        draw=figures.overlap_curves,
    ),
    "sabeti-fig3": _experiment(
        models=RENDERED_MODELS,
        scenes={"face behind a hand": hidden_face, "hand": hand},
        summarize=curves.summarize_scenes,
        draw=figures.scene_curves,
        max_seeds={"face behind a hand": MAX_RENDERED_SEEDS, "hand": MAX_RENDERED_SEEDS},
    ),
    "sabeti-fig4": _experiment(
        models=RENDERED_MODELS,
        scenes={"jumping": jump},
        summarize=curves.summarize_scenes,
        draw=figures.scene_curves,
        max_seeds={"jumping": MAX_RENDERED_SEEDS},
    ),
}
