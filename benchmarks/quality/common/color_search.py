# SPDX-License-Identifier: MIT
"""The color search alone, Birchfield 1998 and section 3.1 of Moreno et al. 2002: an ellipse in an image."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue import _core
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation.baselines import bgr
from tricue.track.base.track import Status, Track

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchParams:
    """Of the search in color; there is no depth in it, and the ellipse keeps its size."""

    bins: tuple[int, int, int] = (32, 32, 4)  # of B - G, G - R, B + G + R
    chroma: int = 64  # levels, where the axes of B - G and G - R end
    reach: tuple[float, float] = (0.3, 0.25)  # to each side and up and down, of the box's width and height
    gradient: float = 0.35  # weight of the outline's gradient beside the intersection
    blur: float = 1.0  # pixels, standard deviation, before the gradient
    learning_rate: float = 0.1  # a of (2)
    points: int = 64  # of the outline


class ColorSearch:
    """Follows an ellipse in two dimensions, by (1), Birchfield's gradient, and (2) in every frame.

    Both terms are stretched to [0, 1] over the places searched, as Birchfield does, before they are added.
    """

    def __init__(self, params: SearchParams | None = None) -> None:
        self.params = params or SearchParams()
        angles = (np.arange(self.params.points) + 0.5) * 2 * np.pi / self.params.points
        self._outline = np.column_stack([np.cos(angles), np.sin(angles)])

    def init(self, frame: Frame, box: Box) -> Track:
        self._ellipse = np.array(box.ellipse)
        self._model = self._histogram(bgr(frame))
        return self._track(1.0)

    def update(self, frame: Frame) -> Track:
        p, image = self.params, bgr(frame)
        rows, cols = self._grid()
        left, top, bins = self._bins(image, cols // 2, rows // 2)
        there = self._ellipse - [left, top, 0, 0]
        likeness = _core.ellipse_search(bins, there, (rows, cols, 1), self._model, 1.0, None)[..., 0]
        grey = cv2.GaussianBlur(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), (0, 0), p.blur).astype(np.uint8)
        edge = _core.ellipse_gradient(grey, self._ellipse, (rows, cols, 1), self._outline)
        best = int(np.argmax(_stretched(likeness) + p.gradient * _stretched(edge)))
        row, col = divmod(best, cols)
        height, width = grey.shape
        x, y = self._ellipse[:2] + [col - cols // 2, row - rows // 2]
        self._ellipse[:2] = min(max(x, 0), width), min(max(y, 0), height)
        self._model += p.learning_rate * (self._histogram(image) - self._model)
        return self._track(float(likeness[row, col]))

    def _grid(self) -> tuple[int, int]:
        """Rows and columns of places: odd numbers, the ellipse in the middle."""
        across, down = (
            max(round(2 * reach * half), 2)
            for reach, half in zip(self.params.reach, self._ellipse[2:].tolist(), strict=True)
        )
        return 2 * down + 1, 2 * across + 1

    def _bins(self, image: NDArray[np.uint8], across: int, down: int) -> tuple[int, int, NDArray[np.uint16]]:
        """Left and top of a region round the ellipse, and the bins of its pixels."""
        x, y, minor, major = self._ellipse.tolist()
        left, top = int(np.floor(x - minor)) - across - 1, int(np.floor(y - major)) - down - 1
        right, bottom = int(np.ceil(x + minor)) + across + 1, int(np.ceil(y + major)) + down + 1
        region = (left, top, right, bottom)
        return left, top, _core.color_bins(image, region, self.params.bins, self.params.chroma, 1)

    def _histogram(self, image: NDArray[np.uint8]) -> Floats:
        left, top, bins = self._bins(image, 0, 0)
        size = int(np.prod(self.params.bins))
        inside, _ = _core.ellipse_histogram(bins, (self._ellipse - [left, top, 0, 0])[None], size, 1.0)
        counts: Floats = inside[0].astype(np.float64)
        return np.asarray(counts / max(counts.sum(), 1.0))

    def _track(self, score: float) -> Track:
        return Track(Box.from_ellipse(*self._ellipse.tolist()), score, Status.TRACKED)


def _stretched(values: Floats) -> Floats:
    """From 0, the least, to 1, the greatest of them."""
    least = values.min()
    return np.asarray((values - least) / max(float(values.max() - least), 1e-9))
