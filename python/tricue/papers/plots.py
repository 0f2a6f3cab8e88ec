# SPDX-License-Identifier: MIT
"""Shared parts of the papers' figures: a frame of a scene, a band of curves, shaded occlusions."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Flags, Floats
from tricue.papers.curves import MIN_VISIBLE

HIDDEN_SHADE = "0.88"


def show_frame(axes: Any, image: NDArray[np.uint8] | None, title: str) -> None:
    """Draw a BGR image without ticks, with its title over the left edge."""
    assert image is not None
    axes.imshow(image[..., ::-1])
    axes.set_title(title, loc="left")
    axes.axis("off")


def plot_band(
    axes: Any,
    center: Floats,
    runs: Floats,
    color: str,
    label: str,
    *,
    ranks: tuple[float, float] = (25, 75),
    alpha: float = 0.15,
    linewidth: float = 1.4,
) -> None:
    """Draw a line through ``center`` (M,), and a band between two percentiles of ``runs`` (R, M)."""
    low, high = np.percentile(runs, ranks, axis=0)
    axes.fill_between(np.arange(len(center)), low, high, color=color, alpha=alpha, linewidth=0)
    axes.plot(center, color=color, linewidth=linewidth, label=label)


def shade_hidden(axes: Any, visible: Floats) -> None:
    """Shade the frames in which less than half of the target is visible, and set the axis of frames.

    visible: (M,) visible share of the target.
    """
    shade_frames(axes, visible < MIN_VISIBLE)
    axes.set_xlim(0, max(1, len(visible) - 1))


def shade_frames(axes: Any, flags: Flags, interval: float = 1.0) -> None:
    """Shade the frames with a flag (M,), each by half an interval to both sides, behind curves and bands."""
    edges = np.repeat(interval * (np.arange(len(flags) + 1) - 0.5), 2)[1:-1]
    style = {"transform": axes.get_xaxis_transform(), "color": HIDDEN_SHADE, "linewidth": 0, "zorder": 0}
    axes.fill_between(edges, 0, 1, where=np.repeat(flags, 2), **style)
