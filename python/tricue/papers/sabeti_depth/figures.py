# SPDX-License-Identifier: MIT
"""Position errors and overlaps over time, beside a picture of each scene."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tricue.draw.depth_pictures import depth_picture
from tricue.draw.figures import COLORS, draw_box
from tricue.papers.curves import models_of, stacked
from tricue.papers.plots import plot_band, shade_hidden, show_frame
from tricue.papers.sabeti_depth.curves import DepthCurve
from tricue.scenes import DepthScene

ERROR_RANGE = 0.005, 5.0  # meters, of the logarithmic axis


def metric_curves(figure: Any, curves: Sequence[DepthCurve], scenes: Mapping[str, DepthScene]) -> None:
    """A row per scene: a frame with the true box, then position error and overlap of each model over time.

    Lines are medians over the seeds, bands the quartiles. Shaded: in at least half of the runs the target is
    less than half visible.
    """
    models = models_of(curves)
    figure.set_size_inches(13, 0.6 + 2.1 * len(scenes))
    rows = figure.subplots(len(scenes), 3, width_ratios=[1.1, 2, 2], squeeze=False)
    for (picture, error, overlap), (name, scene) in zip(rows, scenes.items(), strict=True):
        _picture(picture, scene, name)
        runs = [curve for curve in curves if curve.scene == name]
        for axes, values in ((error, "errors"), (overlap, "overlaps")):
            shade_hidden(axes, np.median([curve.visible for curve in runs], axis=0))
            for color, model in zip(COLORS, models, strict=False):
                chosen = stacked(runs, model, values)
                plot_band(axes, np.percentile(chosen, 50, axis=0), chosen, color, model, linewidth=1.2)
        error.set(yscale="log", ylim=ERROR_RANGE, ylabel="position error, m")
        overlap.set(ylim=(0, 1), ylabel="IoU")
    for axes in rows[-1, 1:]:
        axes.set_xlabel("frame (shaded: the target is less than half visible)")
    handles, labels = rows[0, 2].get_legend_handles_labels()
    figure.legend(handles, labels, frameon=False, loc="outside lower center", ncols=len(models))


def _picture(axes: Any, scene: DepthScene, title: str) -> None:
    """The frame at a third of the scene: in the middle of a crossing the target is hidden."""
    index = len(scene.frames) // 3
    depth = scene.frames[index].depth
    assert depth is not None
    show_frame(axes, depth_picture(depth), title)
    draw_box(axes, scene.boxes[index], "white")
