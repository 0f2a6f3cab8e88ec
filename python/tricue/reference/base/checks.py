# SPDX-License-Identifier: MIT
"""Checks of the twins' arguments, with the native kernels' messages."""

from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats

Dynamics = tuple[Floats, Floats]  # drift, scale
Detection = tuple[Floats, Floats, float]  # mean, root, share

MAX_IMAGE_SIDE = 16384  # of an image that a kernel makes, pixels


def refuse(name: str, expected: str, got: object) -> NoReturn:
    """Raise a ValueError with the argument's name, what was expected and what was given."""
    text = f"{got:g}" if isinstance(got, float) else str(got)
    raise ValueError(f"{name}: expected {expected}, got {text}")


def require_count(name: str, count: int, least: int, most: int) -> None:
    """Refuse a count, such as of rows or levels, that is out of range."""
    if not least <= count <= most:
        refuse(name, f"{least} to {most}", count)


def require_shape(name: str, values: NDArray[Any], shape: tuple[int, ...]) -> None:
    """Refuse any other shape."""
    if values.shape != shape:
        refuse(name, f"shape {shape}", values.shape)


def require_finite(name: str, values: Floats) -> None:
    """Refuse NaN and infinity."""
    strange = values[~np.isfinite(values)]
    if strange.size:
        refuse(name, "finite numbers", float(strange[0]))


def require_covariance(name: str, values: Floats, size: int) -> None:
    """Refuse a matrix that isn't square, finite and symmetric, or has negative variances."""
    require_shape(name, values, (size, size))
    require_finite(name, values)
    variances = values.diagonal()
    if variances.min(initial=0) < 0:
        refuse(name, "no negative variance", float(variances.min()))
    skew = float(abs(values - values.T).max(initial=0))
    if skew > 1e-9 * variances.max(initial=0):
        refuse(name, "a symmetric matrix", f"entries that differ by {skew:f}")


def require_weights(weights: Floats) -> None:
    """Refuse weights that are negative, not finite, or without a finite sum above 0."""
    strange = weights[~(np.isfinite(weights) & (weights >= 0))]
    if strange.size:
        refuse("weights", "finite numbers, none negative", float(strange[0]))
    with np.errstate(over="ignore"):
        total = float(weights.sum())
    if not 0 < total < np.inf:
        refuse("weights", "a finite sum above 0", total)


def require_dynamics(dynamics: Dynamics, dimensions: int) -> None:
    """Refuse dynamics that have another size, aren't finite, or have a negative scale."""
    drift, scale = dynamics
    for name, values in (("drift", drift), ("scale", scale)):
        require_shape(name, values, (dimensions,))
        require_finite(name, values)
    if np.any(scale < 0):
        refuse("scale", "no negative number", float(scale.min()))


def require_detection(detection: Detection, dimensions: int) -> None:
    """Refuse a share outside [0, 1), and, if the share is above 0, an invalid Gaussian."""
    mean, root, share = detection
    if not 0 <= share < 1:
        refuse("share", "a number in [0, 1)", share)
    if not 1 <= mean.size <= dimensions:
        refuse("mean", f"1 to {dimensions} numbers", mean.size)
    require_shape("root", root, (mean.size, mean.size))
    if share == 0:
        return
    for name, values in (("mean", mean), ("root", root)):
        require_finite(name, values)
    if not root.diagonal().min() > 0:
        refuse("root", "a diagonal above 0", float(root.diagonal().min()))
