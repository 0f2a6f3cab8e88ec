# SPDX-License-Identifier: MIT
"""How the velocity of a missed target fades."""

FRAME_DIGITS = 3  # after the point, of a time in frames: rounding of timestamps changes nothing


def velocity_kept(share: float, seconds: float, rate: float) -> float:
    """The share of a velocity that is kept after so many seconds, if ``share`` is kept after 1 / ``rate``."""
    return float(share ** round(seconds * rate, FRAME_DIGITS))
