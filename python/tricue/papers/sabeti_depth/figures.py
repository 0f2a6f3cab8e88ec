# SPDX-License-Identifier: MIT
"""Figures 5 to 7: frames with the trackers' boxes, and position errors and overlaps over time."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tricue.arrays import Floats
from tricue.draw.depth_pictures import depth_picture
from tricue.draw.figures import COLORS, draw_box
from tricue.papers.curves import MIN_VISIBLE, first_runs, models_of, stacked
from tricue.papers.plots import plot_band, shade_hidden, show_frame
from tricue.papers.sabeti_depth.curves import DepthCurve
from tricue.scenes import DepthScene

ERROR_RANGE = 0.005, 5.0  # meters, of the logarithmic axis
FIGURES = {"pose and scale": "Fig. 5", "hidden": "Fig. 6", "hidden, 0.5 m farther": "Fig. 7"}
MODELS_SHOWN = ("default", "as printed")  # in the frames, if they ran; otherwise all
FRAMES_SHOWN = 6
MODEL_COLORS = (COLORS[5], *COLORS[1:5])  # the first is visible on dark pictures, too
TRUTH_COLOR = "white"


def frames_and_curves(figure: Any, curves: Sequence[DepthCurve], scenes: Mapping[str, DepthScene]) -> None:
    """Above, a row of frames for each of the paper's figures. Below, error and overlap in each scene.

    In the frames: the truth is dashed, the boxes of seed 0 are solid. Lines are medians over the seeds, bands
    the quartiles. Shaded: in at least half of the runs the target is less than half visible.
    """
    models = models_of(curves)
    colors = dict(zip(models, MODEL_COLORS, strict=False))
    shown = [name for name in scenes if name in FIGURES]
    heights = 1.75 * len(shown), 0.5 + 1.5 * len(scenes)
    figure.set_size_inches(13, sum(heights))
    top, bottom = figure.subfigures(2, 1, height_ratios=heights)
    for row, name in zip(top.subplots(len(shown), FRAMES_SHOWN, squeeze=False), shown, strict=True):
        _draw_frames(row, name, scenes[name], first_runs(curves, name), colors)
    top.supxlabel(f"dashed: the truth; solid: {' and '.join(MODELS_SHOWN)}, seed 0", fontsize=9)
    rows = bottom.subplots(len(scenes), 2, sharex=True, squeeze=False)
    for (error, overlap), name in zip(rows, scenes, strict=True):
        runs = [curve for curve in curves if curve.scene == name]
        for axes, values in ((error, "errors"), (overlap, "overlaps")):
            shade_hidden(axes, np.median([curve.visible for curve in runs], axis=0))
            for model, color in colors.items():
                chosen = stacked(runs, model, values)
                plot_band(axes, np.percentile(chosen, 50, axis=0), chosen, color, model, linewidth=1.2)
        error.set_title(name, loc="left")
        error.set(yscale="log", ylim=ERROR_RANGE, ylabel="position error, m")
        overlap.set(ylim=(0, 1), ylabel="IoU")
    for axes in rows[-1]:
        axes.set_xlabel("frame (shaded: the target is less than half visible)")
    handles, labels = rows[0, 1].get_legend_handles_labels()
    bottom.legend(handles, labels, frameon=False, loc="outside lower center", ncols=len(models))


def _draw_frames(
    row: Any, name: str, scene: DepthScene, runs: Mapping[str, DepthCurve], colors: Mapping[str, str]
) -> None:
    """Draw frames of a scene with the true box and the boxes of one run of each shown model."""
    chosen = [model for model in MODELS_SHOWN if model in runs] or list(runs)
    for axes, index in zip(row, choose_frames(scene.visible), strict=True):
        depth = scene.frames[index].depth
        assert depth is not None
        first = axes is row[0]
        show_frame(axes, depth_picture(depth), f"{FIGURES[name]}, {name}" if first else f"frame {index}")
        height, width = depth.shape
        axes.set(xlim=(-0.5, width - 0.5), ylim=(height - 0.5, -0.5))
        for model in chosen:
            draw_box(axes, runs[model].boxes[index], colors[model])
        draw_box(axes, scene.boxes[index], TRUTH_COLOR, "dashed")


def choose_frames(visible: Floats) -> list[int]:
    """FRAMES_SHOWN representative frames, from the first to the last.

    visible: (M,) visible share of the target. If it is ever hidden, they include the frame before that, the
    middle of it, and one five frames after it. Otherwise they are evenly spaced.
    """
    last = len(visible) - 1
    even = [round(index) for index in np.linspace(0, last, FRAMES_SHOWN).tolist()]
    hidden = np.flatnonzero(visible < MIN_VISIBLE)
    if len(hidden) == 0 or hidden[0] == 0:
        return even
    first = int(hidden[0])
    seen = np.flatnonzero(visible[first:] >= MIN_VISIBLE)
    back = first + int(seen[0]) if len(seen) else last
    return [0, first // 2, first - 1, (first + back) // 2, min(back + 5, last), last]
