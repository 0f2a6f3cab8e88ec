# SPDX-License-Identifier: MIT
"""Frames and overlaps of the overtaking, after figure 8 of Okada, Shirai and Miura (1996)."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tricue.draw.figures import COLORS, draw_box
from tricue.draw.masks import block_picture
from tricue.papers.curves import MIN_OVERLAP, first_runs, models_of, stacked
from tricue.papers.okada.curves import (
    FRAMES_AFTER_PASS,
    MAX_WALKER_RECOVERY_DELAY,
    WalkCurve,
)
from tricue.papers.plots import plot_band, shade_hidden
from tricue.scenes import WalkScene

BOTH, FLOW, DISPARITY = "both cues (default)", "flow alone", "disparity alone"
PRINTED = "as printed"
PRINTED_FLOW, PRINTED_DISPARITY = f"{PRINTED}, flow alone", f"{PRINTED}, disparity alone"
PLAIN_STEREO = "plain, stereo"
TRUTH_COLOR = "white"


def key_frames(scene: WalkScene) -> tuple[int, ...]:
    """The frames in the figure: before, during and after the overtaking, and the pass."""
    hiding, hidden, back, passing = scene.events
    wanted = [1, hiding, hidden, back, None if back is None else back + MAX_WALKER_RECOVERY_DELAY]
    wanted += [] if passing is None else [passing + step * FRAMES_AFTER_PASS for step in (-1, 0, 1, 2)]
    last = len(scene.frames) - 1
    return tuple(sorted({min(index, last) for index in wanted if index is not None}))


def frames_and_overlaps(figure: Any, curves: Sequence[WalkCurve], scenes: Mapping[str, WalkScene]) -> None:
    """Frames of the first scene from seed 0, a row per tracker: target pixels white, target blocks black,
    occluded ones black and crossed; the tracker's box solid, the true one dashed. Below, overlap over time in
    each scene: mean over the seeds, and quartiles of the first tracker.
    """
    models = models_of(curves)
    figure.set_size_inches(15, 1.5 * len(models) + 6)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.5 * len(models), 6])
    (name, scene), *_ = scenes.items()
    frames = key_frames(scene)
    rows = top.subplots(len(models), len(frames), squeeze=False)
    first = first_runs(curves, name)
    for color, row, model in zip(COLORS, rows, models, strict=False):
        for axes, index in zip(row, frames, strict=True):
            _picture(axes, scene, index, first[model], color)
        row[0].set_ylabel(model.replace(", ", ",\n"), color=color)
    for axes, index in zip(rows[0], frames, strict=True):
        axes.set_title(f"frame {index}", loc="left")
    panels = bottom.subplots(-(-len(scenes) // 2), 2, sharex=True, sharey=True, squeeze=False)
    for axes, scene_name in zip(panels.flat, scenes, strict=False):
        _overlaps(axes, [curve for curve in curves if curve.scene == scene_name], models)
        axes.set_title(scene_name, loc="left")
    top.suptitle(
        f"{name}, seed 0: tracker's box solid, true box dashed; target pixels white, target blocks black, "
        "occluded blocks black and crossed",
        fontsize=9,
    )
    runs = len({curve.seed for curve in curves})
    for axes in panels[-1]:
        axes.set_xlabel(f"frame (runs: {runs}; shaded: the target is less than half visible)")
    bottom.supylabel("IoU: mean; quartiles of the default")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    bottom.legend(handles, labels, frameon=False, loc="outside lower center", ncols=len(models))


def _picture(axes: Any, scene: WalkScene, index: int, curve: WalkCurve, color: str) -> None:
    image = scene.frames[index].color
    assert image is not None
    mask, targets, occluded, box = curve.snapshots[index]
    height, width = image.shape[:2]
    picture = block_picture(image, mask, targets, occluded, window=False)
    axes.imshow(picture[..., ::-1], extent=(-0.5, width - 0.5, height - 0.5, -0.5))
    draw_box(axes, box, color)
    draw_box(axes, scene.boxes[index], TRUTH_COLOR)
    axes.patches[-1].set_linestyle("--")
    correct = "on target" if curve.overlaps[index] > MIN_OVERLAP else "off target"
    axes.set_xlabel(f"{curve.statuses[index]}, {correct}", fontsize=8)
    axes.set(xticks=[], yticks=[], xlim=(-0.5, width - 0.5), ylim=(height - 0.5, -0.5))
    for spine in axes.spines.values():
        spine.set_visible(False)


def _overlaps(axes: Any, runs: Sequence[WalkCurve], models: Sequence[str]) -> None:
    shade_hidden(axes, np.median([run.visible for run in runs], axis=0))
    for color, model in zip(COLORS, models, strict=False):
        overlaps = stacked(runs, model, "overlaps")
        if model == models[0]:
            plot_band(axes, overlaps.mean(axis=0), overlaps, color, model)
        else:
            axes.plot(overlaps.mean(axis=0), color=color, linewidth=1.2, label=model)
    axes.axhline(MIN_OVERLAP, color="0.4", linestyle=":", linewidth=0.8)
    passing = [run.events.passing for run in runs if run.events.passing is not None]
    if passing:
        axes.axvline(float(np.median(passing)), color="0.4", linestyle="--", linewidth=0.8)
        axes.annotate(" pass", (float(np.median(passing)), 0.02))
    axes.set(ylim=(0, 1))
