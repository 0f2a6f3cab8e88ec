# SPDX-License-Identifier: MIT
"""The mixture proposal (Sabeti, Parvizi, Wu 2008, section III.A and equation (30))."""

import numpy as np

from tricue.reference.base import checks
from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import Detection, Dynamics


def propose(
    particles: Floats, dynamics: Dynamics, noise: Floats, detection: Detection, bounds: tuple[Floats, Floats]
) -> Floats:
    """Moves all particles, then redraws those at which floor(share i) increases from the detection."""
    (drift, scale), (mean, root, share), (lower, upper) = dynamics, detection, bounds
    _check(particles, noise, lower, upper)
    checks.require_dynamics(dynamics, particles.shape[1])
    checks.require_detection(detection, particles.shape[1])
    moved = particles + drift + scale * noise
    passed = np.floor(np.arange(len(particles) + 1) * share)
    detected = np.diff(passed) > 0
    for d in range(len(mean)):
        moved[detected, d] = mean[d]
        for e in range(d + 1):
            moved[detected, d] += root[d, e] * noise[detected, e]
    return np.asarray(np.clip(moved, lower, upper))


def _check(particles: Floats, noise: Floats, lower: Floats, upper: Floats) -> None:
    dimensions = particles.shape[1]
    checks.require_shape("noise", noise, particles.shape)
    checks.require_finite("particles", particles)
    checks.require_finite("noise", noise)
    checks.require_shape("lower", lower, (dimensions,))
    checks.require_shape("upper", upper, (dimensions,))
    crossed = ~(lower <= upper)
    if crossed.any():
        checks.refuse("lower", "no number above upper", float(lower[crossed][0]))
