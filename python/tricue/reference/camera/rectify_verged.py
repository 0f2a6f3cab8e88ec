# SPDX-License-Identifier: MIT
"""The right image of a verged pair, rectified (Okada, Shirai, Miura 1996, section 3.1, equation (8))."""

import numpy as np

from tricue.reference.base.arrays import Floats, Image
from tricue.reference.base.checks import refuse

UNIT = 2048  # places are rounded to this fraction of a pixel


def rectify_verged(
    right: Image,
    angle: float,
    focal: float,
    center: tuple[float, float] | None = None,
    shift: float = 0.0,
    rows_only: bool = False,
) -> Image:
    """Maps the pixels of the parallel camera into the turned one, and interpolates bilinearly."""
    rows, columns = right.shape[:2]
    cx, cy = ((columns - 1) / 2, (rows - 1) / 2) if center is None else center
    _require(right, angle, focal, (cx, cy), shift)
    x = np.arange(columns) - shift - cx
    y = np.arange(rows)[:, None] - cy
    if rows_only:
        source_x, stretch = x, np.cos(angle) + x * np.sin(angle) / focal  # (8), in parentheses
    else:
        source_x, stretch = turned(x, angle, focal)
    return bilinear(right, cx + source_x, cy + y * stretch)


def turned(x: Floats, angle: float, focal: float) -> tuple[Floats, Floats]:
    """The column of the turned camera for column x of the parallel one, and y_R / y_L there; NaN behind it.

    A ray (x, y, f) of the parallel camera is (x cos a + f sin a, y, f cos a - x sin a) in the turned one.
    """
    ahead = focal * np.cos(angle) - x * np.sin(angle)
    ahead = np.where(ahead > 0, ahead, np.nan)
    stretch = focal / ahead
    return (x * np.cos(angle) + focal * np.sin(angle)) * stretch, stretch


def bilinear(image: Image, x: Floats, y: Floats) -> Image:
    """The image at columns x (W,) and rows y (H, W), rounded half up; black outside the image."""
    rows, columns = image.shape[:2]
    x, y = np.floor(np.broadcast_to(x, y.shape) * UNIT + 0.5), np.floor(y * UNIT + 0.5)
    inside = (x >= 0) & (x <= (columns - 1) * UNIT) & (y >= 0) & (y <= (rows - 1) * UNIT)
    (i, across), (j, down) = (divmod(np.where(inside, p, 0).astype(np.int64), UNIT) for p in (x, y))
    if image.ndim == 3:
        across, down, inside = across[..., None], down[..., None], inside[..., None]
    i1, j1 = np.minimum(i + 1, columns - 1), np.minimum(j + 1, rows - 1)
    pixels = image.astype(np.int64)
    upper = pixels[j, i] * (UNIT - across) + pixels[j, i1] * across
    lower = pixels[j1, i] * (UNIT - across) + pixels[j1, i1] * across
    value = (upper * (UNIT - down) + lower * down + UNIT * UNIT // 2) // (UNIT * UNIT)
    return np.where(inside, value, 0).astype(np.uint8)


def _require(right: Image, angle: float, focal: float, center: tuple[float, float], shift: float) -> None:
    if right.size == 0:
        refuse("right", "at least one pixel", "none")
    if not abs(angle) < np.pi / 2:
        refuse("angle", "radians between -pi/2 and pi/2", float(angle))
    if not 0 < focal < np.inf:
        refuse("focal", "a finite number above 0", float(focal))
    for name, value in (("center", center[0]), ("center", center[1]), ("shift", shift)):
        if not np.isfinite(value):
            refuse(name, "finite numbers" if name == "center" else "a finite number", float(value))
