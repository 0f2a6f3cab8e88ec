# SPDX-License-Identifier: MIT
"""Figure 8 of Okada, Shirai and Miura (1996): a walker is overtaken, and passes somebody who stands.

Flow and disparity together, and each alone: the paper says that flow alone fails on the overtaking, as both
walk alike, and disparity alone on the pass, as both are as far away.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import Contender, run
from tricue.papers import walk_curves, walk_figures
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.walk_curves import Shot, WalkCurve
from tricue.scenes import WalkScene, overtaking
from tricue.track.base.track import Track

SHOWN = 0  # the seed whose frames the figure has


class Watcher:
    """A tracker whose pixels and blocks are kept in some frames, counted from 0."""

    def __init__(self, tracker: Contender, moments: tuple[int, ...]) -> None:
        self._tracker, self._moments = tracker, moments
        self.shots: dict[int, Shot] = {}

    def init(self, frame: Frame, box: Box) -> Track:
        self._index = 0
        return self._seen(self._tracker.init(frame, box))

    def update(self, frame: Frame) -> Track:
        self._index += 1
        return self._seen(self._tracker.update(frame))

    def _seen(self, track: Track) -> Track:
        if self._index in self._moments:
            blocks = getattr(self._tracker, "blocks", ((), ()))
            self.shots[self._index] = Shot(getattr(self._tracker, "mask", None), *blocks)
        return track


def measure(case: Case, make: Maker, scene: WalkScene) -> WalkCurve:
    """Overlaps, errors and statuses of a tracker that starts on the first true box."""
    pair = scene.frames[0].right is not None
    camera = {"rig": scene.rig} if pair else {"intrinsics": scene.rig.intrinsics}
    moments = walk_figures.moments(scene) if case.seed == SHOWN else ()
    watcher = Watcher(make(seed=case.seed, **camera), moments)
    result = run(watcher, scene.frames, scene.boxes[0])
    truth = np.array(scene.boxes)
    return WalkCurve(
        *case,
        errors=np.linalg.norm(result.positions - scene.positions, axis=1),
        distances=np.linalg.norm(scene.positions, axis=1),
        overlaps=metrics.overlaps(result.boxes, truth),
        visible=scene.visible,
        statuses=result.statuses,
        events=scene.events,
        between=_between(partial(make, seed=case.seed, **camera), scene),
        shots=watcher.shots,
    )


def _between(make: Callable[[], Contender], scene: WalkScene) -> walk_curves.Floats:
    """(M,) overlaps of a tracker that starts after the overtaking, so that the pass is seen by itself."""
    overlaps = np.full(len(scene.frames), np.nan)
    start = walk_curves.start_between(scene.events, scene.visible)
    if start is not None and start < len(scene.frames) - 1:
        result = run(make(), scene.frames[start:], scene.boxes[start])
        overlaps[start + 1 :] = metrics.overlaps(result.boxes[1:], np.array(scene.boxes[start + 1 :]))
    return overlaps


def _cues(*cues: str) -> Maker:
    return partial(tricue.create, "flow-depth", **({"cues": cues} if cues else {}))


def _scene(kind: str, depth: bool) -> Callable[..., WalkScene]:
    return partial(overtaking, kind=kind, depth=depth)


EXPERIMENTS: dict[str, Experiment[WalkScene, WalkCurve]] = {
    "okada-fig8": Experiment(
        models={
            walk_figures.BOTH: _cues(),
            walk_figures.FLOW: _cues("flow"),
            walk_figures.DISPARITY: _cues("disparity"),
        },
        scenes={
            walk_figures.PLAIN: _scene("plain", depth=False),
            "plain, depth": _scene("plain", depth=True),
            "varied, stereo": _scene("varied", depth=False),
            "varied, depth": _scene("varied", depth=True),
        },
        measure=measure,
        summarize=walk_curves.summarize,
        write_csv=walk_curves.write_csv,
        draw=walk_figures.frames_and_overlaps,
    )
}
