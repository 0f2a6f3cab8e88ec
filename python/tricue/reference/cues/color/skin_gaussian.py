# SPDX-License-Identifier: MIT
"""A Gaussian of skin's chrominance (Vezhnevets, Sazonov, Andreeva 2003, section 4.2)."""

import numpy as np
from numpy.typing import NDArray


def skin_gaussian(
    samples: NDArray[np.uint8], mean: NDArray[np.float64], precision: NDArray[np.float64]
) -> NDArray[np.float32]:
    """Converts the samples to (Cb, Cr), and computes the Gaussian of their Mahalanobis distance."""
    if mean.shape != (2,) or not np.all(np.isfinite(mean)):
        raise ValueError("mean: expected two finite numbers (2,), got others")
    if precision.shape != (2, 2) or not np.all(np.isfinite(precision)):
        raise ValueError("precision: expected finite numbers (2, 2), got others")
    if not np.array_equal(precision, precision.T) or precision[0, 0] <= 0 or np.linalg.det(precision) <= 0:
        raise ValueError("precision: expected a symmetric, positive definite matrix, got another")
    b, g, r = samples.astype(np.float64).transpose(1, 0, 2)
    luma = 0.299 * r + 0.587 * g + 0.114 * b
    cb = 128 + (b - luma) / 1.772 - mean[0]
    cr = 128 + (r - luma) / 1.402 - mean[1]
    squared = precision[0, 0] * cb**2 + 2 * precision[0, 1] * cb * cr + precision[1, 1] * cr**2
    density: NDArray[np.float32] = np.exp(-0.5 * squared).astype(np.float32)
    return density
