# SPDX-License-Identifier: MIT
"""How the velocity of a missed target fades."""

FRAME_DIGITS = 3  # after the point, of a time in frames: rounding of timestamps changes nothing


def velocity_kept(share: float, seconds: float, rate: float) -> float:
    """The share of a velocity that is kept over a frame interval of so many seconds.

    It is ``share`` at ``rate`` frames/s, and less over longer intervals. Over shorter ones it isn't more: a
    velocity measured over a short time is less certain.
    """
    return float(share ** max(round(seconds * rate, FRAME_DIGITS), 1.0))
