# SPDX-License-Identifier: MIT
"""Section VI of Sabeti, Parvizi and Wu (2008): color against time of flight, in darkness and out of range.

The light falls to nothing, or rises to that of the sun. In a deep hall the unambiguous range shrinks, until
the background, and at last the floor around the person, appear nearer than they are.
"""

from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.sabeti_dark import curves, figures
from tricue.papers.sabeti_dark.curves import LitCurve
from tricue.papers.sabeti_dark.names import (
    COLOR,
    DUSK,
    HEAD_MODELS,
    PRINTED,
    PRINTED_COLOR,
    RANGE_SCENES,
    SUNRISE,
)
from tricue.scenes import LitScene, lit_walker

DEEP_WALL = 10.5  # meters, beyond most of the unambiguous ranges


def measure(case: Case, make: Maker, scene: LitScene) -> LitCurve:
    """Overlaps of a tracker that starts on the first true box: the head's for color, as in the paper."""
    color = case.model in HEAD_MODELS
    truth = scene.heads if color else scene.boxes
    camera: dict[str, Any] = {} if color else {"intrinsics": scene.intrinsics}
    result = run(make(seed=case.seed, **camera), scene.frames, truth[0])
    overlaps = metrics.overlaps(result.boxes, np.array(truth))
    return LitCurve(*case, overlaps=overlaps, light=scene.light, boxes=result.boxes)


EXPERIMENTS: dict[str, Experiment[LitScene, LitCurve]] = {
    "sabeti-dark": Experiment(
        models={
            COLOR: partial(tricue.create, "color-particle"),
            PRINTED_COLOR: partial(
                tricue.create, "color-particle", params=tricue.ColorParticleTracker.Params.paper()
            ),
            "depth-particle": partial(tricue.create, "depth-particle"),
            PRINTED: partial(
                tricue.create, "depth-particle", params=tricue.DepthParticleTracker.Params.paper()
            ),
            "fused": partial(tricue.create, "fused"),
        },
        scenes={
            DUSK: partial(lit_walker, light="dusk"),
            SUNRISE: partial(lit_walker, light="sunrise"),
            **{
                name: partial(
                    lit_walker, wall=DEEP_WALL, unambiguous_range=meters, min_reflectance=reflectance
                )
                for name, (meters, reflectance) in RANGE_SCENES.items()
            },
        },
        measure=measure,
        summarize=curves.summarize,
        write_csv=curves.write_csv,
        draw=figures.light_and_range,
    )
}
