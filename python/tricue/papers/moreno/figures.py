# SPDX-License-Identifier: MIT
"""Paths, deviations and times of the head's scenes, after figure 3 of Moreno et al. (2002)."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from tricue.draw.figures import COLORS, draw_box
from tricue.papers.moreno.curves import (
    FUSED,
    PAPERS_FILTER,
    TIMED_MODULES,
    UNFUSED,
    StereoCurve,
    module_seconds,
)
from tricue.papers.plots import show_frame
from tricue.scenes import StereoScene

NORMAL, NOISY, LARGE = "normal", "normal, 0.3 px noise", "normal, 640x480"
SIZES = {NORMAL: "160x120", LARGE: "640x480"}
TRUTH_COLOR = "black"
MODEL_COLORS = {FUSED: COLORS[0], UNFUSED: COLORS[1], PAPERS_FILTER: COLORS[2]}


class HasScene(Protocol):
    """Whatever has a scene for the figure to show."""

    @property
    def scene(self) -> StereoScene: ...


def paths(figure: Any, curves: Sequence[StereoCurve], scenes: Mapping[str, HasScene]) -> None:
    """Frames of the scenes; paths from above, deviations along the path, and time per module.

    Paths and deviations are those of the first seed.
    """
    figure.set_size_inches(15, 7.5)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1, 2.4])
    pictures = top.subplots(1, len(scenes), squeeze=False)[0]
    for axes, (name, trial) in zip(pictures, scenes.items(), strict=True):
        _picture(axes, trial.scene, name)
    still, noisy, along, times = bottom.subplots(1, 4, width_ratios=[1, 1, 1.2, 1])
    first = {(curve.scene, curve.model): curve for curve in curves if curve.seed == 0}
    for axes, name in ((still, NORMAL), (noisy, NOISY)):
        _from_above(axes, first, name)
    _deviations(along, first)
    _times(times, curves)


def _picture(axes: Any, scene: StereoScene, title: str) -> None:
    index = len(scene.frames) // 2
    show_frame(axes, scene.frames[index].color, title)
    draw_box(axes, scene.boxes[index], "white")


def _from_above(axes: Any, first: Mapping[tuple[str, str], StereoCurve], scene: str) -> None:
    """(a): X to the right, Z away from the cameras."""
    for model in (UNFUSED, FUSED):
        curve = first.get((scene, model))
        if curve is not None:
            x, _, z = curve.positions.T
            axes.plot(x, z, color=MODEL_COLORS[model], linewidth=1, label=model)
    truth = next(curve.truth for (name, _), curve in first.items() if name == scene)
    axes.plot(truth[:, 0], truth[:, 2], color=TRUTH_COLOR, linewidth=1, linestyle=":", label="true")
    axes.set(xlabel="X, m", ylabel="Z, m", aspect="equal", adjustable="datalim")
    axes.set_title(f"path from above: {scene}", loc="left")
    axes.legend(frameon=False)


def _deviations(axes: Any, first: Mapping[tuple[str, str], StereoCurve]) -> None:
    """(b): the standard deviations that the filters estimate, and the fused track's true error."""
    for model, label in ((UNFUSED, "measured"), (FUSED, FUSED), (PAPERS_FILTER, PAPERS_FILTER)):
        curve = first.get((NORMAL, model))
        if curve is not None:
            axes.plot(100 * curve.deviations, color=MODEL_COLORS[model], linewidth=1.2, label=label)
    curve = first.get((NORMAL, FUSED))
    if curve is not None:
        off = 100 * np.linalg.norm(curve.positions - curve.truth, axis=1)
        axes.plot(off, color="0.7", linewidth=0.8, label=f"true error of {FUSED}")
        axes.set(yscale="log")
        axes.legend(frameon=False)
    axes.set(xlabel="frame", ylabel="standard deviation, cm")
    axes.set_title(f"root of the variance along the path: {NORMAL}", loc="left")


def _times(axes: Any, curves: Sequence[StereoCurve]) -> None:
    """(d): of the first model, the default."""
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
    axes.set_title("time per module", loc="left")
    axes.legend(frameon=False, ncols=len(TIMED_MODULES), loc="lower center", fontsize=7)
