# SPDX-License-Identifier: MIT
"""A strip along the bottom of an overlay: when a target was tracked, occluded and lost so far."""

import numpy as np

from tricue.arrays import Image
from tricue.draw.canvas import STATUS_COLORS
from tricue.track.base.track import Status

MIN_HEIGHT = 6  # pixels
SHARE = 80  # the image's height over the strip's
AHEAD = (40, 40, 40)  # BGR of frames still to come, or before the target's start

_CODES = {status: code for code, status in enumerate(Status, 1)}
_PALETTE = np.array([AHEAD, *(STATUS_COLORS[status] for status in Status)], np.uint8)


class StatusStrip:
    """The statuses of a target, frame by frame, drawn as one strip.

    length: the number of frames in all; None if unknown, the strip is then always full. before: how many of
    them lie before the target's start.
    """

    def __init__(self, length: int | None = None, before: int = 0) -> None:
        self._length = length or 0
        self._codes = bytearray(before)

    def add(self, status: Status) -> None:
        """Add the status in the next frame."""
        self._codes.append(_CODES[status])

    def draw(self, canvas: Image, line: int = 0) -> None:
        """Draw it into the canvas (H, W, 3). line: from the bottom, from 0."""
        height = max(MIN_HEIGHT, canvas.shape[0] // SHARE)
        count = max(self._length, len(self._codes), 1)
        codes = np.zeros(count, np.uint8)
        codes[: len(self._codes)] = np.frombuffer(self._codes, np.uint8)
        bottom = canvas.shape[0] - line * (height + 1)
        columns = np.arange(canvas.shape[1]) * count // canvas.shape[1]
        canvas[max(bottom - height - 1, 0) : max(bottom, 0)] = 0  # a line between strips
        canvas[max(bottom - height, 0) : max(bottom, 0)] = _PALETTE[codes[columns]]
