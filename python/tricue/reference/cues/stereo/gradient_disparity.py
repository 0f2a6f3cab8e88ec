# SPDX-License-Identifier: MIT
"""Disparity near a predicted one, by the gradient method (Okada, Shirai, Miura 1996, section 3)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Image, Singles
from tricue.reference.base.checks import refuse

Mask = NDArray[np.bool_]
Rectangle = tuple[int, int, int, int]

STEP = 1.5  # the most that a coarse level adds, in its own pixels
RIDGE = 0.01  # (gray levels / px^2)^2 per pixel: with less contrast the prediction hardly changes
TINY = 1e-6  # gray levels^2 / px^2: makes the residual 0 where images have no power


def gradient_disparity(
    left: Image,
    right: Image,
    disparity: float,
    matching: tuple[int, float, int, float, float, float],
    region: Rectangle | None = None,
) -> tuple[Singles, Singles]:
    """Solves (7) in windows by least squares, level by level."""
    levels, sigma, radius, min_reliability, max_residual, max_step = matching
    rows, columns = left.shape
    x0, y0, x1, y1 = (0, 0, columns, rows) if region is None else region
    _require(left, right, levels, radius, (x0, y0, x1, y1))
    _require_numbers(
        disparity,
        sigma,
        min_reliability=min_reliability,
        max_residual=max_residual,
        max_step=max_step,
    )
    pyramid = [(left.astype(np.float64), right.astype(np.float64))]
    for _ in range(levels - 1):
        pyramid.append((halved(pyramid[-1][0]), halved(pyramid[-1][1])))

    known = np.full(pyramid[-1][0].shape, disparity / 2 ** (levels - 1))
    for level in range(levels - 1, 0, -1):
        one, other = (derivative(image, sigma) for image in pyramid[level])
        step, *_ = measure(one, other, known, radius)
        known = doubled(known + np.clip(step, -STEP, STEP), pyramid[level - 1][0].shape)
    one, other = (derivative(image, sigma) for image in pyramid[0])
    step, reliability, residual, seen = measure(one, other, known, radius)

    kept = seen & (reliability >= min_reliability) & (abs(step) <= max_step)
    if radius > 0:  # a single equation has no residual
        kept &= residual <= max_residual
    d = np.where(kept, known + step, np.nan)
    return cut(d, (x0, y0, x1, y1), np.nan), cut(reliability, (x0, y0, x1, y1), 0)


def derivative(image: Floats, sigma: float) -> Floats:
    """The f of (7): the x-derivative of the image, smoothed by a Gaussian."""
    reach = int(np.ceil(2.5 * sigma))
    offsets = np.arange(-reach, reach + 1)
    bell = np.exp(-(offsets**2) / (2 * sigma**2))
    smooth = bell / bell.sum()
    slope = offsets * bell / (offsets**2 * bell).sum()  # 1 on a ramp of slope 1
    return correlate(correlate(image, smooth, 0), slope, 1)


def correlate(image: Floats, weights: Floats, axis: int) -> Floats:
    """Correlation with an odd number of weights along an axis; edge pixels are repeated."""
    reach = len(weights) // 2
    padded = np.pad(image, [(reach, reach) if k == axis else (0, 0) for k in range(2)], mode="edge")
    size = image.shape[axis]
    parts = [weight * padded.take(range(k, k + size), axis) for k, weight in enumerate(weights)]
    return np.asarray(sum(parts))


def halved(image: Floats) -> Floats:
    """Every second pixel along both axes, smoothed by 1, 3, 3, 1; (i, j) lies between 2 i and 2 i + 1."""
    for axis in range(2):
        size = image.shape[axis]
        at = np.arange(0, size, 2)
        parts = [
            weight * image.take(np.clip(at + k, 0, size - 1), axis)
            for k, weight in ((-1, 1 / 8), (0, 3 / 8), (1, 3 / 8), (2, 1 / 8))
        ]
        image = np.asarray(sum(parts))
    return image


def doubled(disparity: Floats, shape: tuple[int, int]) -> Floats:
    """The disparities of a level in the pixels of the next finer one, which has that shape."""
    return 2 * disparity.repeat(2, 0).repeat(2, 1)[: shape[0], : shape[1]]


def slope(image: Floats) -> Floats:
    """Half the difference of the neighbors along x; edge pixels are repeated."""
    return correlate(image, np.array([-0.5, 0, 0.5]), 1)


def warped(image: Floats, x: Floats) -> Floats:
    """The image at columns x (H, W), interpolated linearly; edge pixels are repeated."""
    x = np.clip(x, 0, image.shape[1] - 1)
    column = np.floor(x).astype(np.int64)
    after = np.minimum(column + 1, image.shape[1] - 1)
    share, row = x - column, np.arange(len(image))[:, None]
    return np.asarray(image[row, column] * (1 - share) + image[row, after] * share)


def pooled(values: Floats, radius: int) -> Floats:
    """The mean of the square window around each pixel, with zeros outside the image."""
    side = 2 * radius + 1
    padded, (rows, columns) = np.pad(values, radius), values.shape
    shifts = [padded[k : k + rows, i : i + columns] for k in range(side) for i in range(side)]
    return np.asarray(np.mean(shifts, axis=0), np.float64)


def measure(left: Floats, right: Floats, known: Floats, radius: int) -> tuple[Floats, Floats, Floats, Mask]:
    """Solves (7) in windows by least squares, with the right image shifted by the known disparities.

    Returns the step from the known disparity, px; the reliability (9); the residual after the step, as a
    share of both images' power; and whether x - known is in the right image.

    Each pixel gives the equation slope (d - known) = right - left, where slope is the mean of both images'. A
    window has one d for all its pixels, even if their known disparities differ.
    """
    x = np.arange(left.shape[1]) - known
    seen = (x >= 0) & (x <= left.shape[1] - 1)
    shifted, left_slope, right_slope = warped(right, x), slope(left), warped(slope(right), x)
    mean_slope = np.where(seen, (right_slope + left_slope) / 2, 0)  # (7)
    difference = np.where(seen, left - shifted, 0)
    asked = mean_slope * known - difference  # = mean_slope d

    a = pooled(mean_slope**2, radius)
    b = pooled(mean_slope * asked, radius)
    c = pooled(asked**2, radius)
    power = pooled(np.where(seen, left**2 + shifted**2, 0), radius)
    step = (b - a * known) / (a + RIDGE)
    d = known + step
    residual = (c - 2 * d * b + d**2 * a) / (power + TINY)
    reliability = pooled(np.where(seen, right_slope**2 + left_slope**2, 0), radius)  # (9)
    return step, reliability, residual, seen


def cut(values: Floats, region: Rectangle, outside: float) -> Singles:
    """The values in a region; ``outside`` where it reaches beyond the image."""
    x0, y0, x1, y1 = region
    rows, columns = values.shape
    part = np.full((y1 - y0, x1 - x0), outside, np.float32)
    top, bottom, first, last = max(y0, 0), min(y1, rows), max(x0, 0), min(x1, columns)
    if top < bottom and first < last:
        part[top - y0 : bottom - y0, first - x0 : last - x0] = values[top:bottom, first:last]
    return part


def _require(left: Image, right: Image, levels: int, radius: int, region: Rectangle) -> None:
    if left.size == 0:
        refuse("left", "at least one pixel", "none")
    if left.shape != right.shape:
        refuse("right", f"the left image's shape {left.shape}", right.shape)
    if not 1 <= levels <= 6:
        refuse("levels", "1 to 6", levels)
    if not 0 <= radius <= 7:
        refuse("radius", "0 to 7", radius)
    x0, y0, x1, y1 = region
    if not (0 < x1 - x0 <= 16384 and 0 < y1 - y0 <= 16384):
        refuse("region", "x0 < x1 and y0 < y1, at most 16384 apart", f"({x0}, {y0}, {x1}, {y1})")


def _require_numbers(disparity: float, sigma: float, **limits: float) -> None:
    if not abs(disparity) <= 16384:
        refuse("disparity", "-16384 to 16384", float(disparity))
    if not 0.5 <= sigma <= 6:
        refuse("sigma", "0.5 to 6", float(sigma))
    for name, value in limits.items():
        if not value >= 0:
            refuse(name, "a number that isn't negative", float(value))
