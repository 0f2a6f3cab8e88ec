# SPDX-License-Identifier: MIT
"""``tricue demo fused``: a stress scene, tracked in color, depth, both, and a stereo pair."""

from argparse import Namespace
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import Any

import numpy as np

from tricue.arrays import Floats, Image
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.cli.demos.metric import SceneResult, follow_all, share_legend
from tricue.cli.outputs import Step
from tricue.cli.steps import steps
from tricue.draw.overlays import depth_overlay, overlay
from tricue.draw.video import OverlayWriter
from tricue.scenes.stress.scene import StressScene, stress_scene
from tricue.track.base.registry import create
from tricue.track.base.track import Status

FPS = 30.0  # the cameras'
MIN_HELD_OVERLAP = 0.5  # of overlap

DemoCase = tuple[Callable[..., StressScene], tuple[str, ...]]
"""A function that makes a scene, and the channels that the tracker gets."""

_rgbd = lru_cache(maxsize=1)(partial(stress_scene, "all", channels="rgbd"))  # it takes seconds to make

CASES: Mapping[str, DemoCase] = {
    "color alone": (_rgbd, ("color",)),
    "depth alone": (_rgbd, ("depth",)),
    "color and depth": (_rgbd, ("color", "depth")),
    "a stereo pair": (partial(stress_scene, "all", channels="stereo"), ("color", "right")),
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
    print(
        f"{options.tracker}: a target through light, look-alikes, occlusion and more, seed {options.seed}\n"
    )
    print(f"{_table(results)}\n\nwrote {video.about}\nwrote {plot}")
    return 0


def _follow(
    options: Namespace, name: str, scene: StressScene, video: OverlayWriter
) -> SceneResult[StressScene]:
    """Track one scene from its first true box into the video."""
    channels = CASES[name][1]
    camera: dict[str, Any] = {"rig": scene.rig} if "right" in channels else {}
    if "depth" in channels:
        camera["intrinsics"] = scene.intrinsics
    tracker = create(options.tracker, **camera, seed=options.seed, kernels=options.kernels)
    frames = (
        Frame(**{each: getattr(frame, each) for each in channels}, timestamp=frame.timestamp)
        for frame in scene.frames
    )
    result = SceneResult(scene)
    for step in steps(tracker, frames, lambda _: Box(*scene.boxes[0].tolist()), result.clock):
        result.tracks.append(step.track)
        video.write(_picture(step, scene.boxes[step.number], f"{name}, frame {step.number}"))
    return result


def _picture(step: Step, numbers: Floats, note: str) -> Image:
    """The overlay, on the depth if there is no color. numbers: the true box, NaN if there is none."""
    truth = Box(*numbers.tolist()) if np.isfinite(numbers).all() else None
    if step.frame.color is not None:
        return overlay(step.frame.color, step.track, truth=truth, note=note)
    assert step.frame.depth is not None
    return depth_overlay(step.frame.depth, step.track, truth=truth, note=note)


def _table(results: Mapping[str, SceneResult[StressScene]]) -> str:
    """Overlaps and errors in the frames in which at least half of the target is visible."""
    errors = f"{'median error':>14}{'90 %':>9}"
    lines = [f"{'channels':20}{'mean IoU':>10}{'IoU > 0.5':>11}{errors}{'gone: said':>12}{'frames/s':>10}"]
    for name, result in results.items():
        overlaps, known = result.overlaps[result.seen], result.errors[result.seen]
        known = known[np.isfinite(known)]
        error = f"{'-':>14}{'-':>9}"
        if known.size:
            median, high = 100 * np.percentile(known, [50, 90])
            error = f"{median:>11.1f} cm{high:>6.1f} cm"
        held = f"{overlaps.mean():>10.2f}{np.mean(overlaps > MIN_HELD_OVERLAP):>11.1%}"
        said = result.count_hidden(Status.OCCLUDED, Status.LOST)
        lines.append(f"{name:20}{held}{error}{said:>12}{result.speed:>10,.0f}")
    note = "Where half of the target is visible; gone: said counts OCCLUDED and LOST."
    return "\n".join([*lines, f"\n{note}"])


def _plot(figure: Any, results: Mapping[str, SceneResult[StressScene]]) -> None:
    """A row per set of channels: the path from above if there are positions, beside it the overlap over the
    frames, with the names of the events.
    """
    from tricue.draw.paths import draw_path
    from tricue.papers.plots import shade_hidden

    figure.set_size_inches(11, 3.6 * len(results))
    rows = figure.subplots(len(results), 2, width_ratios=[1, 2.2], squeeze=False)
    for (path, overlap), (name, result) in zip(rows, results.items(), strict=True):
        if np.isfinite(result.errors).any():
            draw_path(path, result.tracks, result.scene.intrinsics, result.scene.positions)
        else:
            path.text(0.5, 0.5, "no position", ha="center", transform=path.transAxes)
            path.axis("off")
        path.set_title(name, loc="left")
        shade_hidden(overlap, result.scene.visible)
        overlap.plot(result.overlaps, color="#0072B2", linewidth=1.4)
        for event, span in result.scene.spans.items():
            overlap.axvline(span.start, color="0.6", linestyle=":", linewidth=0.8)
            overlap.text(span.start + 1, 1.02, event, fontsize="small")
        held = np.mean(result.overlaps[result.seen] > MIN_HELD_OVERLAP)
        overlap.set_title(f"{held:.1%} above 0.5 where half visible", loc="left")
        overlap.set(ylim=(0, 1.1), ylabel="IoU")
    rows[-1, 1].set_xlabel("frame (shaded: less than half visible; dotted: something begins)")
    share_legend(figure, rows[:, 0])
