# SPDX-License-Identifier: MIT
"""The columns of tables of tracks, in CSV and JSON."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.track import Track

COVARIANCE = ("XX_m2", "XY_m2", "XZ_m2", "YY_m2", "YZ_m2", "ZZ_m2")  # the upper triangle, row by row
COLUMNS = (
    *("frame", "time_s", "status", "score", "x", "y", "width", "height", "X_m", "Y_m", "Z_m"),
    *COVARIANCE,
    "depth_m",
)
POINT = ("X_m", "Y_m", "Z_m", *COVARIANCE)
WORLD_COLUMNS = tuple(f"world_{name}" for name in POINT)
POSITION = frozenset((*POINT, *WORLD_COLUMNS))


class TableForm(NamedTuple):
    """What a table has in addition to COLUMNS: WORLD_COLUMNS; the target's id, if there are several; and
    ``_assumed`` in the names of positions if the camera is only assumed.
    """

    world: bool = False
    several: bool = False
    assumed: bool = False


PLAIN = TableForm()


def columns(form: TableForm = PLAIN) -> tuple[str, ...]:
    """The columns of a table."""
    frame, *others = COLUMNS + WORLD_COLUMNS * form.world
    if form.assumed:
        others = [name if name not in POSITION else f"{name}_assumed" for name in others]
    return (frame, *(["id"] * form.several), *others)


def row(
    number: int, seconds: float | None, track: Track, target: int = 1, form: TableForm = PLAIN
) -> list[Any]:
    """The values of :func:`columns`, None if absent, with six decimals; covariances with six digits.

    number: the frame's, from 0. seconds: its time. target: its id.
    """
    numbers = [seconds, track.score, *track.box]
    time, *others = [None if value is None else round(float(value), 6) for value in numbers]
    depth = None if track.depth is None else round(track.depth, 6)
    values = [number, *([target] * form.several), time, str(track.status), *others]
    values += [*_point(track.position), *_triangle(track.covariance), depth]
    if form.world:
        values += [*_point(track.world_position), *_triangle(track.world_covariance)]
    return values


def _point(position: NDArray[np.float64] | None) -> list[float | None]:
    return [None] * 3 if position is None else [round(value, 6) for value in position.tolist()]


def _triangle(covariance: NDArray[np.float64] | None) -> list[float | None]:
    if covariance is None:
        return [None] * len(COVARIANCE)
    return [float(f"{value:.6g}") for value in covariance[np.triu_indices(3)]]
