# SPDX-License-Identifier: MIT
"""P(target | depth) on a grid of squares, and which squares are in front of the target."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth
from tricue.reference.base.checks import MAX_GRID_SIDE, refuse, require_count

CLUTTER = 0.1  # likelihood of any depth of the background, relative to the target's at the expected depth


def depth_posterior(
    depth: Depth,
    x0: float,
    y0: float,
    step: float,
    rows: int,
    columns: int,
    expected: float,
    sigma: float,
    occluder_margin: float,
) -> tuple[Depth, NDArray[np.uint8]]:
    """Applies Bayes' rule to the depth under the center of one square at a time."""
    _require_arguments(x0, y0, step, rows, columns, expected, sigma, occluder_margin)
    posterior, nearer = np.full((rows, columns), 0.5), np.zeros((rows, columns), np.uint8)
    for i, j in np.ndindex(rows, columns):
        x, y = x0 + (j + 0.5) * step, y0 + (i + 0.5) * step
        if not (0 <= x < depth.shape[1] and 0 <= y < depth.shape[0]):
            continue
        z = float(depth[int(y), int(x)])
        if 0 < z < np.inf:
            likelihood = np.exp(-0.5 * min(abs(z - expected) / sigma, 1e3) ** 2)
            posterior[i, j] = likelihood / (likelihood + CLUTTER)
            nearer[i, j] = z < expected - occluder_margin
    return posterior.astype(np.float32), nearer


def _require_arguments(
    x0: float,
    y0: float,
    step: float,
    rows: int,
    columns: int,
    expected: float,
    sigma: float,
    occluder_margin: float,
) -> None:
    for name, number in (("x0", x0), ("y0", y0)):
        if not np.isfinite(number):
            refuse(name, "a finite number", float(number))
    for name, count in (("rows", rows), ("columns", columns)):
        require_count(name, count, 1, MAX_GRID_SIDE)
    for name, number in (("step", step), ("expected", expected), ("sigma", sigma)):
        if not 0 < number < np.inf:
            refuse(name, "a finite number above 0", float(number))
    if not 0 <= occluder_margin < np.inf:
        refuse("occluder_margin", "a finite number, not negative", float(occluder_margin))
