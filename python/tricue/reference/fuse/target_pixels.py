# SPDX-License-Identifier: MIT
"""Which pixels belong to the target, by Bayes' rule (Okada, Shirai, Miura 1996, sections 4.1 and 4.3)."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Plane
from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.fuse.detail.rectangle_pixels import Rectangle, rectangle_pixels, require_finite_corners
from tricue.reference.fuse.detail.value_bins import require_range, value_bins

MAX_RATIO = 1e12  # the product of three fits in a float32


def target_pixels(
    planes: Sequence[Plane],
    densities: Sequence[Floats],
    ranges: Sequence[tuple[float, float]],
    window: Rectangle,
    candidate: Rectangle,
    threshold: float = 0.5,
    alternatives: Sequence[Floats] | None = None,
) -> tuple[NDArray[np.uint8], Plane]:
    """Looks up each cue's likelihood ratio, and multiplies the ratios by the prior."""
    _require(planes, densities, ranges, threshold)
    if alternatives is not None:
        _require_alternatives(alternatives, densities)
    shape = planes[0].shape
    prior = _prior(window, candidate, shape)
    ratio = np.ones(shape, np.float32)  # P(F | obj) over that of the alternative, (12)
    for k, (plane, density, (low, high)) in enumerate(zip(planes, densities, ranges, strict=True)):
        table = _ratios(density, None if alternatives is None else alternatives[k])
        ratio *= table[value_bins(plane, low, high, len(density))]
    product = prior * ratio  # P(obj) L / A
    posterior = product / (product + np.float32(1))  # (11)
    return (posterior.astype(np.float64) >= threshold).astype(np.uint8), posterior


def _ratios(density: Floats, alternative: Floats | None) -> Plane:
    """(bins + 1,): the likelihood ratio of target and alternative; the last, 0, is for no value."""
    if alternative is None:
        return np.append(density * len(density), 0).astype(np.float32)
    with np.errstate(over="ignore"):
        ratio = np.minimum(density / alternative, MAX_RATIO)
    return np.append(ratio, 0).astype(np.float32)


def _prior(window: Rectangle, candidate: Rectangle, shape: tuple[int, ...]) -> Plane:
    """(H, W): the smaller one of a column's and a row's: pixels with equal priors form a rectangle."""
    require_finite_corners(window, "window")
    rows, columns = rectangle_pixels(candidate, shape, "candidate")
    x = _ramp(window[0], window[2], candidate[0], candidate[2], shape[1])
    y = _ramp(window[1], window[3], candidate[1], candidate[3], shape[0])
    prior = np.zeros(shape, np.float32)
    prior[rows, columns] = np.minimum(x[columns], y[rows, None])
    return prior


def _ramp(inner: float, inner_end: float, outer: float, outer_end: float, size: int) -> Plane:
    """(size,): rises from 0 at outer to 1 at inner, falls from 1 at inner_end to 0 at outer_end.

    There is no slope on a side where the window reaches the candidate region's edge.
    """
    center = np.arange(size) + 0.5
    ramp = np.ones(size)
    with np.errstate(over="ignore"):  # for a slope that is nearly a step
        if inner > outer:
            ramp = np.minimum(ramp, (center - outer) / (inner - outer))
        if inner_end < outer_end:
            ramp = np.minimum(ramp, (outer_end - center) / (outer_end - inner_end))
    return np.maximum(ramp, 0).astype(np.float32)


def _require(
    planes: Sequence[Plane],
    densities: Sequence[Floats],
    ranges: Sequence[tuple[float, float]],
    threshold: float,
) -> None:
    if not 1 <= len(planes) <= 3:
        refuse("planes", "1 to 3", len(planes))
    for plane in planes:
        if plane.shape != planes[0].shape:
            refuse("planes", f"shape {planes[0].shape}", plane.shape)
    for name, each in (("densities", densities), ("ranges", ranges)):
        if len(each) != len(planes):
            refuse(name, f"{len(planes)}, as many as planes", len(each))
    for density, (low, high) in zip(densities, ranges, strict=True):
        require_range(low, high, len(density))
        _require_density(density)
    if not 0 < threshold <= 1:
        refuse("threshold", "a number in (0, 1]", float(threshold))


def _require_density(density: Floats) -> None:
    strange = density[~(np.isfinite(density) & (density >= 0))]
    if strange.size:
        refuse("densities", "finite numbers, none negative", float(strange[0]))
    total = float(density.sum())
    if total != 0 and not abs(total - 1) <= 1e-6:
        refuse("densities", "a sum of 1, or of 0", total)


def _require_alternatives(alternatives: Sequence[Floats], densities: Sequence[Floats]) -> None:
    if len(alternatives) != len(densities):
        refuse("alternatives", f"{len(densities)}, as many as planes", len(alternatives))
    for alternative, density in zip(alternatives, densities, strict=True):
        require_shape("alternatives", alternative, density.shape)
        strange = alternative[~(np.isfinite(alternative) & (alternative > 0))]
        if strange.size:
            refuse("alternatives", "finite numbers above 0", float(strange[0]))
        with np.errstate(over="ignore"):
            total = float(alternative.sum())
        if not total <= 1 + 1e-6:
            refuse("alternatives", "a sum of at most 1", total)
