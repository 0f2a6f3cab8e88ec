# SPDX-License-Identifier: MIT
"""Kernel density of depth levels (Sabeti, Parvizi, Wu 2008, p(z) of equation (32))."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse


def depth_density(histogram: Floats, bandwidth: float) -> Floats:
    """Convolves the histogram, mirrored at both ends, with a Gaussian."""
    total = _require_histogram(histogram)
    levels = len(histogram)
    if not 0 < bandwidth <= levels:
        refuse("bandwidth", f"a number in (0, {levels}]", float(bandwidth))
    if total == 0:
        return np.zeros(levels)
    radius = int(np.ceil(4 * bandwidth))
    kernel = np.exp(-0.5 * (np.arange(-radius, radius + 1) / bandwidth) ** 2)
    mirrored = np.pad(histogram / total, radius, mode="symmetric")
    density: Floats = np.convolve(mirrored, kernel / kernel.sum(), mode="valid")
    return density


def _require_histogram(histogram: Floats) -> float:
    if len(histogram) < 1:
        refuse("histogram", "at least one level", "none")
    strange = histogram[~(np.isfinite(histogram) & (histogram >= 0))]
    if strange.size:
        refuse("histogram", "finite numbers, none negative", float(strange[0]))
    with np.errstate(over="ignore"):
        total = float(histogram.sum())
    if not np.isfinite(total):
        refuse("histogram", "a finite sum", total)
    return total
