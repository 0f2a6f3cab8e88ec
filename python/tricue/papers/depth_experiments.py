# SPDX-License-Identifier: MIT
"""Figures 5 to 7 of Sabeti, Parvizi and Wu (2008): a person in depth changes pose and scale, and is hidden.

The tracker's default beside the paper's printed form and beside itself without one part at a time.
"""

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.papers import depth_curves, depth_figures
from tricue.papers.depth_curves import DepthCurve
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.scenes import DepthScene, crossing, walker
from tricue.track.base.track import Status

CLOSE = 0.5  # metres from somebody else, and nearer to them than to the target: on the wrong person


def measure(case: Case, make: Maker, scene: DepthScene) -> DepthCurve:
    """Errors of a tracker that starts on the first true box, and whether it also starts without it."""
    result = run(make(seed=case.seed, intrinsics=scene.intrinsics), scene.frames, scene.boxes[0])
    errors = np.linalg.norm(result.positions - scene.positions, axis=1)
    tracked = np.array([status is Status.TRACKED for status in result.statuses])
    return DepthCurve(
        *case,
        errors=errors,
        overlaps=metrics.overlaps(result.boxes, np.array(scene.boxes)),
        visible=scene.visible,
        statuses=result.statuses,
        astray=tracked & _on_others(result.positions, errors, scene),
        starts=None if scene.others[0] else _starts(make, case.seed, scene),
    )


def _on_others(
    positions: NDArray[np.float64], errors: NDArray[np.float64], scene: DepthScene
) -> NDArray[np.bool_]:
    """(M,) where somebody else is nearer than the target, and near."""
    off = [
        min((float(np.linalg.norm(at - other.position)) for other in others), default=np.inf)
        for at, others in zip(positions, scene.others, strict=True)
    ]
    nearest: NDArray[np.float64] = np.array(off)
    return (nearest < CLOSE) & (nearest < errors)


def _starts(make: Maker, seed: int, scene: DepthScene) -> bool | None:
    """Whether the tracker finds the person in the first frame; None where it doesn't look for people."""
    tracker: Any = make(seed=seed, intrinsics=scene.intrinsics)
    if not hasattr(tracker, "objects"):
        return None
    frame: Frame = scene.frames[0]
    try:
        box: Box = tracker.init(frame).box
    except ValueError:  # nobody found
        return False
    return box.iou(scene.boxes[0]) > depth_curves.HELD


def _depth(**parameters: Any) -> Maker:
    return partial(tricue.create, "depth-particle", **parameters)


EXPERIMENTS: dict[str, Experiment[DepthScene, DepthCurve]] = {
    "sabeti-depth": Experiment(
        models={
            "default": _depth(),
            "absolute histogram": _depth(histogram="absolute"),
            "no contrast": _depth(contrast=0.0),
            "object as proposal only": _depth(measurement=0.0),
            "as printed": _depth(
                histogram="absolute",
                likelihood="linear",
                contrast=0.0,
                measurement=0.0,
                floor=False,
                edges=False,
                gap_passes=0,
            ),
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
        summarize=depth_curves.summarize,
        write_csv=depth_curves.write_csv,
        draw=depth_figures.metric_curves,
    )
}
