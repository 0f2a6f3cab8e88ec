# SPDX-License-Identifier: MIT
"""Measurements of the demos in meters: position errors, overlaps, reported statuses."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.cli.progress import Progress
from tricue.cli.steps import RunClock
from tricue.draw.video import OverlayWriter
from tricue.evaluation import metrics
from tricue.papers.curves import HIDDEN_BELOW, MIN_VISIBLE
from tricue.scenes import DepthScene, StereoScene, WalkScene
from tricue.scenes.stress.scene import StressScene
from tricue.track.base.track import Status, Track

S = TypeVar("S", DepthScene, StereoScene, WalkScene, StressScene)


@dataclass(frozen=True)
class SceneResult(Generic[S]):
    """The tracks and times of one scene."""

    scene: S
    tracks: list[Track] = field(default_factory=list)
    clock: RunClock = field(default_factory=RunClock)

    @property
    def errors(self) -> Floats:
        """Distances (M,) of the positions from the true ones, meters; NaN without a position."""
        positions = [np.full(3, np.nan) if t.position is None else t.position for t in self.tracks]
        distances: Floats = np.linalg.norm(positions - self.scene.positions, axis=1)
        return distances

    @property
    def overlaps(self) -> Floats:
        """Overlaps (M,) with the box of the whole target; NaN where it has none."""
        return metrics.overlaps([track.box for track in self.tracks], self.scene.boxes)

    @property
    def seen(self) -> NDArray[np.bool_]:
        """Frames (M,) in which at least half of the target is visible."""
        return np.asarray(self.scene.visible >= MIN_VISIBLE)

    def count_hidden(self, *statuses: Status) -> str:
        """The number of frames with a hidden target in which the tracker reports one of the statuses, as
        "count/frames".
        """
        hidden = np.flatnonzero(self.scene.visible < HIDDEN_BELOW)
        count = sum(self.tracks[index].status in statuses for index in hidden)
        return f"{count}/{len(hidden)}"

    @property
    def speed(self) -> float:
        """Frames per second."""
        return self.clock.updates / self.clock.tracking


def follow_all(
    scenes: Mapping[str, Callable[..., S]],
    seed: int,
    video: OverlayWriter,
    follow: Callable[[str, S, OverlayWriter], SceneResult[S]],
) -> dict[str, SceneResult[S]]:
    """Make each scene, track it, and write everything into one video, which is closed at the end."""
    results: dict[str, SceneResult[S]] = {}
    with video, Progress(len(scenes)) as progress:
        for done, (name, make) in enumerate(scenes.items()):
            progress(done, f"scenes, now {name}")
            results[name] = follow(name, make(seed=seed), video)
    return results


def share_legend(figure: Any, paths: Iterable[Any]) -> None:
    """Replace the legends of paths by one below them, as each would hide a part of its narrow picture."""
    handles: dict[str, Any] = {}
    for axes in paths:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
        if legend := axes.get_legend():
            legend.remove()
    if handles:
        figure.legend(
            handles.values(), handles.keys(), loc="outside lower center", ncols=len(handles), frameon=False
        )
