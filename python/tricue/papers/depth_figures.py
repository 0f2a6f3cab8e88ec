# SPDX-License-Identifier: MIT
"""The depth experiment's figure: errors over time, beside a picture of the scene."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.draw.depth_pictures import depth_picture
from tricue.draw.figures import COLORS, draw_box
from tricue.papers.depth_curves import HALF, DepthCurve
from tricue.scenes import DepthScene

FLOOR, TOP = 0.005, 5.0  # metres, of the logarithmic plot
SHADE = "0.88"


def metric_curves(figure: Any, curves: Sequence[DepthCurve], scenes: Mapping[str, DepthScene]) -> None:
    """A row a scene: a frame with the true box, then position error and overlap of each model over time.

    Lines are medians over the seeds, bands reach from quartile to quartile. Shaded: in half of the runs or
    more the target is less than half visible.
    """
    models = list(dict.fromkeys(curve.model for curve in curves))
    figure.set_size_inches(13, 0.6 + 2.1 * len(scenes))
    rows = figure.subplots(len(scenes), 3, width_ratios=[1.1, 2, 2], squeeze=False)
    for (picture, error, overlap), (name, scene) in zip(rows, scenes.items(), strict=True):
        _picture(picture, scene, name)
        runs = [curve for curve in curves if curve.scene == name]
        for axes, values in ((error, "errors"), (overlap, "overlaps")):
            shade_hidden(axes, np.median([curve.visible for curve in runs], axis=0))
            for color, model in zip(COLORS, models, strict=False):
                chosen = np.stack([getattr(curve, values) for curve in runs if curve.model == model])
                _median_and_quartiles(axes, chosen, color, model)
        error.set(yscale="log", ylim=(FLOOR, TOP), ylabel="position error, m")
        overlap.set(ylim=(0, 1), ylabel="IoU")
    for axes in rows[-1, 1:]:
        axes.set_xlabel("frame (shaded: the target is less than half visible)")
    handles, labels = rows[0, 2].get_legend_handles_labels()
    figure.legend(handles, labels, frameon=False, loc="outside lower center", ncols=len(models))


def shade_hidden(axes: Any, visible: NDArray[np.float64]) -> None:
    """Shade the frames in which less than half of the target is visible, and set the axis of frames."""
    frames = np.arange(len(visible))
    place = {"transform": axes.get_xaxis_transform(), "step": "mid", "color": SHADE, "linewidth": 0}
    axes.fill_between(frames, 0, 1, where=visible < HALF, **place)
    axes.set_xlim(0, max(1, len(visible) - 1))


def _median_and_quartiles(axes: Any, values: NDArray[np.float64], color: str, label: str) -> None:
    """Lines of values (runs, frames); nothing where a run has no value."""
    low, middle, high = np.percentile(values, [25, 50, 75], axis=0)
    axes.fill_between(np.arange(values.shape[1]), low, high, color=color, alpha=0.15, linewidth=0)
    axes.plot(middle, color=color, linewidth=1.2, label=label)


def _picture(axes: Any, scene: DepthScene, title: str) -> None:
    """The frame a third of the way, for the middle one of a crossing hides the target."""
    index = len(scene.frames) // 3
    depth = scene.frames[index].depth
    assert depth is not None
    axes.imshow(depth_picture(depth)[..., ::-1])
    draw_box(axes, scene.boxes[index], "white")
    axes.set_title(title, loc="left")
    axes.axis("off")
