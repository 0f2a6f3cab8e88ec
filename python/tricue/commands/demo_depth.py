# SPDX-License-Identifier: MIT
"""``tricue demo depth-particle``: people before a time-of-flight camera, tracked in metres."""

from argparse import Namespace
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.commands.progress import Progress
from tricue.commands.run import Clock, steps
from tricue.draw import OverlayWriter, depth_overlay, depth_range
from tricue.evaluation.depth_curves import HALF, HIDDEN
from tricue.scenes import DepthScene, crossing, walker
from tricue.track.create import create
from tricue.track.track import Status, Track

FPS = 15.0  # the camera's
FLOOR = 0.5  # centimetres, of the logarithmic plot

SCENES: Mapping[str, Callable[..., DepthScene]] = {
    "walking, crouching, turning": walker,
    "hidden by somebody nearer": crossing,
    "hidden, comes back 0.5 m farther": partial(crossing, depth_change=0.5),
    "walking, 30 % of pixels missing": partial(walker, missing=0.3),
}


@dataclass(frozen=True)
class Result:
    """What came out of one scene."""

    scene: DepthScene
    tracks: list[Track] = field(default_factory=list)
    clock: Clock = field(default_factory=Clock)

    @property
    def errors(self) -> NDArray[np.float64]:
        """(M,) distances of the positions from the true ones, centimetres; NaN without a position."""
        places = [np.full(3, np.nan) if t.position is None else t.position for t in self.tracks]
        distances: NDArray[np.float64] = 100 * np.linalg.norm(places - self.scene.positions, axis=1)
        return distances

    @property
    def overlaps(self) -> NDArray[np.float64]:
        """(M,) with the box round the whole body."""
        return np.array([t.box.iou(b) for t, b in zip(self.tracks, self.scene.boxes, strict=True)])

    @property
    def said(self) -> str:
        """In how many of the frames in which the target is hidden the tracker says OCCLUDED."""
        hidden = np.flatnonzero(self.scene.visible < HIDDEN)
        said = sum(self.tracks[index].status is Status.OCCLUDED for index in hidden)
        return f"{said}/{len(hidden)}"


def demo_depth(options: Namespace) -> int:
    """Run the verb, print the table and write the files; the exit code."""
    from tricue.evaluation import figures

    figures.require()
    results: dict[str, Result] = {}
    with (
        OverlayWriter(options.output / f"{options.tracker}.mp4", FPS) as video,
        Progress(len(SCENES)) as progress,
    ):
        for done, (name, make) in enumerate(SCENES.items()):
            progress(done, f"scenes, now {name}")
            results[name] = _follow(options, name, make(seed=options.seed), video)
    plot = options.output / f"{options.tracker}.png"
    figures.save(lambda figure, *_: _plot(figure, results), (), {}, plot)
    print(f"{options.tracker}: a person before a time-of-flight camera of 176x144, seed {options.seed}\n")
    print(f"{_table(results)}\n\nwrote {video.path}\nwrote {plot}")
    return 0


def _follow(options: Namespace, name: str, scene: DepthScene, video: OverlayWriter) -> Result:
    """Track one scene from its first true box into the video."""
    tracker = create(options.tracker, intrinsics=scene.intrinsics, seed=options.seed, kernels=options.kernels)
    result = Result(scene)
    first = scene.frames[0].depth
    assert first is not None
    near, far = depth_range(first) or (0.0, 1.0)
    for step in steps(tracker, scene.frames, lambda _: scene.boxes[0], result.clock):
        result.tracks.append(step.track)
        depth = step.frame.depth
        assert depth is not None
        picture = depth_overlay(
            depth,
            step.track,
            particles=step.particles,
            objects=step.objects or (),
            truth=scene.boxes[step.number],
            note=f"{name}, frame {step.number}",
            near=near,
            far=far,
        )
        video.write(picture)
    return result


def _table(results: Mapping[str, Result]) -> str:
    """Errors and overlaps in the frames in which at least half of the target is visible."""
    head = f"{'mean IoU':>10}{'median error':>14}{'95 %':>9}{'hidden: said':>14}{'frames/s':>10}"
    lines = [f"{'scene':34}{head}"]
    for name, result in results.items():
        seen = result.scene.visible >= HALF
        median, high = np.nanpercentile(result.errors[seen], [50, 95])
        speed = result.clock.updates / result.clock.tracking
        numbers = f"{result.overlaps[seen].mean():>10.2f}{median:>11.1f} cm{high:>6.1f} cm"
        lines.append(f"{name:34}{numbers}{result.said:>14}{speed:>10,.0f}")
    return "\n".join(lines)


def _plot(figure: Any, results: Mapping[str, Result]) -> None:
    """A row a scene: the path from above, beside it the error over the frames."""
    from tricue.evaluation.depth_figures import shade_hidden
    from tricue.evaluation.paths import draw_path

    figure.set_size_inches(11, 4.2 * len(results))
    rows = figure.subplots(len(results), 2, width_ratios=[1, 1.4], squeeze=False)
    for (path, error), (name, result) in zip(rows, results.items(), strict=True):
        draw_path(path, result.tracks, result.scene.intrinsics, result.scene.positions)
        path.set_title(name, loc="left")
        shade_hidden(error, result.scene.visible)
        error.plot(np.maximum(result.errors, FLOOR), color="#0072B2", linewidth=1.4)
        seen = result.errors[result.scene.visible >= HALF]
        error.set_title(f"median {np.nanmedian(seen):.1f} cm where half visible", loc="left")
        error.set(yscale="log", ylim=(FLOOR, 500), ylabel="position error, cm")
    rows[-1, 1].set_xlabel("frame (shaded: less than half visible)")
