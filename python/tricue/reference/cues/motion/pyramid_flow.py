# SPDX-License-Identifier: MIT
"""Gradient flow from coarse to fine (Okada, Shirai and Miura 1996, section 2, on an image pyramid)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Image, Plane
from tricue.reference.base.checks import refuse
from tricue.reference.base.gaussian import correlate, reach, require_sigma
from tricue.reference.cues.motion.gradient_flow import (
    ROUNDING,
    Rectangle,
    constraints,
    require_frames,
    require_reliabilities,
)

Ints = NDArray[np.int64]

BINOMIAL = np.array([1, 4, 6, 4, 1]) / 16
LONGEST_STEP = 2.0  # px along x and y, at all levels but the finest


def pyramid_flow(
    previous: Image,
    current: Image,
    sigma: float,
    levels: int,
    min_angle: float,
    min_contrast: float,
    region: Rectangle | None = None,
    pool: int = 3,
    max_step: float = 0.4,
) -> tuple[Plane, Plane, Plane, Plane]:
    """Warps, pools the constraints over windows and solves them, level by level."""
    require_frames(previous, current, region)
    require_sigma(sigma)
    _require(levels, pool, max_step)
    require_reliabilities(min_angle, min_contrast)
    areas = [region or (0, 0, current.shape[1], current.shape[0])]
    if areas[0][0] == areas[0][2] or areas[0][1] == areas[0][3]:
        nothing = (areas[0][3] - areas[0][1], areas[0][2] - areas[0][0])
        u, v, angle, contrast = (np.zeros(nothing, np.float32) for _ in range(4))
        return u, v, angle, contrast
    before, now = [previous.astype(np.float64)], [current.astype(np.float64)]
    for _ in range(levels - 1):
        before.append(halved(before[-1]))
        now.append(halved(now[-1]))
        areas.append(halved_area(areas[-1], now[-1]))

    flow = np.zeros((2, areas[-1][3] - areas[-1][1], areas[-1][2] - areas[-1][0]))
    for level in reversed(range(1, levels)):
        step, _, _ = measure(before[level], now[level], areas[level], flow, sigma, pool)
        flow = flow + step.clip(-LONGEST_STEP, LONGEST_STEP)
        flow = doubled(np.stack([median(plane) for plane in flow]), areas[level], areas[level - 1])
    step, angle, contrast = measure(before[0], now[0], areas[0], flow, sigma, pool)
    kept = (contrast >= ROUNDING) & (contrast >= min_contrast) & (angle >= min_angle)
    kept &= (step**2).sum(axis=0) <= max_step**2
    flow = np.where(kept, flow + step, np.nan)
    u, v, angle, contrast = (plane.astype(np.float32) for plane in (*flow, angle, contrast))
    return u, v, angle, contrast


def measure(
    before: Floats, now: Floats, area: Rectangle, flow: Floats, sigma: float, pool: int
) -> tuple[Floats, Floats, Floats]:
    """The step (2, h, w) from a flow to a better one, and both reliabilities, in an area.

    Least squares on the two constraints (4) of all pixels in a window, with `before` warped toward `now`. The
    flow at the area's edge, and the pixels at a frame's edge, are repeated beyond it.
    """
    x0, y0, x1, y1 = area
    margin = reach(sigma) + pool
    y, x = np.arange(y0 - margin, y1 + margin), np.arange(x0 - margin, x1 + margin)
    around = flow[:, y.clip(y0, y1 - 1)[:, None] - y0, x.clip(x0, x1 - 1) - x0]
    inner = now[y.clip(0, now.shape[0] - 1)[:, None], x.clip(0, now.shape[1] - 1)]
    warped = bilinear(before, x - around[0], y[:, None] - around[1])
    g_x, g_y, h_y, g_t, h_t = constraints(warped, inner, sigma)
    h_x = g_y

    # The normal equations of (4), A^T A w = -A^T b, damped by what rounding of gray levels adds to A^T A.
    box = np.full(2 * pool + 1, 1 / (2 * pool + 1))
    crop = np.s_[margin : margin + y1 - y0, margin : margin + x1 - x0]
    products = (
        g_x**2 + h_x**2,
        g_x * g_y + h_x * h_y,
        g_y**2 + h_y**2,
        g_x * g_t + h_x * h_t,
        g_y * g_t + h_y * h_t,
    )
    xx, xy, yy, xt, yt = (correlate(product, box, box)[crop] for product in products)
    damping = rounding_noise(sigma)
    determinant = np.maximum(xx * yy - xy**2, 0)
    step = np.stack([xy * yt - (yy + damping) * xt, xy * xt - (xx + damping) * yt])
    step /= determinant + damping * (xx + yy + damping)
    # For one pixel, (5) is |G x H| / (|G| |H|) = |sin|. Where |G| = |H|, 2 sqrt(det) / trace is the same.
    contrast = xx + yy
    root = np.sqrt(determinant)
    angle = np.divide(2 * root, contrast, out=np.zeros_like(root), where=contrast > 0)
    return step, angle, contrast


def rounding_noise(sigma: float) -> float:
    """The contrast (6) of the mean of two frames that have only rounding noise, of variance 1/12 each.

    It follows from the integral of the squared filters.
    """
    return 1 / (48 * np.pi * sigma**6)


def halved(image: Floats) -> Floats:
    """Every second pixel, from the first, of the image smoothed by 1, 4, 6, 4, 1 and rounded."""
    return np.asarray(np.floor(correlate(image, BINOMIAL, BINOMIAL)[::2, ::2] + 0.5))


def halved_area(area: Rectangle, image: Floats) -> Rectangle:
    """The pixels of a level between which an area of the next finer level lies."""
    x0, y0, x1, y1 = area
    return x0 // 2, y0 // 2, min(x1 // 2 + 1, image.shape[1]), min(y1 // 2 + 1, image.shape[0])


def doubled(flow: Floats, area: Rectangle, finer: Rectangle) -> Floats:
    """The flow at the next finer level, interpolated linearly; in finer pixels it is twice as long."""
    x, y = np.arange(finer[0], finer[2]) / 2 - area[0], np.arange(finer[1], finer[3])[:, None] / 2 - area[1]
    return np.stack([2 * bilinear(plane, x + 0 * y, y + 0 * x) for plane in flow])


def bilinear(image: Floats, x: Floats, y: Floats) -> Floats:
    """The image interpolated bilinearly at x, y; edge pixels are repeated."""
    x, y = x.clip(0, image.shape[1] - 1), y.clip(0, image.shape[0] - 1)
    left, top = x.astype(np.int64), y.astype(np.int64)
    right, bottom = (left + 1).clip(max=image.shape[1] - 1), (top + 1).clip(max=image.shape[0] - 1)
    a, b = x - left, y - top
    upper = (1 - a) * image[top, left] + a * image[top, right]
    lower = (1 - a) * image[bottom, left] + a * image[bottom, right]
    return np.asarray((1 - b) * upper + b * lower)


def median(plane: Floats) -> Floats:
    """The median of 3x3 pixels; edge pixels are repeated."""
    padded = np.pad(plane, 1, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3))
    return np.asarray(np.median(windows, axis=(2, 3)))


def _require(levels: int, pool: int, max_step: float) -> None:
    if not 2 <= levels <= 8:
        refuse("levels", "2 to 8", levels)
    if not 0 <= pool <= 16:
        refuse("pool", "0 to 16 pixels", pool)
    if not max_step > 0:
        refuse("max_step", "a number above 0", float(max_step))
