# SPDX-License-Identifier: MIT
"""MOTChallenge's text: frame, id, left, top, width, height, confidence, x, y, z."""

from tricue.track.base.track import Status, Track

NO_POSITION = (-1, -1, -1)


def mot_line(number: int, target: int, track: Track) -> str:
    """The line of a target in frame ``number``, counted from 0; "" if it is LOST.

    Frames, ids and pixels count from 1. x, y, z are meters in the world, or in the camera's frame if it has
    no pose, and -1 if nothing was measured. Numbers have at most six decimals, and no exponents.
    """
    if track.status is Status.LOST:
        return ""
    place = track.position if track.world_position is None else track.world_position
    x, y, width, height = track.box
    numbers = [x + 1, y + 1, width, height, track.score, *(NO_POSITION if place is None else place)]
    return ",".join([str(number + 1), str(target), *map(_decimal, numbers)]) + "\n"


def _decimal(value: float) -> str:
    """Six decimals, as in a table, without trailing zeros; not significant digits, because world coordinates
    may be millions of meters.
    """
    rounded = round(float(value), 6) + 0.0  # no -0
    return f"{rounded:.6f}".rstrip("0").rstrip(".")
