# SPDX-License-Identifier: MIT
"""Tracks and boxes in a notebook."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.evaluation.report.markup import Html
from tricue.notebook.markup import properties, table
from tricue.track.base.track import Status, Track

# Okabe and Ito's colors for a dot beside the word, visible on white and on black.
_DOTS = {Status.TRACKED: "#009E73", Status.OCCLUDED: "#E69F00", Status.LOST: "#D55E00"}
_AXES = "XYZ"


def track_html(track: Track) -> Html:
    """Status, score, box; where known, position ± standard deviation, depth and world position."""
    rows = [
        ("status", status_mark(track.status)),
        ("score", f"{track.score:.2f}"),
        ("box", _box_text(track.box)),
        ("position", _point(track.position, track.covariance)),
        ("depth", None if track.depth is None else f"{track.depth:.3f} m"),
        ("in the world", _point(track.world_position, track.world_covariance)),
    ]
    return properties("Track", rows)


def status_mark(status: Status) -> Html:
    """The word, with a dot in the status's color."""
    return Html(f'<span style="color:{_DOTS[status]}">●</span> {status}')


def box_html(box: Box) -> Html:
    """Its four numbers, pixels."""
    return table("", ("Box, px", *box._fields), [("", *(f"{value:.1f}" for value in box))], numbers=True)


def _box_text(box: Box) -> str:
    x, y, width, height = box
    return f"x {x:.1f}, y {y:.1f}, {width:.1f}x{height:.1f} px"


def _point(point: NDArray[np.float64] | None, covariance: NDArray[np.float64] | None) -> str | None:
    """X, Y, Z, each with its standard deviation if known; None without a point."""
    if point is None:
        return None
    words = [f"{axis} {value:+.3f}" for axis, value in zip(_AXES, point, strict=True)]
    if covariance is not None:
        deviations = np.sqrt(np.maximum(np.diag(covariance), 0))
        words = [f"{word} ± {deviation:.3f}" for word, deviation in zip(words, deviations, strict=True)]
    return ", ".join(words) + " m"
