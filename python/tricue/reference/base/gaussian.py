# SPDX-License-Identifier: MIT
"""Gaussians and their derivatives, sampled and truncated, and separable correlation with them."""

import math

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse

REACH = 3.5  # sigmas on each side, to the outer edge of the last pixel


def reach(sigma: float) -> int:
    """The radius of the sampled Gaussian, pixels."""
    return math.ceil(REACH * sigma - 0.5)


def gaussian_taps(sigma: float, order: int) -> Floats:
    """(2 r + 1,) weights of the derivative of an order, 0 to 2, for correlation.

    Scaled so that derivatives of polynomials are exact: order 0 sums to 1, order 1 gives 1 on the ramp x,
    order 2 gives 0 on a constant and 2 on the parabola x^2.
    """
    radius = reach(sigma)
    x = np.arange(-radius, radius + 1, dtype=np.float64)
    bell = np.exp(-(x**2) / (2 * sigma**2))
    bell /= bell.sum()
    if order == 0:
        return np.asarray(bell)
    if order == 1:
        return np.asarray(x * bell / (x**2 * bell).sum())
    curve = (x**2 - (x**2 * bell).sum()) * bell
    return np.asarray(2 * curve / (x**2 * curve).sum())


def correlate(image: Floats, across: Floats, down: Floats) -> Floats:
    """The image (H, W) correlated with taps along x and taps along y; edge pixels are repeated."""
    for taps, axis in ((across, 1), (down, 0)):
        radius = len(taps) // 2
        padded = np.pad(image, [(radius, radius) if axis == a else (0, 0) for a in (0, 1)], mode="edge")
        size = image.shape[axis]
        image = sum(
            (tap * np.take(padded, range(i, i + size), axis) for i, tap in enumerate(taps)),
            start=np.zeros_like(image),
        )
    return image


def require_sigma(sigma: float) -> None:
    """Refuse Gaussians that are too narrow to sample, or wider than useful."""
    if not 0.5 <= sigma <= 16:
        refuse("sigma", "0.5 to 16 pixels", float(sigma))
