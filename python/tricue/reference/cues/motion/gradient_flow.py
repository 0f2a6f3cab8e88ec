# SPDX-License-Identifier: MIT
"""Flow by the generalized gradient method with two filters (Okada, Shirai and Miura 1996, section 2)."""

import numpy as np

from tricue.reference.base.arrays import Floats, Image, Plane
from tricue.reference.base.checks import refuse
from tricue.reference.base.gaussian import correlate, gaussian_taps, require_sigma

Rectangle = tuple[int, int, int, int]

LONGEST = np.pi / np.sqrt(2)  # sigmas: half of the wavelength that a Gaussian's second derivatives pass best
ROUNDING = 1e-6  # the contrast that rounding of 32-bit sums leaves where there is none


def gradient_flow(
    previous: Image,
    current: Image,
    sigma: float,
    min_angle: float,
    min_contrast: float,
    region: Rectangle | None = None,
) -> tuple[Plane, Plane, Plane, Plane]:
    """Filters both frames, and solves the two constraints at each pixel."""
    require_frames(previous, current, region)
    require_sigma(sigma)
    require_reliabilities(min_angle, min_contrast)
    before, now = previous.astype(np.float64), current.astype(np.float64)
    planes = solve(*constraints(before, now, sigma), min_angle, min_contrast, LONGEST * sigma)
    x0, y0, x1, y1 = region or (0, 0, current.shape[1], current.shape[0])
    u, v, angle, contrast = (np.ascontiguousarray(plane[y0:y1, x0:x1], np.float32) for plane in planes)
    return u, v, angle, contrast


def constraints(before: Floats, now: Floats, sigma: float) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """(g*f)_x, (g*f)_y = (h*f)_x, (h*f)_y of the mean of both frames, and (g*f)_t, (h*f)_t: equation (4)."""
    bell, slope, curve = (gaussian_taps(sigma, order) for order in (0, 1, 2))
    mean, change = (before + now) / 2, now - before
    g_x, g_y, h_y = correlate(mean, curve, bell), correlate(mean, slope, slope), correlate(mean, bell, curve)
    return g_x, g_y, h_y, correlate(change, slope, bell), correlate(change, bell, slope)


def solve(
    g_x: Floats,
    g_y: Floats,
    h_y: Floats,
    g_t: Floats,
    h_t: Floats,
    min_angle: float,
    min_contrast: float,
    longest: float,
) -> tuple[Floats, Floats, Floats, Floats]:
    """Solves (4), its right side negated as in (3), by Cramer's rule; NaN where (5) or (6) is too small."""
    h_x = g_y
    cross = g_x * h_y - g_y * h_x  # G x H
    g, h = g_x**2 + g_y**2, h_x**2 + h_y**2  # |G|^2, |H|^2
    clear = (g >= ROUNDING) & (h >= ROUNDING)
    angle = np.divide(abs(cross), np.sqrt(g * h), out=np.zeros_like(g), where=clear)
    contrast = g + h
    kept = (angle > 0) & (angle >= min_angle) & (contrast >= min_contrast)
    u, v = (np.full(cross.shape, np.nan) for _ in range(2))
    np.divide(g_y * h_t - h_y * g_t, cross, out=u, where=kept)
    np.divide(h_x * g_t - g_x * h_t, cross, out=v, where=kept)
    u[np.hypot(u, v) > longest] = np.nan
    return u, np.where(np.isnan(u), np.nan, v), angle, contrast


def require_frames(previous: Image, current: Image, region: Rectangle | None) -> None:
    """Refuse frames without pixels or of different sizes, and regions that aren't in them."""
    if previous.size == 0:
        refuse("previous", "at least one pixel", "none")
    if current.shape != previous.shape:
        refuse("current", f"the previous frame's shape {previous.shape}", current.shape)
    if region is None:
        return
    x0, y0, x1, y1 = region
    height, width = current.shape
    if not (0 <= x0 <= x1 <= width and 0 <= y0 <= y1 <= height):
        refuse("region", f"x0, y0, x1, y1 in order, within {width} x {height}", region)


def require_reliabilities(min_angle: float, min_contrast: float) -> None:
    """Refuse minima out of range."""
    if not 0 <= min_angle <= 1:
        refuse("min_angle", "0 to 1", float(min_angle))
    if not 0 <= min_contrast < np.inf:
        refuse("min_contrast", "a finite number, not negative", float(min_contrast))
