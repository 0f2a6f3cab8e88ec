# SPDX-License-Identifier: MIT
"""The top of a parabola through three samples."""

MAX_OFFSET = 0.5  # samples; a top farther off would be nearer to a neighbor


def parabola_offset(before: float, maximum: float, after: float) -> float:
    """The offset of the top from the maximum, limited; 0 if there is no top."""
    bend = before - 2 * maximum + after
    return min(max(0.5 * (before - after) / bend, -MAX_OFFSET), MAX_OFFSET) if bend < 0 else 0.0
