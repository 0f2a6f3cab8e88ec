# SPDX-License-Identifier: MIT
"""How much a flow field stretches: a similarity without a turn (Umeyama 1991, equation (42) with R = 1)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse

Plane = NDArray[np.float32]
Floats = NDArray[np.float64]

LANES = 4


def flow_scale(u: Plane, v: Plane, outliers: float, min_pixels: int) -> tuple[float, float, int]:
    """Fits the similarity to the finite pixels, twice."""
    _require(u, v, outliers, min_pixels)
    known = np.isfinite(u) & np.isfinite(v)
    flow = np.where(known, np.stack([u, v]).astype(np.float64), 0)
    first = fit(flow, known, min_pixels)
    if first is None:
        return np.nan, np.nan, int(known.sum())
    _, spread, squares = first
    known &= squares <= outliers * (outliers * spread)
    second = fit(flow, known, min_pixels)
    if second is None:
        return np.nan, np.nan, int(known.sum())
    a, spread, _ = second
    return a, spread, int(known.sum())


def fit(flow: Floats, known: NDArray[np.bool_], min_pixels: int) -> tuple[float, float, Floats] | None:
    """a, its mean squared residual, and the squared residuals (h, w) of a flow (2, h, w), fitted to the known
    pixels; None where there are too few, or just one.
    """
    height, width = known.shape
    x, y = np.meshgrid(np.arange(width) - (width - 1) / 2, np.arange(height) - (height - 1) / 2)
    u, v = flow
    n = int(known.sum())
    if n < min_pixels:
        return None
    sum_x, sum_y, sum_u, sum_v, places, products = (
        added(np.where(known, each, 0)) for each in (x, y, u, v, x * x + y * y, x * u + y * v)
    )
    variance = places - (sum_x * sum_x + sum_y * sum_y) / n
    if variance <= 0:
        return None
    s = (products - (sum_x * sum_u + sum_y * sum_v) / n) / variance
    u0, v0 = (sum_u - s * sum_x) / n, (sum_v - s * sum_y) / n
    squares = (u - s * x - u0) ** 2 + (v - s * y - v0) ** 2
    return 1 - s, added(np.where(known, squares, 0)) / n, squares


def added(values: Floats) -> float:
    """The sum (h, w), of the columns x with one x mod 4 each from row to row, then the first two and the last
    two: the order that makes the kernel's bits the same everywhere.
    """
    lanes = np.pad(values, ((0, 0), (0, -values.shape[1] % LANES))).reshape(-1, LANES)
    a, b, c, d = np.cumsum(np.vstack([np.zeros((1, LANES)), lanes]), axis=0)[-1].tolist()
    return float((a + b) + (c + d))


def _require(u: Plane, v: Plane, outliers: float, min_pixels: int) -> None:
    if v.shape != u.shape:
        refuse("v", f"u's shape {u.shape}", v.shape)
    if not 0 < outliers < np.inf:
        refuse("outliers", "a finite number above 0", float(outliers))
    if min_pixels < 1:
        refuse("min_pixels", "at least 1 pixel", min_pixels)
