# SPDX-License-Identifier: MIT
"""MOTChallenge's text: decimals that are as good far from the origin as near it."""

import numpy as np
from tricue import Box, Pose, Status, Track
from tricue.export.mot import mot_line

BOX = Box(1, 2, 3, 4)
WORLD = Pose(np.eye(3), (1.0, 0.0, 0.0))


def values(
    place: tuple[float, float, float], pose: Pose | None = None, box: Box = BOX, score: float = 0.5
) -> list[str]:
    """The words of a line for a target there."""
    track = Track(box, score, Status.TRACKED, np.array(place), pose=pose)
    line = mot_line(0, 1, track)
    assert line.endswith("\n")
    return line[:-1].split(",")


def test_coordinates_of_a_map_keep_their_decimals() -> None:
    """It proves that UTM coordinates, of seven digits before the point, are written to the micrometer, and
    without exponents.
    """
    assert values((500000.25, 4649776.5, 1234567.890123), WORLD)[-3:] == [
        "500001.25",
        "4649776.5",
        "1234567.890123",
    ]


def test_small_numbers_have_six_decimals() -> None:
    """It proves that numbers are rounded as in a table, without exponents, and that nothing is -0."""
    assert values((1e-5, -1e-9, -2 / 3))[-3:] == ["0.00001", "0", "-0.666667"]
    assert values((0, 0, 1), None, Box(1 / 3, -1, 100, 2000.5), 1.0)[2:7] == [
        "1.333333",
        "0",
        "100",
        "2000.5",
        "1",
    ]


def test_nan_stays() -> None:
    """It proves that a coordinate that isn't known is nan, as Python and NumPy read it."""
    assert values((np.nan, 0.0, -1.0))[-3:] == ["nan", "0", "-1"]


def test_no_position_is_minus_one() -> None:
    """It proves the format's word for what wasn't measured, and that a lost target has no line."""
    assert mot_line(4, 7, Track(Box(0, 0, 3, 4), 0.25, Status.OCCLUDED)) == "5,7,1,1,3,4,0.25,-1,-1,-1\n"
    assert mot_line(4, 7, Track(Box(0, 0, 3, 4), 0.25, Status.LOST)) == ""
