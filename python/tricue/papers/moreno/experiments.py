# SPDX-License-Identifier: MIT
"""Figures 2 and 3 of Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002): a head in stereo, in meters.

Figure 2 is the noise of a head at rest (:mod:`noise`). In figure 3 a head moves. The trackers are the
default, the paper's form with and without its filter, and the default with the paper's filter or without one
part at a time.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.kernel_probes import ProbedTracker
from tricue.papers.moreno import curves, figures, noise
from tricue.papers.moreno.curves import (
    FUSED,
    PAPERS_FILTER,
    PRINTED,
    PRINTED_UNFUSED,
    UNFUSED,
    StereoCurve,
)
from tricue.scenes import StereoScene, head
from tricue.track.stereo_head.params import StereoHeadParams

SCENE_DISPARITY_NOISE = 0.3
"""Standard deviation, pixels, in the perturbed scene."""


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """A scene, and the noise that is added to the disparities measured in it: standard deviation, pixels."""

    scene: StereoScene
    noise: float

    @classmethod
    def make(cls, seed: int, noise: float = 0.0, **scene: Any) -> "Trial":
        """A scene with a head; its keywords are those of tricue.scenes.head."""
        return cls(head(seed, **scene), noise)


def measure(case: Case, make: Maker, trial: Trial) -> StereoCurve:
    """Positions, overlaps and times of a tracker that starts on the first true box."""
    scene = trial.scene
    probed = ProbedTracker(make(seed=case.seed, rig=scene.rig), trial.noise, case.seed)
    result = run(probed, scene.frames, scene.boxes[0])
    return StereoCurve(
        *case,
        overlaps=metrics.overlaps(result.boxes, np.array(scene.boxes)),
        visible=scene.visible,
        statuses=result.statuses,
        boxes=result.boxes,
        positions=result.positions,
        truth=scene.positions,
        covariances=result.covariances,
        seconds=probed.seconds(result.seconds),
    )


def _stereo(**parameters: Any) -> Maker:
    return partial(tricue.create, "stereo-head", **parameters)


def _scene(kind: str = "normal", camera: str = "160x120", noise: float = 0.0) -> Callable[..., Trial]:
    return partial(Trial.make, kind=kind, camera=camera, noise=noise)


PRINTED_PARAMS = StereoHeadParams.paper()
PAPERS_FILTER_PARAMS: dict[str, Any] = {
    name: getattr(PRINTED_PARAMS, name) for name in ("motion", "max_speed", "noise_model", "disparity_noise")
}
COLOR_ONLY_PARAMS: dict[str, Any] = {
    "compensate_light": False,
    "depth_weight": 0.0,
}  # parameters of the search for the head

EXPERIMENTS: dict[str, Experiment[Any, Any]] = {
    "moreno-fig2": Experiment(
        models={FUSED: _stereo(), PRINTED: _stereo(params=PRINTED_PARAMS)},
        scenes=noise.SCENES,
        measure=noise.measure,
        summarize=noise.summarize,
        write_csv=noise.write_csv,
        draw=noise.draw,
    ),
    "moreno-fig3": Experiment(
        models={
            FUSED: _stereo(),
            UNFUSED: _stereo(fuse=False),
            PRINTED: _stereo(params=PRINTED_PARAMS),
            PRINTED_UNFUSED: _stereo(params=replace(PRINTED_PARAMS, fuse=False)),
            PAPERS_FILTER: _stereo(**PAPERS_FILTER_PARAMS),
            "without depth in the search": _stereo(depth_weight=0.0),
            "without updating": _stereo(learning_rate=0.0),
            "light not compensated": _stereo(compensate_light=False),
            "light not compensated, without updating": _stereo(compensate_light=False, learning_rate=0.0),
            "color alone": _stereo(**COLOR_ONLY_PARAMS),
            "color alone, without updating": _stereo(**COLOR_ONLY_PARAMS, learning_rate=0.0),
        },
        scenes={
            figures.NORMAL: _scene(),
            figures.NOISY: _scene(noise=SCENE_DISPARITY_NOISE),
            "distractor": _scene("distractor"),
            "turning": _scene("turning"),
            "ramp": _scene("ramp"),
            "jump": _scene("jump"),
            "hidden": _scene("hidden"),
            figures.LARGE: _scene(camera="640x480"),
        },
        measure=measure,
        summarize=curves.summarize,
        write_csv=curves.write_csv,
        draw=figures.paths,
        max_seeds={figures.LARGE: 4},
    ),
}
