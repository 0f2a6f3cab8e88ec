# SPDX-License-Identifier: MIT
"""The decay of a missed target's velocity."""

FRAME_DIGITS = 3  # decimals of a time in frames, so that rounded timestamps change nothing


def velocity_kept(share: float, seconds: float, rate: float) -> float:
    """The share of a velocity that is kept over a frame interval in seconds.

    It is ``share`` at ``rate`` frames/s, and less over longer intervals. Over shorter ones it isn't more: a
    velocity measured over a short time is less certain.
    """
    return float(share ** max(round(seconds * rate, FRAME_DIGITS), 1.0))
