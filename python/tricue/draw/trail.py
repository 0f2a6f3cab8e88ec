# SPDX-License-Identifier: MIT
"""The trail of a target: the path of its box's center in the last seconds, fading, interrupted where lost."""

from collections import deque
from itertools import pairwise

import cv2
import numpy as np

from tricue.arrays import Image
from tricue.camera.numbers import positive
from tricue.draw.canvas import BLACK, Color, to_pixels
from tricue.track.base.track import Status, Track

DEFAULT_SECONDS = 2.0
SHARE = 240  # the image's shorter side over the line's width
MARGIN = 8  # pixels around the line that are redrawn

Point = tuple[int, int]


class Trail:
    """Collects a target's centers frame by frame, and draws those of the last seconds.

    seconds: how long a center stays; ValueError unless above 0.
    """

    def __init__(self, seconds: float = DEFAULT_SECONDS) -> None:
        self.seconds = positive(seconds, "trail", "seconds")
        self._centers: deque[tuple[float, tuple[float, float] | None]] = deque()

    def add(self, time: float, track: Track | None) -> None:
        """Add the track at a time in seconds, which must not decrease; None without a track."""
        center = None if track is None or track.status is Status.LOST else track.box.center
        self._centers.append((time, center))
        while self._centers[0][0] < time - self.seconds:
            self._centers.popleft()

    def draw(self, canvas: Image, scale: int, color: Color) -> None:
        """Draw it into a BGR image (H, W, 3), enlarged by ``scale``; older parts are fainter."""
        lines = [
            (*to_pixels((*before, *after), scale), self._share(time))
            for (_, before), (time, after) in pairwise(self._centers)
            if before is not None and after is not None
        ]
        if not lines:
            return
        width = max(2, min(canvas.shape[:2]) // SHARE)
        corners = np.array([line[:4] for line in lines]).reshape(-1, 2)
        (left, top), (right, bottom) = corners.min(0) - MARGIN - width, corners.max(0) + MARGIN + width
        left, top = max(left, 0), max(top, 0)
        part = canvas[top : max(bottom, top), left : max(right, left)]
        if not part.size:
            return
        for ink, thickness, strength in ((BLACK, width + 2, 0.5), (color, width, 1.0)):
            mask = np.zeros(part.shape[:2], np.uint8)
            for x, y, end_x, end_y, share in lines:
                line = (x - left, y - top), (end_x - left, end_y - top)
                cv2.line(mask, *line, round(255 * strength * share), thickness, cv2.LINE_AA)
            weight = mask[..., None] / np.float32(255)
            part[...] = part + weight * (np.array(ink, np.float32) - part)

    def _share(self, time: float) -> float:
        """The opacity of the line that ends at this time: 1 for now, 0 for the oldest."""
        return 1 - (self._centers[-1][0] - time) / self.seconds
