# SPDX-License-Identifier: MIT
"""Frames in color and depth with boxes, overlaps while the light changes, and overlaps by range."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tricue.arrays import Floats
from tricue.draw.depth_pictures import depth_picture
from tricue.draw.figures import COLORS, draw_box
from tricue.papers.curves import first_runs, models_of, stacked
from tricue.papers.plots import plot_band, show_frame
from tricue.papers.sabeti_dark.curves import LitCurve
from tricue.papers.sabeti_dark.names import DUSK, HEAD_MODELS, RANGE_SCENES, SUNRISE
from tricue.scenes import LitScene

FRAMES_SHOWN = 6
MODEL_COLORS = (COLORS[4], COLORS[7], COLORS[5], COLORS[3], COLORS[2])  # visible on dark pictures, too
TRUTH_COLOR = "white"
NEAREST, FARTHEST = 0.5, 9.0  # meters, of the brightest and the darkest color of depth


def light_and_range(figure: Any, curves: Sequence[LitCurve], scenes: Mapping[str, LitScene]) -> None:
    """Dusk in color and depth, deep halls in depth, and below them overlaps by light and by range.

    In the frames: the truth is dashed, the boxes of seed 0 are solid. Lines over time are means over the
    seeds, bands the quartiles.
    """
    colors = dict(zip(models_of(curves), MODEL_COLORS, strict=False))
    figure.set_size_inches(13, 10.5)
    top, bottom = figure.subfigures(2, 1, height_ratios=[6.4, 3.6])
    color_row, depth_row, range_row = top.subplots(3, FRAMES_SHOWN)
    dusk = scenes[DUSK]
    runs = first_runs(curves, DUSK)
    indices = np.linspace(0, len(dusk.frames) - 1, FRAMES_SHOWN).round().astype(int).tolist()
    for color_axes, depth_axes, index in zip(color_row, depth_row, indices, strict=True):
        title = f"{DUSK}: light {_two_digits(dusk.light[index])}"
        show_frame(color_axes, dusk.frames[index].color, title)
        _show_depth(depth_axes, dusk, index, "the same in depth")
        _draw_boxes(color_axes, dusk, index, runs, colors)
        _draw_boxes(
            depth_axes, dusk, index, {name: runs[name] for name in runs if name not in HEAD_MODELS}, colors
        )
    for axes, name in zip(range_row, RANGE_SCENES, strict=True):
        index = len(scenes[name].frames) * 2 // 3
        _show_depth(axes, scenes[name], index, name)
        _draw_boxes(axes, scenes[name], index, first_runs(curves, name), colors, heads=False)
    dusk_axes, sun_axes, range_axes = bottom.subplots(1, 3, width_ratios=[1, 1, 1])
    for axes, name in ((dusk_axes, DUSK), (sun_axes, SUNRISE)):
        _plot_light(axes, curves, name, scenes[name].light, colors)
    _plot_ranges(range_axes, curves, colors)
    handles, labels = dusk_axes.get_legend_handles_labels()
    title = "boxes: dashed the truth, solid the trackers, seed 0"
    bottom.legend(handles, labels, frameon=False, loc="outside lower center", ncols=len(colors), title=title)


def _show_depth(axes: Any, scene: LitScene, index: int, title: str) -> None:
    depth = scene.frames[index].depth
    assert depth is not None
    show_frame(axes, depth_picture(depth, NEAREST, FARTHEST), title)


def _draw_boxes(
    axes: Any,
    scene: LitScene,
    index: int,
    runs: Mapping[str, LitCurve],
    colors: Mapping[str, str],
    heads: bool = True,
) -> None:
    """Draw the boxes of one run of each model, and the corresponding true boxes."""
    camera = scene.intrinsics
    axes.set(xlim=(-0.5, camera.width - 0.5), ylim=(camera.height - 0.5, -0.5))
    for name, run in runs.items():
        if heads or name not in HEAD_MODELS:
            draw_box(axes, run.boxes[index], colors[name])
    draw_box(axes, scene.boxes[index], TRUTH_COLOR, "dashed")
    if heads and any(name in runs for name in HEAD_MODELS):
        draw_box(axes, scene.heads[index], TRUTH_COLOR, "dashed")


def _plot_light(
    axes: Any, curves: Sequence[LitCurve], name: str, light: Floats, colors: Mapping[str, str]
) -> None:
    """Draw mean overlaps over the frames of a scene, with ticks that give the light."""
    of_scene = [curve for curve in curves if curve.scene == name]
    for model, color in colors.items():
        overlaps = stacked(of_scene, model, "overlaps")
        plot_band(axes, overlaps.mean(axis=0), overlaps, color, model)
    ticks = np.linspace(0, len(light) - 1, 7).round().astype(int)
    axes.set_xticks(ticks, [_two_digits(light[tick]) for tick in ticks])
    axes.set(
        xlabel="light (1: indoors)", ylabel="IoU: mean, quartiles", ylim=(0, 1), xlim=(0, len(light) - 1)
    )
    axes.set_title(name, loc="left")


def _plot_ranges(axes: Any, curves: Sequence[LitCurve], colors: Mapping[str, str]) -> None:
    """Draw mean overlaps by the unambiguous range; dotted: with the amplitude check."""
    for model, color in colors.items():
        for checked, style in ((False, "o-"), (True, "o:")):
            names = [name for name, (_, least) in RANGE_SCENES.items() if (least > 0) == checked]
            means = [
                stacked([curve for curve in curves if curve.scene == name], model, "overlaps").mean()
                for name in names
            ]
            axes.plot([RANGE_SCENES[name][0] for name in names], means, style, color=color, markersize=4)
    axes.set_xticks(sorted({meters for meters, _ in RANGE_SCENES.values()}))
    axes.set(xlabel="unambiguous range, m (dotted: dark pixels discarded)", ylabel="mean IoU", ylim=(0, 1))
    axes.set_title("a hall of 10.5 m", loc="left")


def _two_digits(value: float) -> str:
    """A number with two digits, such as 100, not 1e+02."""
    return f"{float(f'{value:.2g}'):g}"
