# SPDX-License-Identifier: MIT
"""P(target | depth) on a grid of squares, and which squares are in front of the target."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth
from tricue.reference.base.checks import refuse
from tricue.reference.cues.depth.detail.sample_grid import SampleGrid, require_grid

CLUTTER = 0.1  # likelihood of any depth of the background, relative to the target's at the expected depth


def depth_posterior(
    depth: Depth, grid: SampleGrid, target: tuple[float, float, float]
) -> tuple[Depth, NDArray[np.uint8]]:
    """Applies Bayes' rule to the depth under the center of one square at a time."""
    (x0, y0, step, rows, columns), (expected, sigma, occluder_margin) = grid, target
    require_grid(grid)
    _require_target(expected, sigma, occluder_margin)
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


def _require_target(expected: float, sigma: float, occluder_margin: float) -> None:
    for name, number in (("expected", expected), ("sigma", sigma)):
        if not 0 < number < np.inf:
            refuse(name, "a finite number above 0", float(number))
    if not 0 <= occluder_margin < np.inf:
        refuse("occluder_margin", "a finite number, not negative", float(occluder_margin))
