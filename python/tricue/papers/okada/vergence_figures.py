# SPDX-License-Identifier: MIT
"""Stereo pairs at some vergence angles, and depth errors and overlaps over the angle."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tricue.draw.figures import COLORS
from tricue.papers import tables
from tricue.papers.curves import MIN_OVERLAP, models_of
from tricue.papers.okada.vergence_curves import VergenceCurve
from tricue.papers.plots import show_frame
from tricue.scenes import WalkScene

KNOWN, IGNORED = "vergence known", "vergence ignored"
PRINTED_KNOWN, PRINTED_IGNORED = f"as printed, {KNOWN}", f"as printed, {IGNORED}"
MIN_SHOWN_ERROR = 0.02  # meters, of the logarithmic axis


def pairs_and_errors(figure: Any, curves: Sequence[VergenceCurve], scenes: Mapping[str, WalkScene]) -> None:
    """Above, the first left image and the right one for each angle. Below, over the angle, the median depth
    error and the share of frames with the box on the target.
    """
    figure.set_size_inches(14, 6)
    top, bottom = figure.subfigures(2, 1, height_ratios=[2, 4])
    panels = top.subplots(1, len(scenes) + 1)
    (first, *_) = scenes.values()
    show_frame(panels[0], first.frames[0].color, "left")
    for axes, scene in zip(panels[1:], scenes.values(), strict=True):
        show_frame(axes, scene.frames[0].right, f"right, {scene.vergence:g}°")
    errors, overlaps = bottom.subplots(1, 2)
    angles = sorted({curve.vergence for curve in curves})
    for color, model in zip(COLORS, models_of(curves), strict=False):
        runs = [[each for each in curves if (each.model, each.vergence) == (model, at)] for at in angles]
        medians = [_median_error(each) for each in runs]
        shares = [100 * np.mean([run.overlaps[1:] > MIN_OVERLAP for run in each]) for each in runs]
        style = {"color": color, "marker": "o", "linestyle": "--" if "ignored" in model else "-"}
        errors.plot(angles, np.maximum(medians, MIN_SHOWN_ERROR), label=model, **style)
        overlaps.plot(angles, shares, **style)
    errors.set(yscale="log", xlabel="vergence, degrees", title="median error of depth, m; none: no depth")
    overlaps.set(ylim=(-3, 103), xlabel="vergence, degrees", title="frames with an IoU above 0.5, %")
    handles, labels = errors.get_legend_handles_labels()
    bottom.legend(handles, labels, frameon=False, loc="outside lower center", ncols=len(labels))


def _median_error(runs: Sequence[VergenceCurve]) -> float:
    errors = np.concatenate([np.abs(run.depth_errors[1:]) for run in runs])
    return tables.percentiles(errors, 50)[0]
