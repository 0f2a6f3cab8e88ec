# SPDX-License-Identifier: MIT
"""Paths, deviations, frames and times of the head's scenes, after figure 3 of Moreno et al. (2002)."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from tricue.draw.figures import COLORS
from tricue.papers.moreno.curves import (
    FUSED,
    PRINTED,
    PRINTED_UNFUSED,
    UNFUSED,
    StereoCurve,
    module_seconds,
)
from tricue.papers.plots import show_frame
from tricue.scenes import StereoScene

NORMAL, NOISY, LARGE = "normal", "normal, 0.3 px noise", "normal, 640x480"
SIZES = {NORMAL: "160x120", LARGE: "640x480"}
TRUTH_COLOR = "black"
MODEL_COLORS = {FUSED: COLORS[0], UNFUSED: COLORS[5], PRINTED: COLORS[1], PRINTED_UNFUSED: COLORS[4]}
MOMENTS = (0.25, 0.55, 0.9)
"""The moments at which a scene is shown, as shares of its frames."""

LEGEND_ROOM = 0.25
"""Of (b), below the curves, as a share of their range in decades."""

SHOWN = 0.6
"""Shown share of the image's width and height, around the head."""


class HasScene(Protocol):
    """Anything with a scene for the figure to show."""

    @property
    def scene(self) -> StereoScene: ...


Runs = Mapping[tuple[str, str], StereoCurve]
"""The curves of the first seed, by scene and model."""


def paths(figure: Any, curves: Sequence[StereoCurve], scenes: Mapping[str, HasScene]) -> None:
    """Frames of the scenes with the tracker's ellipses; paths from above, deviations, and time per module.

    All are from the first seed.
    """
    figure.set_size_inches(18, 10.5)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.15, 1])
    first = {(curve.scene, curve.model): curve for curve in curves if curve.seed == 0}
    pictures = top.subplots(len(MOMENTS), len(scenes), squeeze=False)
    for column, (name, trial) in zip(pictures.T, scenes.items(), strict=True):
        for axes, moment in zip(column, MOMENTS, strict=True):
            _picture(axes, trial.scene, first, name, round(moment * (len(trial.scene.frames) - 1)))
        column[0].annotate(name, (0, 1.2), xycoords="axes fraction", weight="bold")
    top.suptitle(
        f"(c) tracker's ellipse and depth: blue {FUSED}, orange {PRINTED}, white dashed true",
        x=0.01,
        ha="left",
    )
    ours, printed, noisy, along, times = bottom.subplots(1, 5, width_ratios=[1, 1, 1, 1.2, 1])
    _from_above(ours, first, NORMAL, (UNFUSED, FUSED))
    _from_above(printed, first, NORMAL, (PRINTED_UNFUSED, PRINTED))
    _from_above(noisy, first, NOISY, (UNFUSED, FUSED))
    _deviations(along, first)
    _times(times, curves)


def _picture(axes: Any, scene: StereoScene, first: Runs, name: str, index: int) -> None:
    """(c): a frame with the ellipses of two models, and their depths."""
    show_frame(axes, scene.frames[index].color, "")
    _draw_ellipse(axes, scene.boxes[index], "white", "--")
    depths = [f"{scene.positions[index, 2]:.2f} true"]
    for model, label in ((FUSED, "default"), (PRINTED, "printed")):
        curve = first.get((name, model))
        if curve is not None:
            _draw_ellipse(axes, curve.boxes[index], MODEL_COLORS[model])
            depths.append(f"{curve.positions[index, 2]:.2f} {label}")
    axes.set_title(f"Z {', '.join(depths)} m", loc="left", fontsize=6.5)
    camera = scene.rig.intrinsics
    x, y = scene.boxes[index].center
    for limits, center, size in ((axes.set_xlim, x, camera.width), (axes.set_ylim, y, camera.height)):
        low = min(max(center - SHOWN / 2 * size, 0), (1 - SHOWN) * size) - 0.5
        limits(low, low + SHOWN * size)
    axes.invert_yaxis()


def _draw_ellipse(axes: Any, box: ArrayLike, color: str, linestyle: str = "-") -> None:
    """Outline the ellipse inscribed in a box (x, y, width, height); pixel (i, j) has its center at (j, i)."""
    from matplotlib.patches import Ellipse

    x, y, width, height = np.asarray(box, np.float64).tolist()
    center = x + width / 2 - 0.5, y + height / 2 - 0.5
    axes.add_patch(
        Ellipse(center, width, height, fill=False, edgecolor=color, linewidth=1.1, linestyle=linestyle)
    )


def _from_above(axes: Any, first: Runs, scene: str, models: Sequence[str]) -> None:
    """(a): X to the right, Z away from the cameras."""
    for model in models:
        curve = first.get((scene, model))
        if curve is not None:
            x, _, z = curve.positions.T
            axes.plot(x, z, color=MODEL_COLORS[model], linewidth=1, label=model)
    truth = next(curve.truth for (name, _), curve in first.items() if name == scene)
    axes.plot(truth[:, 0], truth[:, 2], color=TRUTH_COLOR, linewidth=1, linestyle=":", label="true")
    axes.set(xlabel="X, m", ylabel="Z, m", aspect="equal", adjustable="datalim")
    axes.set_title(f"(a) path from above: {scene}", loc="left")
    axes.legend(frameon=False, fontsize=7)


def _deviations(axes: Any, first: Runs) -> None:
    """(b): the standard deviations that the filters estimate, and the true errors."""
    labels = {
        UNFUSED: "measured, default",
        FUSED: FUSED,
        PRINTED_UNFUSED: "measured, as printed",
        PRINTED: PRINTED,
    }
    for model, label in labels.items():
        curve = first.get((NORMAL, model))
        if curve is None:
            continue
        axes.plot(100 * curve.deviations, color=MODEL_COLORS[model], linewidth=1.4, label=label)
        if model in (FUSED, PRINTED):
            off = 100 * np.linalg.norm(curve.positions - curve.truth, axis=1)
            style = {"color": MODEL_COLORS[model], "linewidth": 0.8, "linestyle": ":"}
            axes.plot(off, **style, label=f"true error, {label}")
    axes.set(yscale="log", xlabel="frame", ylabel="standard deviation, true error, cm")
    if axes.lines:
        low, high = axes.get_ylim()
        axes.set_ylim(low * (low / high) ** LEGEND_ROOM, high)
        axes.legend(frameon=False, fontsize=7, loc="lower right", ncols=2)
    axes.set_title(f"(b) root of the variance along the path: {NORMAL}", loc="left")


def _times(axes: Any, curves: Sequence[StereoCurve]) -> None:
    """(d): the times of the first model, the default."""
    model, known = curves[0].model, {curve.scene for curve in curves}
    sizes = {name: size for name, size in SIZES.items() if name in known}
    for row, scene in enumerate(sizes):
        left = 0.0
        modules = module_seconds(curves, scene, model)
        for color, (name, seconds) in zip(COLORS, modules.items(), strict=False):
            label = name if row == 0 else None
            axes.barh(row, 1e6 * seconds, left=left, color=color, height=0.5, label=label)
            left += 1e6 * seconds
        axes.annotate(f" {left:.0f}", (left, row), va="center")
    axes.set(yticks=range(len(sizes)), yticklabels=sizes.values(), xlabel="us per frame")
    axes.invert_yaxis()
    axes.margins(x=0.2, y=0.3)
    axes.set_title(f"(d) time per module, {model}", loc="left")
    axes.legend(frameon=False, ncols=2, loc="lower center", fontsize=7)
