# SPDX-License-Identifier: MIT
"""Figure 8 of Okada, Shirai and Miura (1996): a walker is overtaken, and passes a standing person.

Flow and disparity together, and each alone, by default and as printed. The paper says that flow alone fails
on the overtaking, because both walk alike, and disparity alone on the pass, because both are equally far
away.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

import tricue
from tricue.arrays import Floats
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import AnyTracker, run
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.okada import curves, figures, following, vergence
from tricue.papers.okada.curves import Snapshot, WalkCurve
from tricue.scenes import WalkScene, overtaking
from tricue.track.base.adapter import traits_of
from tricue.track.base.track import Track

FIGURE_SEED = 0
"""The seed whose frames are in the figure."""


class SnapshotRecorder:
    """A tracker that also records its target's pixels and blocks in the frames with these numbers."""

    def __init__(self, tracker: Any, frames: tuple[int, ...]) -> None:
        self._tracker, self._frames = tracker, frames
        self.snapshots: dict[int, Snapshot] = {}

    def init(self, frame: Frame, box: Box) -> Track:
        self._index = 0
        return self._recorded(self._tracker.init(frame, box))

    def update(self, frame: Frame) -> Track:
        self._index += 1
        return self._recorded(self._tracker.update(frame))

    def _recorded(self, track: Track) -> Track:
        if self._index in self._frames:
            shows = "mask" in traits_of(self._tracker).shows
            targets, occluded = self._tracker.blocks if shows else ((), ())
            mask = self._tracker.mask if shows else None
            self.snapshots[self._index] = Snapshot(mask, targets, occluded, track.box)
        return track


def measure(case: Case, make: Maker, scene: WalkScene) -> WalkCurve:
    """Overlaps, errors and statuses of a tracker that starts on the first true box."""
    stereo = scene.frames[0].right is not None
    camera = {"rig": scene.rig} if stereo else {"intrinsics": scene.rig.intrinsics}
    frames = figures.key_frames(scene) if case.seed == FIGURE_SEED else ()
    recorder = SnapshotRecorder(make(seed=case.seed, **camera), frames)
    result = run(recorder, scene.frames, scene.boxes[0])
    return WalkCurve(
        *case,
        overlaps=metrics.overlaps(result.boxes, np.array(scene.boxes)),
        visible=scene.visible,
        statuses=result.statuses,
        errors=np.linalg.norm(result.positions - scene.positions, axis=1),
        distances=np.linalg.norm(scene.positions, axis=1),
        events=scene.events,
        restarted_overlaps=_restarted_overlaps(partial(make, seed=case.seed, **camera), scene),
        snapshots=recorder.snapshots,
    )


def _restarted_overlaps(make: Callable[[], AnyTracker], scene: WalkScene) -> Floats:
    """Overlaps (M,) of a tracker that starts after the overtaking, to measure the pass by itself."""
    overlaps = np.full(len(scene.frames), np.nan)
    start = curves.restart_frame(scene.events, scene.visible)
    if start is not None and start < len(scene.frames) - 1:
        result = run(make(), scene.frames[start:], scene.boxes[start])
        overlaps[start + 1 :] = metrics.overlaps(result.boxes[1:], np.array(scene.boxes[start + 1 :]))
    return overlaps


def _cues(*cues: str) -> Maker:
    return partial(tricue.create, "flow-depth", **({"cues": cues} if cues else {}))


def _printed(**changes: Any) -> Maker:
    params = replace(tricue.FlowDepthTracker.Params.paper(), **changes)
    return partial(tricue.create, "flow-depth", params=params)


def _scene(kind: str, depth: bool) -> Callable[..., WalkScene]:
    return partial(overtaking, kind=kind, depth=depth)


EXPERIMENTS: dict[str, Experiment[Any, Any]] = {
    "okada-fig8": Experiment(
        models={
            figures.BOTH: _cues(),
            figures.FLOW: _cues("flow"),
            figures.DISPARITY: _cues("disparity"),
            figures.PRINTED: _printed(),
            figures.PRINTED_FLOW: _printed(cues=("flow",)),
            figures.PRINTED_DISPARITY: _printed(cues=("disparity",)),
        },
        scenes={
            figures.PLAIN_STEREO: _scene("plain", depth=False),
            "plain, depth": _scene("plain", depth=True),
            "varied, stereo": _scene("varied", depth=False),
            "varied, depth": _scene("varied", depth=True),
        },
        measure=measure,
        summarize=curves.summarize,
        write_csv=curves.write_csv,
        draw=figures.frames_and_overlaps,
    ),
    **vergence.EXPERIMENTS,
    **following.EXPERIMENTS,
}
