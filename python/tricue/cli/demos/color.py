# SPDX-License-Identifier: MIT
"""``tricue demo color-particle``: a face over clutter while its brightness changes."""

from argparse import Namespace
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.cli.progress import Progress
from tricue.cli.steps import RunClock, steps
from tricue.draw.overlays import overlay
from tricue.draw.video import OverlayWriter
from tricue.track.base.registry import create

LOST_DISTANCE = 25.0  # pixels from the true center; farther off a face counts as lost
FPS = 15.0
MIN_PLOTTED_ERROR = 0.1  # pixels, of the logarithmic plot


@dataclass(frozen=True)
class ColorResult:
    """The results of one scene: errors in pixels and overlaps, one per frame."""

    errors: NDArray[np.float64]
    overlaps: NDArray[np.float64]
    changes: tuple[int, ...]
    clock: RunClock


def run(options: Namespace) -> int:
    """Track the scenes, print the table and write the files; return the exit code."""
    from tricue.draw import figures
    from tricue.scenes import BACKGROUNDS, face_over_clutter

    figures.require()
    results: dict[str, ColorResult] = {}
    with (
        OverlayWriter(options.output / f"{options.tracker}.mp4", FPS) as video,
        Progress(len(BACKGROUNDS)) as progress,
    ):
        for done, background in enumerate(BACKGROUNDS):
            progress(done, f"scenes, now {background}")
            scene = face_over_clutter(seed=options.seed, background=background)
            results[background] = _follow(options, scene, video)
    plot = options.output / f"{options.tracker}.png"
    figures.save(lambda figure, *_: _plot(figure, results), (), {}, plot)
    print(f"{options.tracker}: a face over clutter while its brightness changes, seed {options.seed}\n")
    print(f"{_table(results)}\n\nwrote {video.about}\nwrote {plot}")
    return 0


def _follow(options: Namespace, scene: Any, video: OverlayWriter) -> ColorResult:
    """Track one scene from its first true box into the video."""
    from tricue.evaluation import metrics

    tracker = create(options.tracker, seed=options.seed, kernels=options.kernels)
    boxes, clock = [], RunClock()
    for step in steps(tracker, scene.frames, lambda _: scene.boxes[0], clock):
        boxes.append(step.track.box)
        note = f"{scene.name}, frame {step.number}"
        truth = scene.boxes[step.number]
        if step.frame.color is not None:
            picture = overlay(step.frame.color, step.track, particles=step.particles, truth=truth, note=note)
            video.write(picture)
    return ColorResult(
        metrics.center_errors(boxes, scene.boxes), metrics.overlaps(boxes, scene.boxes), scene.changes, clock
    )


def _table(results: Mapping[str, ColorResult]) -> str:
    lines = [f"{'background':22}{'mean error':>12}{'> 25 px off':>13}{'IoU > 0.5':>11}{'frames/s':>10}"]
    for name, result in results.items():
        speed = result.clock.updates / result.clock.tracking
        lost, held = np.mean(result.errors > LOST_DISTANCE), np.mean(result.overlaps > 0.5)
        lines.append(f"{name:22}{result.errors.mean():>9.1f} px{lost:>13.1%}{held:>11.1%}{speed:>10,.0f}")
    return "\n".join(lines)


def _plot(figure: Any, results: Mapping[str, ColorResult]) -> None:
    """A panel per background: the error over the frames; dotted where the brightness changes."""
    figure.set_size_inches(8, 1.6 * len(results))
    panels = figure.subplots(len(results), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, (name, result) in zip(panels, results.items(), strict=True):
        axes.plot(np.maximum(result.errors, MIN_PLOTTED_ERROR), color="#0072B2", linewidth=1.4)
        axes.axhline(LOST_DISTANCE, color="0.4", linestyle="--", linewidth=0.8)
        for change in result.changes:
            axes.axvline(change, color="0.6", linestyle=":", linewidth=0.8)
        axes.set_title(f"{name}: {result.errors.mean():.1f} px", loc="left")
        axes.set(yscale="log", ylim=(MIN_PLOTTED_ERROR, 400), xlim=(0, len(result.errors) - 1))
    figure.supxlabel("frame (dotted: the brightness changes; dashed: 25 px, lost)")
    figure.supylabel("center error, px")
