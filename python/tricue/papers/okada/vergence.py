# SPDX-License-Identifier: MIT
"""Section 3.1 of Okada, Shirai and Miura (1996): disparity with a right camera turned inward, (8).

The tracker knows the vergence angle or doesn't, in its default form and as printed. The head pans, as in
figure 8.
"""

import warnings
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.errors import NoDepthInBoxError
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import AnyTracker, run
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.okada import vergence_curves as curves
from tricue.papers.okada import vergence_figures as figures
from tricue.papers.okada.vergence_curves import VergenceCurve
from tricue.scenes import WalkScene, overtaking
from tricue.track.base.track import Status

ANGLES = 0.0, 0.25, 0.5, 1.0, 2.0, 4.0
"""Degrees; at about 1 both optical axes meet at the target."""
FRAMES = 16
"""Frames until the overtaking begins, the subject of figure 8."""


def measure(case: Case, make: Maker, scene: WalkScene) -> VergenceCurve:
    """Errors of a tracker that starts on the first true box; ``make`` also gets ``vergence=``."""
    tracker = make(seed=case.seed, rig=scene.rig, vergence=scene.vergence)
    try:
        with warnings.catch_warnings():
            # Without the vergence, the tracker warns that the images seem swapped or not rectified.
            warnings.simplefilter("ignore", UserWarning)
            result = run(tracker, scene.frames, scene.boxes[0])
    except NoDepthInBoxError:
        none = np.full(len(scene.frames), np.nan)
        overlaps, errors, statuses = np.zeros_like(none), none, (Status.LOST,) * len(scene.frames)
        started = False
    else:
        overlaps = metrics.overlaps(result.boxes, np.array(scene.boxes))
        errors, statuses = result.positions[:, 2] - scene.positions[:, 2], result.statuses
        started = True
    return VergenceCurve(
        *case,
        overlaps=overlaps,
        visible=scene.visible,
        statuses=statuses,
        vergence=scene.vergence,
        depth_errors=errors,
        started=started,
    )


def make_tracker(*, known: bool, printed: bool, vergence: float, **camera: Any) -> AnyTracker:
    """A tracker that knows the vergence, or doesn't."""
    kind = tricue.FlowDepthTracker.Params
    values = kind.paper() if printed else kind()
    told = replace(values, vergence=vergence if known else 0.0)
    return tricue.create("flow-depth", params=told, **camera)


def _scene(angle: float) -> Callable[..., WalkScene]:
    return partial(overtaking, frames=FRAMES, vergence=angle)


EXPERIMENTS: dict[str, Experiment[WalkScene, VergenceCurve]] = {
    "okada-vergence": Experiment(
        models={
            figures.KNOWN: partial(make_tracker, known=True, printed=False),
            figures.IGNORED: partial(make_tracker, known=False, printed=False),
            figures.PRINTED_KNOWN: partial(make_tracker, known=True, printed=True),
            figures.PRINTED_IGNORED: partial(make_tracker, known=False, printed=True),
        },
        scenes={f"{angle:g}°": _scene(angle) for angle in ANGLES},
        measure=measure,
        summarize=curves.summarize,
        write_csv=curves.write_csv,
        draw=figures.pairs_and_errors,
    )
}
