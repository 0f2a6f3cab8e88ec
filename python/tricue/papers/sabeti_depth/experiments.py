# SPDX-License-Identifier: MIT
"""Figures 5 to 7 of Sabeti, Parvizi and Wu (2008): a person changes pose and scale, and is hidden.

The tracker with its defaults, without one part at a time, and in the paper's form.
"""

from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.arrays import Flags, Floats
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.errors import TargetNotFoundError
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers.curves import MIN_OVERLAP
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.sabeti_depth import curves, figures
from tricue.papers.sabeti_depth.curves import DepthCurve
from tricue.scenes import DepthScene, crossing, walker
from tricue.track.base.adapter import traits_of
from tricue.track.base.track import Status

MAX_OTHER_DISTANCE = 0.5
"""Meters; a position within this of another person, and nearer to them than to the target, is on them."""


def measure(case: Case, make: Maker, scene: DepthScene) -> DepthCurve:
    """Errors of a tracker that starts on the first true box, and whether it also starts without it."""
    result = run(make(seed=case.seed, intrinsics=scene.intrinsics), scene.frames, scene.boxes[0])
    errors = np.linalg.norm(result.positions - scene.positions, axis=1)
    tracked = np.array([status is Status.TRACKED for status in result.statuses])
    return DepthCurve(
        *case,
        overlaps=metrics.overlaps(result.boxes, np.array(scene.boxes)),
        visible=scene.visible,
        statuses=result.statuses,
        errors=errors,
        on_other=tracked & _nearer_to_others(result.positions, errors, scene),
        boxes=result.boxes,
        starts=None if scene.others[0] else _starts(make, case.seed, scene),
    )


def _nearer_to_others(positions: Floats, errors: Floats, scene: DepthScene) -> Flags:
    """Frames (M,) with a position close to another person, and closer than to the target."""
    distances = [
        min((float(np.linalg.norm(position - other.position)) for other in others), default=np.inf)
        for position, others in zip(positions, scene.others, strict=True)
    ]
    nearest: Floats = np.array(distances)
    return (nearest < MAX_OTHER_DISTANCE) & (nearest < errors)


def _starts(make: Maker, seed: int, scene: DepthScene) -> bool | None:
    """Whether the tracker finds the person in the first frame; None if it doesn't detect people."""
    tracker: Any = make(seed=seed, intrinsics=scene.intrinsics)
    if traits_of(tracker).detects is None:
        return None
    frame: Frame = scene.frames[0]
    try:
        box: Box = tracker.init(frame).box
    except TargetNotFoundError:
        return False
    return box.iou(scene.boxes[0]) > MIN_OVERLAP


def _depth(**parameters: Any) -> Maker:
    return partial(tricue.create, "depth-particle", **parameters)


EXPERIMENTS: dict[str, Experiment[DepthScene, DepthCurve]] = {
    "sabeti-depth": Experiment(
        models={
            "default": _depth(),
            "absolute histogram": _depth(histogram="absolute"),
            "no contrast": _depth(contrast=0.0),
            "object as proposal only": _depth(measurement=0.0),
            "as printed": _depth(params=tricue.DepthParticleTracker.Params.paper()),
        },
        scenes={
            "pose and scale": walker,
            "pose, 30 % missing": partial(walker, missing=0.3),
            "pose, noise x 3": partial(walker, noise=3.0),
            "hidden": crossing,
            "hidden, 0.5 m farther": partial(crossing, depth_change=0.5),
            "hidden, 30 % missing": partial(crossing, missing=0.3),
            "hidden, noise x 3": partial(crossing, noise=3.0),
        },
        measure=measure,
        summarize=curves.summarize,
        write_csv=curves.write_csv,
        draw=figures.frames_and_curves,
    )
}
