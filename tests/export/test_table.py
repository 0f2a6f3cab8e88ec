# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue import Box, Pose, Status, Track
from tricue.export.table import COLUMNS, WORLD_COLUMNS, TableForm, columns, row

POSE = Pose(np.eye(3), (1.0, 0.0, 0.0))
SOLID = Track(
    Box(1, 2, 3, 4), 1 / 3, Status.TRACKED, np.array([0.1, 0.2, 3.0]), np.diag([1e-6, 2e-6, 1 / 3]), 3.0, POSE
)


@pytest.mark.parametrize("world", [False, True])
@pytest.mark.parametrize("several", [False, True])
def test_rows_have_the_columns(world: bool, several: bool) -> None:
    """It proves that each value stands under its name, in every form of the table."""
    form = TableForm(world, several)
    named = dict(zip(columns(form), row(7, 0.25, SOLID, 5, form), strict=True))
    assert (named["frame"], named["time_s"], named["status"], named["score"]) == (
        7,
        0.25,
        "tracked",
        0.333333,
    )
    assert [named[name] for name in ("x", "height", "Z_m", "ZZ_m2", "depth_m")] == [1, 4, 3.0, 0.333333, 3.0]
    assert named.get("id") == (5 if several else None)
    assert named.get("world_X_m") == (1.1 if world else None)


def test_what_is_absent_is_none() -> None:
    """It proves that a track in the image alone leaves time and meters empty."""
    values = row(0, None, Track(Box(1, 2, 3, 4), 0.5, Status.LOST))
    named = dict(zip(COLUMNS, values, strict=True))
    assert [name for name, value in named.items() if value is None] == ["time_s", *COLUMNS[8:]]


def test_assumed_positions_say_so() -> None:
    """It proves that meters of a supposed camera can't be taken for measured ones; depth is measured."""
    names = columns(TableForm(world=True, assumed=True))
    assert [name for name in names if name.endswith("_assumed")] == [
        f"{name}_assumed" for name in (*COLUMNS[8:17], *WORLD_COLUMNS)
    ]
    assert "depth_m" in names
