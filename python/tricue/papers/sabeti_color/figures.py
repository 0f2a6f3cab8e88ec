# SPDX-License-Identifier: MIT
"""Figures 1 and 2 of Sabeti, Parvizi and Wu (2008): error curves beside pictures of the scenes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tricue.draw.figures import COLORS, draw_box
from tricue.papers.curves import Floats, first_runs, models_of, stacked
from tricue.papers.plots import plot_band, show_frame
from tricue.papers.sabeti_color.curves import MAX_CENTER_ERROR, ColorCurve
from tricue.scenes import Scene


def error_curves(figure: Any, curves: Sequence[ColorCurve], scenes: Mapping[str, Scene]) -> None:
    """Figure 1: the scenes with the true paths; each model's mean center error and its 10-90 % range."""
    models = models_of(curves)
    columns = 4
    rows = -(-len(models) // columns)
    figure.set_size_inches(13, 2.4 + 2.5 * rows)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.6, 2.4 * rows])
    for axes, (name, scene) in zip(np.ravel(top.subplots(1, len(scenes))), scenes.items(), strict=True):
        show_frame(axes, scene.frames[len(scene.frames) // 4].color, name)
        axes.plot(*np.array([box.center for box in scene.boxes]).T, color="white", linewidth=1)
    panels = bottom.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes, model in zip(panels.flat, models, strict=False):
        errors = stacked(curves, model, "errors")
        for other in models:
            axes.plot(stacked(curves, other, "errors").mean(axis=0), color="0.85", linewidth=0.8)
        _plot_mean(axes, errors, COLORS[0], model)
        axes.axhline(MAX_CENTER_ERROR, color="0.4", linestyle=":", linewidth=0.8)
        axes.set_title(
            f"{model}: {errors.mean():.1f} px, {np.mean(errors > MAX_CENTER_ERROR):.1%} lost", loc="left"
        )
        axes.set(yscale="log", ylim=(0.3, 400), xlim=(0, errors.shape[1] - 1))
    for axes in panels.flat[len(models) :]:
        axes.set_visible(False)
    bottom.supxlabel(f"frame ({len(stacked(curves, models[0], 'errors'))} runs per model)")
    bottom.supylabel("center error, px: mean, 10-90 %")


def overlap_curves(figure: Any, curves: Sequence[ColorCurve], scenes: Mapping[str, Scene]) -> None:
    """Figure 2: frames around each change of light with the models' boxes; mean overlap, 10-90 % range."""
    models = models_of(curves)
    (name, scene), *_ = scenes.items()
    first = first_runs(curves, name)
    figure.set_size_inches(11, 6)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1, 2.6])
    indices = [index for change in scene.changes for index in (change - 1, change, change + 8)]
    for axes, index in zip(np.ravel(top.subplots(1, len(indices))), indices, strict=True):
        show_frame(axes, scene.frames[index].color, f"frame {index}")
        for color, model in zip(COLORS, models, strict=False):
            draw_box(axes, first[model].boxes[index], color)
    axes = bottom.subplots()
    for color, model in zip(COLORS, models, strict=False):
        overlaps = stacked(curves, model, "overlaps")
        label = f"{model}: {np.mean(overlaps > 0.5):.1%} above 0.5"
        _plot_mean(axes, overlaps, color, label)
    for change in scene.changes:
        axes.axvline(change, color="0.4", linestyle="--", linewidth=0.8)
        axes.annotate(" light changes", (change, 1.02), annotation_clip=False)
    runs, frames = stacked(curves, models[0], "overlaps").shape
    axes.set(
        xlabel=f"frame ({runs} runs per model)",
        ylabel="IoU: mean, 10-90 %",
        ylim=(0, 1),
        xlim=(0, frames - 1),
    )
    bottom.legend(frameon=False, loc="outside lower center", ncols=3)


def _plot_mean(axes: Any, values: Floats, color: str, label: str) -> None:
    """The mean of values (R, M) over the runs, and their 10-90 % range."""
    plot_band(axes, values.mean(axis=0), values, color, label, ranks=(10, 90), alpha=0.2)
