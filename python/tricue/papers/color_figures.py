# SPDX-License-Identifier: MIT
"""Figures 1 and 2 of Sabeti, Parvizi and Wu (2008): error curves beside pictures of the scenes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.draw.figures import COLORS, draw_box
from tricue.papers.curves import LOST, Curve
from tricue.scenes import Scene


def error_curves(figure: Any, curves: Sequence[Curve], scenes: Mapping[str, Scene]) -> None:
    """Figure 1: the scenes with the true paths; each model's mean center error and its 10-90 % range."""
    models = list(dict.fromkeys(curve.model for curve in curves))
    columns = 4
    rows = -(-len(models) // columns)
    figure.set_size_inches(13, 2.4 + 2.5 * rows)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.6, 2.4 * rows])
    for axes, (name, scene) in zip(np.ravel(top.subplots(1, len(scenes))), scenes.items(), strict=True):
        _picture(axes, scene, len(scene.frames) // 4, name)
        axes.plot(*np.array([box.center for box in scene.boxes]).T, color="white", linewidth=1)
    panels = bottom.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes, model in zip(panels.flat, models, strict=False):
        errors = _stack(curves, model, "errors")
        for other in models:
            axes.plot(_stack(curves, other, "errors").mean(axis=0), color="0.85", linewidth=0.8)
        _mean_and_range(axes, errors, COLORS[0], model)
        axes.axhline(LOST, color="0.4", linestyle=":", linewidth=0.8)
        axes.set_title(f"{model}: {errors.mean():.1f} px, {np.mean(errors > LOST):.1%} lost", loc="left")
        axes.set(yscale="log", ylim=(0.3, 400), xlim=(0, errors.shape[1] - 1))
    for axes in panels.flat[len(models) :]:
        axes.set_visible(False)
    bottom.supxlabel(f"frame ({len(_stack(curves, models[0], 'errors'))} runs a model)")
    bottom.supylabel("center error, px: mean, 10-90 %")


def overlap_curves(figure: Any, curves: Sequence[Curve], scenes: Mapping[str, Scene]) -> None:
    """Figure 2: frames round the changes of light with each model's box; mean overlap, its 10-90 % range."""
    models = list(dict.fromkeys(curve.model for curve in curves))
    (name, scene), *_ = scenes.items()
    first = {curve.model: curve for curve in curves if (curve.scene, curve.seed) == (name, 0)}
    figure.set_size_inches(11, 6)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1, 2.6])
    shown = [index for change in scene.changes for index in (change - 1, change, change + 8)]
    for axes, index in zip(np.ravel(top.subplots(1, len(shown))), shown, strict=True):
        _picture(axes, scene, index, f"frame {index}")
        for color, model in zip(COLORS, models, strict=False):
            draw_box(axes, first[model].boxes[index], color)
    axes = bottom.subplots()
    for color, model in zip(COLORS, models, strict=False):
        overlaps = _stack(curves, model, "overlaps")
        label = f"{model}: {np.mean(overlaps > 0.5):.1%} above 0.5"
        _mean_and_range(axes, overlaps, color, label)
    for change in scene.changes:
        axes.axvline(change, color="0.4", linestyle="--", linewidth=0.8)
        axes.annotate(" light changes", (change, 1.02), annotation_clip=False)
    runs, frames = _stack(curves, models[0], "overlaps").shape
    axes.set(
        xlabel=f"frame ({runs} runs a model)", ylabel="IoU: mean, 10-90 %", ylim=(0, 1), xlim=(0, frames - 1)
    )
    bottom.legend(frameon=False, loc="outside lower center", ncols=3)


def _stack(curves: Sequence[Curve], model: str, values: str) -> NDArray[np.float64]:
    return np.stack([getattr(curve, values) for curve in curves if curve.model == model])


def _mean_and_range(axes: Any, values: NDArray[np.float64], color: str, label: str) -> None:
    low, high = np.percentile(values, [10, 90], axis=0)
    axes.fill_between(np.arange(values.shape[1]), low, high, color=color, alpha=0.2, linewidth=0)
    axes.plot(values.mean(axis=0), color=color, linewidth=1.4, label=label)


def _picture(axes: Any, scene: Scene, index: int, title: str) -> None:
    color = scene.frames[index].color
    assert color is not None
    axes.imshow(color[..., ::-1])
    axes.set_title(title, loc="left")
    axes.axis("off")
