# SPDX-License-Identifier: MIT
"""``tricue demo flow-depth``: a walker is overtaken and passes somebody, seen by a panning stereo pair."""

from argparse import Namespace
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import Any

import numpy as np

from tricue.cli.demos.metric import SceneResult, follow_all, share_legend
from tricue.cli.steps import steps
from tricue.draw.masks import flow_depth_overlay
from tricue.draw.video import OverlayWriter
from tricue.scenes import WalkScene, overtaking
from tricue.track.base.registry import create
from tricue.track.base.track import Status

FPS = 15.0  # the cameras'
MIN_HELD_OVERLAP = 0.5  # of overlap

DemoCase = tuple[Callable[..., WalkScene], dict[str, Any]]
"""A function that makes a scene, and the tracker's parameters for it."""

_plain = lru_cache(maxsize=1)(overtaking)  # it takes seconds to make

CASES: Mapping[str, DemoCase] = {
    "both cues": (_plain, {}),
    "flow alone": (_plain, {"cues": ("flow",)}),
    "disparity alone": (_plain, {"cues": ("disparity",)}),
    "both, a depth camera": (partial(overtaking, depth=True), {}),
    "both, another scene": (partial(overtaking, kind="varied"), {}),
}


def run(options: Namespace) -> int:
    """Run the command, print the table and write the files; return the exit code."""
    from tricue.draw import figures

    figures.require()
    video = OverlayWriter(options.output / f"{options.tracker}.mp4", FPS)
    scenes = {name: make for name, (make, _) in CASES.items()}
    results = follow_all(scenes, options.seed, video, partial(_follow, options))
    plot = options.output / f"{options.tracker}.png"
    figures.save(lambda figure, *_: _plot(figure, results), (), {}, plot)
    print(f"{options.tracker}: a walker is overtaken and passes somebody, seed {options.seed}\n")
    print(f"{_table(results)}\n\nwrote {video.about}\nwrote {plot}")
    return 0


def _follow(options: Namespace, name: str, scene: WalkScene, video: OverlayWriter) -> SceneResult[WalkScene]:
    """Track one scene from its first true box into the video."""
    pair = scene.frames[0].right is not None
    camera = {"rig": scene.rig} if pair else {"intrinsics": scene.rig.intrinsics}
    tracker = create(options.tracker, **camera, **CASES[name][1], seed=options.seed, kernels=options.kernels)
    result = SceneResult(scene)
    for step in steps(tracker, scene.frames, lambda _: scene.boxes[0], result.clock):
        result.tracks.append(step.track)
        truth, note = scene.boxes[step.number], f"{name}, frame {step.number}"
        image = step.frame.color
        assert image is not None
        video.write(flow_depth_overlay(image, step.track, step.mask, step.blocks, truth=truth, note=note))
    return result


def _table(results: Mapping[str, SceneResult[WalkScene]]) -> str:
    """Overlaps and errors in the frames in which at least half of the target is visible."""
    errors = f"{'median error':>14}"
    lines = [f"{'cues':24}{'mean IoU':>10}{'IoU > 0.5':>11}{errors}{'hidden: said':>14}{'frames/s':>10}"]
    for name, result in results.items():
        overlaps = result.overlaps[result.seen]
        known = result.errors[result.seen & np.isfinite(result.errors)]
        error = f"{np.median(known):>12.2f} m" if known.size else f"{'-':>14}"
        held = f"{overlaps.mean():>10.2f}{np.mean(overlaps > MIN_HELD_OVERLAP):>11.1%}"
        said = result.count_hidden(Status.OCCLUDED, Status.LOST)
        lines.append(f"{name:24}{held}{error}{said:>14}{result.speed:>10,.0f}")
    return "\n".join(
        [*lines, "\nWhere half of the target is visible; hidden: said counts OCCLUDED and LOST."]
    )


def _plot(figure: Any, results: Mapping[str, SceneResult[WalkScene]]) -> None:
    """A row per scene: the path from above if there are positions, beside it the overlap over the frames."""
    from tricue.draw.paths import draw_path
    from tricue.papers.plots import shade_hidden

    figure.set_size_inches(11, 3.6 * len(results))
    rows = figure.subplots(len(results), 2, width_ratios=[1, 1.6], squeeze=False)
    for (path, overlap), (name, result) in zip(rows, results.items(), strict=True):
        if np.isfinite(result.errors).any():
            draw_path(path, result.tracks, result.scene.rig.intrinsics, result.scene.positions)
        else:
            path.text(0.5, 0.5, "no position without disparity", ha="center", transform=path.transAxes)
            path.axis("off")
        path.set_title(name, loc="left")
        shade_hidden(overlap, result.scene.visible)
        overlap.plot(result.overlaps, color="#0072B2", linewidth=1.4)
        if result.scene.events.passing is not None:
            overlap.axvline(result.scene.events.passing, color="0.4", linestyle="--", linewidth=0.8)
        held = np.mean(result.overlaps[result.seen] > MIN_HELD_OVERLAP)
        overlap.set_title(f"{held:.1%} above 0.5 where half visible", loc="left")
        overlap.set(ylim=(0, 1), ylabel="IoU")
    rows[-1, 1].set_xlabel("frame (shaded: less than half visible; dashed: the pass)")
    share_legend(figure, rows[:, 0])
