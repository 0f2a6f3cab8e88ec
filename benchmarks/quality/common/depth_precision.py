# SPDX-License-Identifier: MIT
"""How precise depth is: quantization, noise on flat patches, and flying pixels between two surfaces."""

from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from benchmarks.quality.common.depth_holes import MIN_STEP

Array = NDArray[np.float64]
DISTANCES = (0.5, 1.0, 2.0, 3.0, 4.0)
"""Meters: distances at which noise and quantization are measured, each within a fifth."""
PATCH = 11
"""Side of a patch that is assumed to be flat, pixels."""
FLAT_PERCENTILE = 25
"""Quantile of the patches' deviations from a plane that is used, as most patches are curved or have edges."""
MIN_PATCHES = 30
MIN_LEVEL_COUNT = 20
"""Pixels that a depth in whole millimeters needs, to count as a level of the sensor."""
FLYING_MARGIN = 0.2
"""Share of a step: depths that close to a surface belong to that surface."""


class FlatNoise(NamedTuple):
    """Noise on flat patches. deviation: meters. grain: correlation between neighbors in a row."""

    deviation: float
    grain: float


def quantization(depths: Array, distance: float) -> float:
    """The median difference between the levels of depths (n,) near a distance, meters.

    NaN with fewer than three levels. Depths are taken as whole millimeters, as files have them.
    """
    near = depths[np.abs(depths - distance) < 0.1 * distance]
    levels, counts = np.unique(np.rint(1000 * near), return_counts=True)
    known = levels[counts >= MIN_LEVEL_COUNT]
    return float(np.median(np.diff(known)) / 1000) if len(known) > 2 else float("nan")


def flat_patches(depth: Array) -> Array:
    """The patches (n, PATCH, PATCH) of a grid over a depth image in which every pixel has depth."""
    rows, columns = (side // PATCH * PATCH for side in depth.shape)
    grid = depth[:rows, :columns].reshape(rows // PATCH, PATCH, columns // PATCH, PATCH).swapaxes(1, 2)
    patches = grid.reshape(-1, PATCH, PATCH)
    return np.asarray(patches[np.isfinite(patches).all(axis=(1, 2))])


def flat_noise(patches: Array, distance: float) -> FlatNoise:
    """The noise of patches (n, PATCH, PATCH) near a distance, around their planes; NaN if they are few."""
    middle = np.median(patches, axis=(1, 2))
    near = patches[np.abs(middle - distance) < 0.2 * distance]
    if len(near) < MIN_PATCHES:
        return FlatNoise(float("nan"), float("nan"))
    v, u = (side.ravel() - PATCH // 2 for side in np.indices((PATCH, PATCH)))
    design = np.column_stack([np.ones(PATCH**2), u, v])
    flat = near.reshape(len(near), -1)
    residuals = (flat - flat @ np.linalg.pinv(design).T @ design.T).reshape(near.shape)
    deviations = np.sqrt((residuals**2).sum(axis=(1, 2)) / (PATCH**2 - 3))
    limit = float(np.percentile(deviations, FLAT_PERCENTILE))
    flattest = residuals[deviations <= limit]
    power = (flattest**2).mean()
    grain = float((flattest[..., 1:] * flattest[..., :-1]).mean() / power) if power else float("nan")
    return FlatNoise(limit, grain)


def flying_pixels(depth: Array) -> tuple[int, int]:
    """The number of steps without a gap along a depth image's rows (H, W), and of pixels between their sides.

    A step is between two pixels four columns apart with all between them measured.
    """
    windows = sliding_window_view(depth, 5, axis=1)
    first, last = windows[..., 0], windows[..., 4]
    near, far = np.minimum(first, last), np.maximum(first, last)
    with np.errstate(invalid="ignore"):
        step = np.isfinite(windows).all(axis=2) & (far - near > MIN_STEP * near)
    margin = FLYING_MARGIN * (far - near)[step]
    middle = windows[..., 2][step]
    between = (middle > near[step] + margin) & (middle < far[step] - margin)
    # A clean step is seen from four columns, one with a pixel between from three or four.
    return round(int(step.sum()) / 4), int(between.sum())
