# SPDX-License-Identifier: MIT
"""Paths of targets in meters, seen from above (matplotlib, from the ``demo`` extra)."""

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.rig import Intrinsics
from tricue.draw.figures import COLORS, STYLE, require
from tricue.track.base.track import Status, Track

PLOT_STATUS_COLORS = {Status.TRACKED: COLORS[2], Status.OCCLUDED: COLORS[4], Status.LOST: COLORS[1]}
_CAMERA_SYMBOL_SIZE = 0.05  # as a share of the depth shown
_SHOWN_DEPTH = 1.1  # depth of the drawn field of view, relative to the farthest point


def path_from_above(
    tracks: Iterable[Track], intrinsics: Intrinsics | None = None, truth: ArrayLike | None = None
) -> Any:
    """A matplotlib figure of the tracks' positions from above: x against z in meters, at equal scale.

    The camera is at (0, 0) and looks up the page; with ``intrinsics`` its field of view is drawn. The color
    of a point is its status. truth: (N, 3) true positions, meters in the camera frame, NaN where unknown,
    drawn as a thin line. ValueError if no track has a position.
    """
    require()
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    with rc_context(STYLE):
        figure = Figure(figsize=(6, 6), layout="constrained")
        draw_path(figure.subplots(), tracks, intrinsics, truth)
    return figure


def draw_path(
    axes: Any, tracks: Iterable[Track], intrinsics: Intrinsics | None = None, truth: ArrayLike | None = None
) -> None:
    """Draw what :func:`path_from_above` shows into given matplotlib axes."""
    placed = [track for track in tracks if track.position is not None]
    if not placed:
        raise ValueError("tracks: expected one with a position, got none")
    points = np.array([track.position for track in placed])
    _draw_camera(axes, intrinsics, _SHOWN_DEPTH * float(np.nanmax(points[:, 2])))
    if truth is not None:
        x, _, z = _positions(truth).T
        axes.plot(x, z, color="black", linewidth=0.8, label="truth")
    _draw_path(axes, points, [track.status for track in placed])
    axes.set(xlabel="x, m (right of the camera)", ylabel="z, m (in front of it)")
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend(frameon=False, loc="best")


def save_path(
    path: str | Path,
    tracks: Iterable[Track],
    intrinsics: Intrinsics | None = None,
    truth: ArrayLike | None = None,
) -> None:
    """Write the figure of :func:`path_from_above` to a file."""
    path = Path(path)
    figure = path_from_above(tracks, intrinsics, truth)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=STYLE["savefig.dpi"])


def check_format(path: Path) -> None:
    """Raise ImportError if matplotlib is missing, ValueError for a suffix that it can't write."""
    require()
    from matplotlib.figure import Figure

    known = Figure().canvas.get_supported_filetypes()
    if path.suffix.lower().removeprefix(".") not in known:
        raise ValueError(f"{path}: expected a picture's name that ends in .png, .svg or .pdf")


def _positions(truth: ArrayLike) -> NDArray[np.float64]:
    positions = np.asarray(truth, np.float64)
    if positions.ndim != 2 or positions.shape[1] != 3:
        raise ValueError(f"truth: expected positions (N, 3), meters, got {positions.shape}")
    return positions


def _draw_camera(axes: Any, intrinsics: Intrinsics | None, depth: float) -> None:
    side = _CAMERA_SYMBOL_SIZE * depth
    axes.fill([0, -side / 2, side / 2], [0, -side, -side], color="0.3", label="camera")
    if intrinsics is not None:
        # The outer edges of the first and last pixels, whose centers are at 0 and width - 1.
        edges = [(u - intrinsics.cx) / intrinsics.fx for u in (-0.5, intrinsics.width - 0.5)]
        angle = math.degrees(math.atan(edges[1]) - math.atan(edges[0]))
        left, right = (edge * depth for edge in edges)
        axes.fill([0, left, right], [0, depth, depth], color="0.95", label=f"field of view, {angle:.0f}°")


def _draw_path(axes: Any, points: NDArray[np.float64], statuses: list[Status]) -> None:
    axes.plot(points[:, 0], points[:, 2], color="0.6", linewidth=0.8)
    for status, color in PLOT_STATUS_COLORS.items():
        chosen = points[[other is status for other in statuses]]
        if len(chosen):
            axes.plot(chosen[:, 0], chosen[:, 2], "o", color=color, markersize=4, label=str(status))
    axes.annotate(" start", points[0, ::2])
