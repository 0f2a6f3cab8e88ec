# SPDX-License-Identifier: MIT
"""Frames of a camera that follows its target, and the pan angles of both."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tricue.draw.figures import COLORS, draw_box
from tricue.papers.curves import MIN_VISIBLE, first_runs, models_of
from tricue.papers.okada.following_curves import FollowCurve
from tricue.papers.plots import shade_frames
from tricue.scenes import PanTiltScene

SHOWN_FRAMES = 7
TRUTH_COLOR = "white"


def key_frames(frames: int) -> tuple[int, ...]:
    """The frames in the figure, evenly spread."""
    return tuple(sorted({round(share * (frames - 1)) for share in np.linspace(0.02, 1, SHOWN_FRAMES)}))


def frames_and_angles(figure: Any, curves: Sequence[FollowCurve], scenes: Mapping[str, PanTiltScene]) -> None:
    """Seed 0. Above, the camera's view in the second scene, a row per tracker: its box solid, the true one
    dashed, and lines around the middle third. Below, the pan angles of target and camera over time in each
    scene.
    """
    models = models_of(curves)
    figure.set_size_inches(14, 1.75 * len(models) + 3.4)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.75 * len(models), 3.4])
    shown = list(scenes)[min(1, len(scenes) - 1)]
    first = first_runs(curves, shown)
    frames = key_frames(scenes[shown].frames)
    rows = top.subplots(len(models), len(frames), squeeze=False)
    for color, row, model in zip(COLORS, rows, models, strict=False):
        for axes, index in zip(row, frames, strict=True):
            _picture(axes, first[model], index, color)
        row[0].set_ylabel(model, color=color)
    for axes, index in zip(rows[0], frames, strict=True):
        axes.set_title(f"{index / scenes[shown].rate:.1f} s", loc="left")
    top.suptitle(
        f"{shown}, seed 0: tracker's box solid, true box dashed; lines: the middle third", fontsize=9
    )
    panels = bottom.subplots(1, len(scenes), sharey=True, squeeze=False)[0]
    for axes, (name, scene) in zip(panels, scenes.items(), strict=True):
        _angles(axes, first_runs(curves, name), models, scene)
        axes.set_title(name, loc="left")
        axes.set_xlabel("s (shaded: the target is less than half visible)")
    panels[0].set_ylabel("pan, degrees")
    handles, labels = panels[0].get_legend_handles_labels()
    bottom.legend(handles, labels, frameon=False, loc="outside lower center", ncols=len(labels))


def _picture(axes: Any, curve: FollowCurve, index: int, color: str) -> None:
    image, box, truth = curve.frames[index]
    axes.imshow(image[..., ::-1])
    height, width = image.shape[:2]
    for share in (1 / 3, 2 / 3):
        axes.axvline(share * width - 0.5, color="white", linewidth=0.5, alpha=0.6)
    draw_box(axes, box, color)
    draw_box(axes, truth, TRUTH_COLOR)
    axes.patches[-1].set_linestyle("--")
    axes.set(xticks=[], yticks=[], xlim=(-0.5, width - 0.5), ylim=(height - 0.5, -0.5))
    axes.set_xlabel(f"{curve.statuses[index]}", fontsize=8)


def _angles(axes: Any, runs: Mapping[str, FollowCurve], models: Sequence[str], scene: PanTiltScene) -> None:
    third = math.degrees(math.atan(scene.rig.intrinsics.width / 6 / scene.rig.intrinsics.fx))
    run = runs[models[0]]
    seconds = np.arange(len(run.angles)) / run.rate
    target = np.degrees(run.directions[:, 0])
    shade_frames(axes, _hidden(run), 1 / run.rate)
    axes.fill_between(
        seconds,
        target - third,
        target + third,
        color="#F0E442",
        alpha=0.35,
        linewidth=0,
        label="target in the middle third",
    )
    axes.plot(seconds, target, color="black", linestyle="--", linewidth=1.2, label="target")
    for color, model in zip(COLORS, models, strict=False):
        axes.plot(
            seconds,
            np.degrees(runs[model].angles[:, 0]),
            color=color,
            linewidth=1.4,
            label=f"camera, {model}",
        )
    axes.set_xlim(0, max(seconds[-1], 1 / run.rate))


def _hidden(run: FollowCurve) -> Any:
    """Frames (M,) in which somebody hides the target, but not those with it out of the image."""
    return (run.visible < MIN_VISIBLE) & run.in_image
