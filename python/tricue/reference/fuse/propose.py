# SPDX-License-Identifier: MIT
"""The mixture proposal (Sabeti, Parvizi, Wu 2008, section III.A and equation (30))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base import checks


def propose(
    particles: NDArray[np.float64],
    drift: NDArray[np.float64],
    scale: NDArray[np.float64],
    noise: NDArray[np.float64],
    mean: NDArray[np.float64],
    root: NDArray[np.float64],
    share: float,
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Moves all particles, then redraws those at which floor(share i) increases from the detection."""
    _check(particles, noise, lower, upper)
    checks.require_dynamics(drift, scale, particles.shape[1])
    checks.require_detection(mean, root, share, particles.shape[1])
    moved = particles + drift + scale * noise
    passed = np.floor(np.arange(len(particles) + 1) * share)
    detected = np.diff(passed) > 0
    for d in range(len(mean)):
        moved[detected, d] = mean[d]
        for e in range(d + 1):
            moved[detected, d] += root[d, e] * noise[detected, e]
    return np.clip(moved, lower, upper)


def _check(
    particles: NDArray[np.float64],
    noise: NDArray[np.float64],
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
) -> None:
    dimensions = particles.shape[1]
    checks.require_shape("noise", noise, particles.shape)
    checks.require_finite("particles", particles)
    checks.require_finite("noise", noise)
    checks.require_shape("lower", lower, (dimensions,))
    checks.require_shape("upper", upper, (dimensions,))
    crossed = ~(lower <= upper)
    if crossed.any():
        checks.refuse("lower", "no number above upper", float(lower[crossed][0]))
