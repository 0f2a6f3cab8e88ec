# SPDX-License-Identifier: MIT
"""Figure 3 of Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002): a head before a stereo pair, in metres.

The tracker's default beside itself without one part at a time, the paper's own filter, and its printed form.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers import stereo_curves, stereo_figures
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.kernel_probes import Watched
from tricue.papers.stereo_curves import FUSED, PAPERS_FILTER, UNFUSED, StereoCurve
from tricue.scenes import StereoScene, head

DISTURBED = 0.3  # px of disparity, standard deviation


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """A scene, and how much the disparities are disturbed that the tracker measures in it, pixels."""

    scene: StereoScene
    noise: float

    @classmethod
    def make(cls, seed: int, noise: float = 0.0, **scene: Any) -> "Trial":
        """A head's scene; its keywords are those of tricue.scenes.head."""
        return cls(head(seed, **scene), noise)


def measure(case: Case, make: Maker, trial: Trial) -> StereoCurve:
    """Positions, overlaps and times of a tracker that starts on the first true box."""
    scene = trial.scene
    watched = Watched(make(seed=case.seed, rig=scene.rig), trial.noise, case.seed)
    result = run(watched, scene.frames, scene.boxes[0])
    return StereoCurve(
        *case,
        positions=result.positions,
        truth=scene.positions,
        covariances=result.covariances,
        overlaps=metrics.overlaps(result.boxes, np.array(scene.boxes)),
        visible=scene.visible,
        statuses=result.statuses,
        seconds=watched.seconds(result.seconds),
    )


def _stereo(**parameters: Any) -> Maker:
    return partial(tricue.create, "stereo-head", **parameters)


def _scene(kind: str = "normal", camera: str = "160x120", noise: float = 0.0) -> Callable[..., Trial]:
    return partial(Trial.make, kind=kind, camera=camera, noise=noise)


FILTER: dict[str, Any] = {"motion": "constant", "noise_model": "polynomial", "disparity_noise": 1.0}
PRINTED: dict[str, Any] = {
    **FILTER,
    "ring_weight": 0.0,
    "depth_weight": 0.0,
    "compensate_light": False,
    "learn": "all",
    "learning_rate": 0.1,
    "first_frame_weight": 0.0,
    "ellipse_margin": 0.0,
    "disparity_statistic": "mean",
    "feedback": True,
}

COLOR_ALONE: dict[str, Any] = {"compensate_light": False, "depth_weight": 0.0}  # in the search, as it is seen

EXPERIMENTS: dict[str, Experiment[Trial, StereoCurve]] = {
    "moreno-fig3": Experiment(
        models={
            FUSED: _stereo(),
            UNFUSED: _stereo(fuse=False),
            PAPERS_FILTER: _stereo(**FILTER),
            "as printed": _stereo(**PRINTED),
            "without depth in the search": _stereo(depth_weight=0.0),
            "without updating": _stereo(learning_rate=0.0),
            "light not compensated": _stereo(compensate_light=False),
            "light not compensated, without updating": _stereo(compensate_light=False, learning_rate=0.0),
            "color alone": _stereo(**COLOR_ALONE),
            "color alone, without updating": _stereo(**COLOR_ALONE, learning_rate=0.0),
        },
        scenes={
            stereo_figures.NORMAL: _scene(),
            stereo_figures.DISTURBED: _scene(noise=DISTURBED),
            "distractor": _scene("distractor"),
            "turning": _scene("turning"),
            "ramp": _scene("ramp"),
            "jump": _scene("jump"),
            "hidden": _scene("hidden"),
            stereo_figures.LARGE: _scene(camera="640x480"),
        },
        measure=measure,
        summarize=stereo_curves.summarize,
        write_csv=stereo_curves.write_csv,
        draw=stereo_figures.paths,
        at_most={stereo_figures.LARGE: 4},
    )
}
