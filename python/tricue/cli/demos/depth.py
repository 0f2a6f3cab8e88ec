# SPDX-License-Identifier: MIT
"""``tricue demo depth-particle``: people in front of a time-of-flight camera, tracked in meters."""

from argparse import Namespace
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from tricue.cli.demos.metric import SceneResult, follow_all, share_legend
from tricue.cli.steps import steps
from tricue.draw.depth_pictures import depth_range
from tricue.draw.overlays import depth_overlay
from tricue.draw.video import OverlayWriter
from tricue.scenes import DepthScene, crossing, walker
from tricue.track.base.registry import create
from tricue.track.base.track import Status

FPS = 15.0  # the camera's
MIN_PLOTTED_ERROR = 0.5  # centimeters, of the logarithmic plot

SCENES: Mapping[str, Callable[..., DepthScene]] = {
    "walking, crouching, turning": walker,
    "hidden by somebody nearer": crossing,
    "hidden, comes back 0.5 m farther": partial(crossing, depth_change=0.5),
    "walking, 30 % of pixels missing": partial(walker, missing=0.3),
}


def run(options: Namespace) -> int:
    """Run the command, print the table and write the files; return the exit code."""
    from tricue.draw import figures

    figures.require()
    video = OverlayWriter(options.output / f"{options.tracker}.mp4", FPS)
    results = follow_all(SCENES, options.seed, video, partial(_follow, options))
    plot = options.output / f"{options.tracker}.png"
    figures.save(lambda figure, *_: _plot(figure, results), (), {}, plot)
    print(f"{options.tracker}: a person before a time-of-flight camera of 176x144, seed {options.seed}\n")
    print(f"{_table(results)}\n\nwrote {video.about}\nwrote {plot}")
    return 0


def _follow(
    options: Namespace, name: str, scene: DepthScene, video: OverlayWriter
) -> SceneResult[DepthScene]:
    """Track one scene from its first true box into the video."""
    tracker = create(options.tracker, intrinsics=scene.intrinsics, seed=options.seed, kernels=options.kernels)
    result = SceneResult(scene)
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


def _table(results: Mapping[str, SceneResult[DepthScene]]) -> str:
    """Errors and overlaps in the frames in which at least half of the target is visible."""
    head = f"{'mean IoU':>10}{'median error':>14}{'95 %':>9}{'hidden: said':>14}{'frames/s':>10}"
    lines = [f"{'scene':34}{head}"]
    for name, result in results.items():
        median, high = 100 * np.nanpercentile(result.errors[result.seen], [50, 95])
        numbers = f"{result.overlaps[result.seen].mean():>10.2f}{median:>11.1f} cm{high:>6.1f} cm"
        lines.append(f"{name:34}{numbers}{result.count_hidden(Status.OCCLUDED):>14}{result.speed:>10,.0f}")
    return "\n".join(lines)


def _plot(figure: Any, results: Mapping[str, SceneResult[DepthScene]]) -> None:
    """A row per scene: the path from above, beside it the error over the frames."""
    from tricue.draw.paths import draw_path
    from tricue.papers.plots import shade_hidden

    figure.set_size_inches(11, 4.2 * len(results))
    rows = figure.subplots(len(results), 2, width_ratios=[1, 1.4], squeeze=False)
    for (path, error), (name, result) in zip(rows, results.items(), strict=True):
        draw_path(path, result.tracks, result.scene.intrinsics, result.scene.positions)
        path.set_title(name, loc="left")
        shade_hidden(error, result.scene.visible)
        errors = 100 * result.errors
        error.plot(np.maximum(errors, MIN_PLOTTED_ERROR), color="#0072B2", linewidth=1.4)
        error.set_title(f"median {np.nanmedian(errors[result.seen]):.1f} cm where half visible", loc="left")
        error.set(yscale="log", ylim=(MIN_PLOTTED_ERROR, 500), ylabel="position error, cm")
    rows[-1, 1].set_xlabel("frame (shaded: less than half visible)")
    share_legend(figure, rows[:, 0])
