# SPDX-License-Identifier: MIT
"""Disparity by sums of absolute differences (Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.2)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Image
from tricue.reference.base.checks import refuse

Ints = NDArray[np.int64]
Disparity = NDArray[np.float32]
Rectangle = tuple[int, int, int, int]
Limits = tuple[int, int]
Matching = tuple[int, int, bool]

NONE = 65535  # the cost of a candidate outside the right image or the range
CLIP = 31


def sad_disparity(
    left: Image,
    right: Image,
    region: Rectangle,
    ellipse: bool,
    limits: Limits,
    matching: Matching,
    tolerance: int = -1,
) -> Disparity:
    """Sums the costs of every candidate over the windows, then selects and checks the best."""
    _require(left, right, region, limits, matching)
    (first, last), (window, uniqueness, prefilter) = limits, matching
    if prefilter:
        left_gray, right_gray = x_sobel(left), x_sobel(right)
    else:
        left_gray, right_gray = left.astype(np.int64), right.astype(np.int64)
    x, y, width, height = _rectangle(region)
    disparity = np.full((height, width), np.nan, np.float32)
    rows = np.flatnonzero((y + np.arange(height) >= 0) & (y + np.arange(height) < left.shape[0]))
    columns = np.flatnonzero((x + np.arange(width) >= 0) & (x + np.arange(width) < left.shape[1]))
    if rows.size == 0 or columns.size == 0:
        return disparity
    u, v = np.meshgrid(x + columns, y + rows)
    candidates = np.arange(max(first, u[0, 0] - left.shape[1] + 1), min(last, u[0, -1]) + 1)
    if candidates.size == 0:
        return disparity
    most = CLIP if prefilter else 255
    costs = np.stack([window_cost(left_gray, right_gray, u, v, d, window, most) for d in candidates])

    found = costs.argmin(axis=0)  # the first of equal costs
    best = costs.min(axis=0)
    fine = (candidates[found] + fraction(costs, found)).astype(np.float32)
    rejected = (best == NONE) | ambiguous(costs, found, best, uniqueness)
    if ellipse:
        rejected |= ~inscribed(width, height)[np.ix_(rows, columns)]
    if tolerance >= 0:
        rejected |= ~consistent(u, candidates[found], np.where(rejected, NONE, best), tolerance)
    disparity[np.ix_(rows, columns)] = np.where(rejected, np.float32(np.nan), fine)
    return disparity


def x_sobel(image: Image) -> Ints:
    """The slope along x, smoothed along y by 1, 2, 1, clipped at ±31 and increased by 31; edge pixels are
    repeated.
    """
    padded = np.pad(image.astype(np.int64), 1, mode="edge")
    smooth = padded[:-2] + 2 * padded[1:-1] + padded[2:]
    return np.clip(smooth[:, 2:] - smooth[:, :-2], -CLIP, CLIP) + CLIP


def window_cost(left: Ints, right: Ints, u: Ints, v: Ints, d: int, window: int, most: int) -> Ints:
    """The sum in equation (3) for each pixel (u, v), with differences limited to `most`.

    NONE where u - d is outside the right image.
    """
    rows, columns = left.shape
    cost = np.zeros(u.shape, np.int64)
    radius = window // 2
    for j in range(-radius, radius + 1):
        for i in range(-radius, radius + 1):
            row = np.clip(v + j, 0, rows - 1)
            ours, theirs = np.clip(u + i, 0, columns - 1), np.clip(u + i - d, 0, columns - 1)
            cost += np.minimum(abs(left[row, ours] - right[row, theirs]), most)
    return np.where((u - d >= 0) & (u - d < columns), cost, NONE)


def fraction(costs: Ints, found: Ints) -> Disparity:
    """Where two lines of opposite slope through three costs meet, -0.5 to 0.5; 0 at the ends of the range."""
    padded = np.pad(costs, ((1, 1), (0, 0), (0, 0)), constant_values=NONE)
    below, best, above = (np.take_along_axis(padded, found[None] + k, 0)[0] for k in (0, 1, 2))
    rise = np.maximum(2 * (np.maximum(below, above) - best), 1)
    inside = (below != NONE) & (above != NONE)
    lean = (below - above).astype(np.float32) / rise.astype(np.float32)
    return np.asarray(np.where(inside, lean, np.float32(0)))


def ambiguous(costs: Ints, found: Ints, best: Ints, uniqueness: int) -> NDArray[np.bool_]:
    """Whether a candidate not next to the best costs at most ``uniqueness`` percent more."""
    if uniqueness == 0:
        return np.zeros(best.shape, np.bool_)
    apart = abs(np.arange(len(costs))[:, None, None] - found) > 1
    rivals = apart & (costs != NONE) & (100 * costs <= (100 + uniqueness) * best)
    return np.asarray(rivals.any(axis=0))


def inscribed(width: int, height: int) -> NDArray[np.bool_]:
    """(height, width): the pixels whose centers are in the inscribed ellipse."""
    across, down = 2 * np.arange(width) + 1 - width, 2 * np.arange(height)[:, None] + 1 - height
    inside: NDArray[np.bool_] = (across * height) ** 2 + (down * width) ** 2 <= (width * height) ** 2
    return inside


def consistent(u: Ints, disparity: Ints, cost: Ints, tolerance: int) -> NDArray[np.bool_]:
    """The left-right check: whether the pixel matched to the same right column at the lowest cost agrees."""
    agrees = np.ones(u.shape, np.bool_)
    for row in range(len(u)):
        claimed = u[row] - disparity[row]
        for column in np.unique(claimed):
            same = np.flatnonzero(claimed == column)
            winner = same[cost[row, same].argmin()]  # the leftmost of equal costs
            agrees[row, same] = abs(disparity[row, same] - disparity[row, winner]) <= tolerance
    return agrees


def _rectangle(region: Rectangle) -> Rectangle:
    x0, y0, x1, y1 = region
    return x0, y0, x1 - x0, y1 - y0


def _require(left: Image, right: Image, region: Rectangle, limits: Limits, matching: Matching) -> None:
    (first, last), (window, uniqueness, prefilter) = limits, matching
    if left.size == 0:
        refuse("left", "at least one pixel", "none")
    if left.shape != right.shape:
        refuse("right", f"the left image's shape {left.shape}", right.shape)
    _, _, width, height = _rectangle(region)
    if not 1 <= min(width, height) <= max(width, height) <= 16384:
        refuse("region", "a width and height of 1 to 16384", f"{width} x {height}")
    if first > last:
        refuse("last", f"at least first, {first}", last)
    if last - first >= 4096:
        refuse("last", f"at most 4095 above first, {first}", last)
    widest = 31 if prefilter else 15
    if not (1 <= window <= widest and window % 2 == 1):
        refuse("window", f"an odd number, 1 to {widest}", window)
    if not 0 <= uniqueness <= 100:
        refuse("uniqueness", "0 to 100", uniqueness)
