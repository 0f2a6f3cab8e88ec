# SPDX-License-Identifier: MIT
"""Bhattacharyya distance (1943), in the form of Comaniciu, Ramesh, Meer 2003."""

import numpy as np
from numpy.typing import NDArray


def bhattacharyya(
    histograms: NDArray[np.float32], model: NDArray[np.float32], groups: int
) -> NDArray[np.float64]:
    """Sums sqrt(p q) in each row."""
    bins = histograms.shape[1]
    if model.shape != (bins,):
        raise ValueError(f"model: expected {bins} bins, as in histograms, got {model.size}")
    if groups < 1 or bins % groups:
        raise ValueError(f"groups: expected a divisor of {bins}, got {groups}")
    for name, values in (("histograms", histograms), ("model", model)):
        if not np.all(np.isfinite(values) & (values >= 0)):
            raise ValueError(f"{name}: expected finite numbers, none negative, got others")
    similarity = np.sqrt(histograms.astype(np.float64) * model.astype(np.float64)).sum(axis=1) / groups
    distance: NDArray[np.float64] = np.sqrt(np.maximum(0.0, 1.0 - similarity))
    return distance
