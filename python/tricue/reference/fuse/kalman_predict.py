# SPDX-License-Identifier: MIT
"""Kalman prediction (Kalman 1960; Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, equation (6))."""

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import require_covariance, require_finite, require_shape
from tricue.reference.fuse.detail.gaussian_state import require_belief, symmetric


def kalman_predict(
    mean: Floats, covariance: Floats, transition: Floats, noise: Floats
) -> tuple[Floats, Floats]:
    """Multiplies the matrices."""
    require_belief(mean, covariance)
    require_shape("transition", transition, (mean.size, mean.size))
    require_finite("transition", transition)
    require_covariance("noise", noise, mean.size)
    return transition @ mean, symmetric(transition @ covariance @ transition.T + noise)
