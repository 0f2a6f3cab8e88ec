# SPDX-License-Identifier: MIT
"""Figures 1 to 4 of Sabeti, Parvizi and Wu (2008): curves below pictures of the scenes.

In the pictures the trackers' boxes are solid, the true ones dashed.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue import kernels
from tricue.arrays import Floats
from tricue.draw.figures import COLORS, draw_box
from tricue.papers.curves import first_runs, models_of, stacked
from tricue.papers.plots import plot_band, shade_hidden, show_frame
from tricue.papers.sabeti_color.curves import MAX_CENTER_ERROR, MIN_FAST_STEP, ColorCurve
from tricue.scenes import Scene
from tricue.track.color_particle.params import ColorParticleParams
from tricue.track.color_particle.skin_detection import reference_color

PICTURES = 6  # per scene
SKIN_TINT = np.array([255, 0, 255])  # BGR, laid over skin pixels


def error_curves(figure: Any, curves: Sequence[ColorCurve], scenes: Mapping[str, Scene]) -> None:
    """Figure 1: the scenes with the first runs' boxes; each model's mean center error and 10-90 % range."""
    models = models_of(curves)
    columns = 4
    rows = -(-len(models) // columns)
    figure.set_size_inches(13, 2.6 + 2.3 * rows)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.8, 2.3 * rows])
    marked = _marked(models)
    for axes, (name, scene) in zip(np.ravel(top.subplots(1, len(scenes))), scenes.items(), strict=True):
        index = len(scene.frames) // 4
        show_frame(axes, scene.frames[index].color, f"{name}, frame {index}")
        axes.plot(*np.array([box.center for box in scene.boxes]).T, color="white", linewidth=0.6, alpha=0.7)
        _draw_boxes(axes, curves, name, scene, index, marked)
    _add_legend(top, marked)
    panels = bottom.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes, model in zip(panels.flat, models, strict=False):
        errors = stacked(curves, model, "errors")
        for other in models:
            axes.plot(stacked(curves, other, "errors").mean(axis=0), color="0.85", linewidth=0.8)
        _plot_mean(axes, errors, marked.get(model, COLORS[0]), model)
        axes.axhline(MAX_CENTER_ERROR, color="0.4", linestyle=":", linewidth=0.8)
        axes.set_title(
            f"{model}\n{errors.mean():.1f} px, {np.mean(errors > MAX_CENTER_ERROR):.1%} lost", loc="left"
        )
        axes.set(yscale="log", ylim=(0.3, 400), xlim=(0, errors.shape[1] - 1))
    for axes in panels.flat[len(models) :]:
        axes.set_visible(False)
    bottom.supxlabel(f"frame ({_runs(len(stacked(curves, models[0], 'errors')))})")
    bottom.supylabel("center error, px: mean, 10-90 %; dotted: lost")


def overlap_curves(figure: Any, curves: Sequence[ColorCurve], scenes: Mapping[str, Scene]) -> None:
    """Figure 2: frames around each change of light with the models' boxes; mean overlap, 10-90 % range."""
    models = models_of(curves)
    (name, scene), *_ = scenes.items()
    figure.set_size_inches(13, 6.5)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1, 2])
    indices = [index for change in scene.changes for index in (change - 1, change, change + 8)]
    colors = dict(zip(models, COLORS, strict=False))
    for axes, index in zip(np.ravel(top.subplots(1, len(indices))), indices, strict=True):
        show_frame(axes, scene.frames[index].color, f"frame {index}")
        _draw_boxes(axes, curves, name, scene, index, colors)
    axes = bottom.subplots()
    for model, color in colors.items():
        overlaps = stacked(curves, model, "overlaps")
        label = f"{model}: {np.mean(overlaps > 0.5):.1%} above 0.5"
        _plot_mean(axes, overlaps, color, label)
    for change in scene.changes:
        axes.axvline(change, color="0.4", linestyle="--", linewidth=0.8)
        axes.annotate(" light changes", (change, 1.02), annotation_clip=False)
    runs, frames = stacked(curves, models[0], "overlaps").shape
    axes.set(
        xlabel=f"frame ({_runs(runs)}); pictures: boxes of the first run, the true one dashed",
        ylabel="IoU: mean, 10-90 %",
        ylim=(0, 1),
        xlim=(0, frames - 1),
    )
    bottom.legend(frameon=False, loc="outside lower center", ncols=3)


def scene_curves(figure: Any, curves: Sequence[ColorCurve], scenes: Mapping[str, Scene]) -> None:
    """Figures 3 and 4, for each scene: frames with the models' boxes; the median overlap and the quartiles.

    Scenes in which the target is hidden have their skin pixels tinted, as in the paper. Shaded: less than
    half of the target is visible in at least half of the runs, or it is fast in the first run.
    """
    models = models_of(curves)
    colors = dict(zip(models, COLORS, strict=False))
    marked = _marked(models)
    figure.set_size_inches(14, 0.5 + 4.4 * len(scenes))
    for part, (name, scene) in zip(np.ravel(figure.subfigures(len(scenes), 1)), scenes.items(), strict=True):
        top, bottom = part.subfigures(2, 1, height_ratios=[1, 1.25])
        indices = _chosen_frames(scene, curves, name)
        for axes, index in zip(np.ravel(top.subplots(1, len(indices))), indices, strict=True):
            image = scene.frames[index].color
            assert image is not None
            title = f"frame {index}"
            if scene.visible:
                skin = _skin_mask(image, scene)
                image = np.where(skin[..., None], image * 0.6 + 0.4 * SKIN_TINT, image).astype(np.uint8)
                title += f", {skin.sum():,} skin px"
            show_frame(axes, image, title)
            _draw_boxes(axes, curves, name, scene, index, marked)
        axes = bottom.subplots()
        _plot_overlaps(axes, [curve for curve in curves if curve.scene == name], name, scene, colors)
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(
        handles,
        labels,
        frameon=False,
        loc="outside upper center",
        ncols=len(models),
        title="pictures: boxes of the first run, default and as printed; the true one dashed",
    )


def _plot_overlaps(
    axes: Any, runs: Sequence[ColorCurve], name: str, scene: Scene, colors: Mapping[str, str]
) -> None:
    """Draw each model's median overlap and quartiles, and shade frames: hidden ones, or else fast ones."""
    for model, color in colors.items():
        overlaps = stacked(runs, model, "overlaps")
        plot_band(axes, np.median(overlaps, axis=0), overlaps, color, model, alpha=0.1)
    shown, shade = np.median([run.visible for run in runs], axis=0), "less than half is visible"
    if not scene.visible:
        shown, shade = 1.0 - (runs[0].steps > MIN_FAST_STEP), f"seed 0 moves > {MIN_FAST_STEP:.0f} px"
    shade_hidden(axes, shown)
    count = sum(run.model == runs[0].model for run in runs)
    note = f"; shaded: {shade}" if shown.min() < 1 else ""
    axes.set(xlabel=f"{name}: frame ({_runs(count)}{note})", ylim=(0, 1))
    axes.set_ylabel("IoU: median, quartiles")


def _runs(count: int) -> str:
    """How many runs each model has, in words."""
    return f"{count} run{'' if count == 1 else 's'} per model"


def _marked(models: Sequence[str]) -> dict[str, str]:
    """The models, if there are many, whose boxes are shown, and their colors: default and printed form."""
    colors = dict(zip(models, COLORS, strict=False))
    return {model: colors[model] for model in (models[0], "as printed") if model in colors}


def _draw_boxes(
    axes: Any,
    curves: Sequence[ColorCurve],
    name: str,
    scene: Scene,
    index: int,
    colors: Mapping[str, str],
) -> None:
    first = first_runs(curves, name)
    for model, color in colors.items():
        draw_box(axes, first[model].boxes[index], color)
    draw_box(axes, scene.boxes[index], "white", linestyle="dashed")


def _add_legend(figure: Any, colors: Mapping[str, str]) -> None:
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], color=color, label=model) for model, color in colors.items()]
    handles.append(Line2D([], [], color="0.6", linestyle="dashed", label="true box (white)"))
    figure.legend(handles=handles, frameon=False, loc="outside lower center", ncols=len(handles))


def _chosen_frames(scene: Scene, curves: Sequence[ColorCurve], name: str) -> list[int]:
    """Representative frames: around the occlusions, in the fastest motion, else evenly spread."""
    last = len(scene.frames) - 1
    if scene.visible:
        visible = np.array(scene.visible)
        covered = np.flatnonzero(visible < 0.5)
        if len(covered):
            gap = np.flatnonzero(np.diff(covered) > 1)
            stop = int(covered[gap[0]] if len(gap) else covered[-1])
            start = int(covered[0])
            again = int(covered[gap[0] + 1]) if len(gap) else stop
            picks = [start // 2, start, (start + stop) // 2, stop + 1, again + 2, last]
            return [min(max(pick, 0), last) for pick in picks]
    steps = next(curve.steps for curve in curves if (curve.scene, curve.seed) == (name, 0))
    if steps.max() > MIN_FAST_STEP and last >= PICTURES:
        windows = np.convolve(steps, np.ones(PICTURES), mode="valid")
        start = int(windows.argmax())
        return list(range(start, start + PICTURES))
    return [round(share * last / (PICTURES - 1)) for share in range(PICTURES)]


def _skin_mask(image: NDArray[np.uint8], scene: Scene) -> NDArray[np.bool_]:
    """The skin pixels (H, W) of an image by (10), with the color of the first frame's target."""
    k = kernels.load("native")
    start = scene.frames[0].color
    assert start is not None
    reference = reference_color(k, start, scene.boxes[0].ellipse)
    return np.asarray(k.skin_boundary(image, reference) > 255 * ColorParticleParams().skin_threshold)


def _plot_mean(axes: Any, values: Floats, color: str, label: str) -> None:
    """Draw the mean of values (R, M) over the runs, and their 10-90 % range."""
    plot_band(axes, values.mean(axis=0), values, color, label, ranks=(10, 90), alpha=0.2)
