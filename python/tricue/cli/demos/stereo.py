# SPDX-License-Identifier: MIT
"""``tricue demo stereo-head``: a head in front of two cameras, in meters, while the light changes."""

from argparse import Namespace
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from tricue.arrays import Floats
from tricue.cli.demos.metric import SceneResult, follow_all
from tricue.cli.steps import steps
from tricue.draw.stereo import stereo_overlay
from tricue.draw.video import OverlayWriter
from tricue.scenes import StereoScene, head
from tricue.track.base.registry import create
from tricue.track.base.track import Status

FPS = 30.0  # the cameras'
MIN_PLOTTED_ERROR, MAX_PLOTTED_ERROR = 0.1, 50.0  # percent of the distance, limits of the logarithmic plot
MIN_HELD_OVERLAP = 0.5  # of overlap

SCENES: Mapping[str, Callable[..., StereoScene]] = {
    "light swings by 30 %": head,
    "things of the skin's color": partial(head, kind="distractor"),
    "turns round, hair alone seen": partial(head, kind="turning"),
    "light jumps by 30 %": partial(head, kind="jump"),
    "light falls to a half": partial(head, kind="ramp"),
    "hidden by somebody's hand": partial(head, kind="hidden"),
}


def run(options: Namespace) -> int:
    """Run the command, print the table and write the files; return the exit code."""
    from tricue.draw import figures

    figures.require()
    video = OverlayWriter(options.output / f"{options.tracker}.mp4", FPS)
    results = follow_all(SCENES, options.seed, video, partial(_follow, options))
    plot = options.output / f"{options.tracker}.png"
    figures.save(lambda figure, *_: _plot(figure, results), (), {}, plot)
    print(f"{options.tracker}: a head in front of a stereo pair of 160x120, seed {options.seed}\n")
    print(f"{_table(results)}\n\nwrote {video.about}\nwrote {plot}")
    return 0


def relative_errors(result: SceneResult[StereoScene]) -> Floats:
    """Errors (M,) in percent of the head's true distance from the left camera."""
    return np.asarray(100 * result.errors / np.linalg.norm(result.scene.positions, axis=1))


def _follow(
    options: Namespace, name: str, scene: StereoScene, video: OverlayWriter
) -> SceneResult[StereoScene]:
    """Track one scene from its first true box into the video."""
    tracker = create(options.tracker, rig=scene.rig, seed=options.seed, kernels=options.kernels)
    result = SceneResult(scene)
    for step in steps(tracker, scene.frames, lambda _: scene.boxes[0], result.clock):
        result.tracks.append(step.track)
        truth, note = scene.boxes[step.number], f"{name}, frame {step.number}"
        video.write(stereo_overlay(step.frame, step.track, scene.rig, truth=truth, note=note))
    return result


def _table(results: Mapping[str, SceneResult[StereoScene]]) -> str:
    """Errors and overlaps in the frames in which at least half of the head is visible."""
    errors = f"{'median error':>14}{'95 %':>8}"
    lines = [f"{'scene':30}{'mean IoU':>10}{'IoU > 0.5':>11}{errors}{'hidden: said':>14}{'frames/s':>10}"]
    for name, result in results.items():
        overlaps = result.overlaps[result.seen]
        median, high = np.nanpercentile(relative_errors(result)[result.seen], [50, 95])
        held = f"{overlaps.mean():>10.2f}{np.mean(overlaps > MIN_HELD_OVERLAP):>11.1%}"
        said = result.count_hidden(Status.OCCLUDED, Status.LOST)
        lines.append(f"{name:30}{held}{median:>12.2f} %{high:>6.1f} %{said:>14}{result.speed:>10,.0f}")
    return "\n".join([*lines, "\nErrors are shares of the distance; hidden: said counts OCCLUDED and LOST."])


def _plot(figure: Any, results: Mapping[str, SceneResult[StereoScene]]) -> None:
    """A row per scene: the path from above, beside it the error over the frames."""
    from tricue.draw.paths import draw_path
    from tricue.papers.plots import shade_hidden

    figure.set_size_inches(11, 4.2 * len(results))
    rows = figure.subplots(len(results), 2, width_ratios=[1, 1.4], squeeze=False)
    for (path, error), (name, result) in zip(rows, results.items(), strict=True):
        draw_path(path, result.tracks, result.scene.rig.intrinsics, result.scene.positions)
        path.set_title(name, loc="left")
        shade_hidden(error, result.scene.visible)
        errors = relative_errors(result)
        error.plot(np.maximum(errors, MIN_PLOTTED_ERROR), color="#0072B2", linewidth=1.4)
        for change in result.scene.changes:
            error.axvline(change, color="0.6", linestyle=":", linewidth=0.8)
        error.set_title(f"median {np.nanmedian(errors[result.seen]):.2f} % where half visible", loc="left")
        error.set(
            yscale="log",
            ylim=(MIN_PLOTTED_ERROR, MAX_PLOTTED_ERROR),
            ylabel="position error, % of the distance",
        )
    rows[-1, 1].set_xlabel("frame (shaded: less than half visible; dotted: the light jumps)")
