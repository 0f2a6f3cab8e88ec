# SPDX-License-Identifier: MIT
"""Search for an ellipse by color and gradient: Birchfield (1998), and section 3.1 of Moreno et al. (2002)."""

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
    """The parameters of the search in two dimensions, without depth; the ellipse keeps its size."""

    bins: tuple[int, int, int] = (32, 32, 4)  # of B - G, G - R, B + G + R
    chroma: int = 64  # levels at which the axes of B - G and G - R end
    search_range: tuple[float, float] = (0.3, 0.25)  # shares of the box's width and height
    gradient_weight: float = 0.35  # of the outline's gradient; the histogram intersection has weight 1
    blur: float = 1.0  # pixels, standard deviation, before the gradient
    learning_rate: float = 0.1  # a of (2)
    points: int = 64  # of the outline


class ColorSearch:
    """Tracks an ellipse in two dimensions by (1) and Birchfield's gradient, and updates its model by (2).

    Both terms are scaled to [0, 1] over all candidate positions, as Birchfield does, before they are added.
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
        ellipse = self._ellipse - [left, top, 0, 0]
        similarity = _core.ellipse_search(bins, ellipse, (rows, cols, 1), self._model, 1.0, None)[..., 0]
        evidence = _scaled(similarity)
        if p.gradient_weight:
            gray = cv2.GaussianBlur(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), (0, 0), p.blur).astype(np.uint8)
            edge = _outline_gradient(gray, self._ellipse, (rows, cols), self._outline)
            evidence += p.gradient_weight * _scaled(edge)
        best = int(np.argmax(evidence))
        row, col = divmod(best, cols)
        height, width = image.shape[:2]
        x, y = self._ellipse[:2] + [col - cols // 2, row - rows // 2]
        self._ellipse[:2] = min(max(x, 0), width), min(max(y, 0), height)
        self._model += p.learning_rate * (self._histogram(image) - self._model)
        return self._track(float(similarity[row, col]))

    def _grid(self) -> tuple[int, int]:
        """Rows and columns of candidate positions; odd numbers, so that the ellipse is in the middle."""
        across, down = (
            max(round(2 * share * half), 2)
            for share, half in zip(self.params.search_range, self._ellipse[2:].tolist(), strict=True)
        )
        return 2 * down + 1, 2 * across + 1

    def _bins(self, image: NDArray[np.uint8], across: int, down: int) -> tuple[int, int, NDArray[np.uint16]]:
        """Left and top of a region around the ellipse, and the bins of its pixels."""
        x, y, minor, major = self._ellipse.tolist()
        left, top = int(np.floor(x - minor)) - across - 1, int(np.floor(y - major)) - down - 1
        right, bottom = int(np.ceil(x + minor)) + across + 1, int(np.ceil(y + major)) + down + 1
        region = (left, top, right, bottom)
        return left, top, _core.color_bins(image, region, (self.params.bins, self.params.chroma), 1)

    def _histogram(self, image: NDArray[np.uint8]) -> Floats:
        left, top, bins = self._bins(image, 0, 0)
        rows, columns = np.indices(bins.shape) + 0.5
        x, y, minor, major = self._ellipse.tolist()
        inside = ((columns + left - x) / minor) ** 2 + ((rows + top - y) / major) ** 2 <= 1
        size = int(np.prod(self.params.bins))
        counts = np.bincount(bins[inside & (bins < size)], minlength=size).astype(np.float64)
        return np.asarray(counts / max(counts.sum(), 1.0))

    def _track(self, score: float) -> Track:
        return Track(Box.from_ellipse(*self._ellipse.tolist()), score, Status.TRACKED)


def _outline_gradient(
    gray: NDArray[np.uint8], ellipse: Floats, grid: tuple[int, int], outline: Floats
) -> Floats:
    """Mean |n . grad I| along an ellipse's outline, at each place of a grid of pixels around its own place.

    Birchfield (1998), equation (2), with the ellipse's normal n. grid: rows and columns. outline: (n, 2)
    points of the unit circle. Points outside the image are left out; 0 if all are.
    """
    height, width = gray.shape
    padded = np.pad(gray.astype(np.float64), 1, "edge")
    right = (padded[1:-1, 2:] - padded[1:-1, :-2]) / 2
    down = (padded[2:, 1:-1] - padded[:-2, 1:-1]) / 2
    normals = outline / ellipse[2:]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    u, v = normals.T[:, :, None, None]
    first = np.floor(ellipse[:2])
    points = (first + np.floor(ellipse[:2] - first + outline * ellipse[2:])).astype(int)
    columns = (points[:, :1] + np.arange(grid[1]) - grid[1] // 2)[:, None]
    rows = (points[:, 1:] + np.arange(grid[0]) - grid[0] // 2)[..., None]
    inside = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
    pixels = rows.clip(0, height - 1), columns.clip(0, width - 1)
    along = np.abs(u * right[pixels] + v * down[pixels])
    return np.asarray((along * inside).sum(axis=0) / np.maximum(inside.sum(axis=0), 1))


def _scaled(values: Floats) -> Floats:
    """The values scaled linearly to [0, 1]."""
    low = values.min()
    return np.asarray((values - low) / max(float(values.max() - low), 1e-9))
