# SPDX-License-Identifier: MIT
"""MOTChallenge's text: frame, id, left, top, width, height, confidence, x, y, z."""

from tricue.track.base.track import Status, Track

NO_POSITION = (-1, -1, -1)


def mot_line(number: int, target: int, track: Track) -> str:
    """The line of a target in a frame, from 0; "" where it is LOST.

    Frames, ids and pixels count from 1. x, y, z are meters in the world, in the camera's frame where that has
    no pose, and -1 where nothing was measured.
    """
    if track.status is Status.LOST:
        return ""
    place = track.position if track.world_position is None else track.world_position
    x, y, width, height = track.box
    numbers = [x + 1, y + 1, width, height, track.score, *(NO_POSITION if place is None else place)]
    return ",".join([str(number + 1), str(target), *(f"{value:.6g}" for value in numbers)]) + "\n"
