# SPDX-License-Identifier: MIT
"""Distance of rank sections (Sabeti, Parvizi, Wu 2008, equation (29))."""

import numpy as np
from numpy.typing import NDArray


def section_distance(sections: NDArray[np.float32], model: NDArray[np.float32]) -> NDArray[np.float64]:
    """Computes (29) as printed, divided by its maximum."""
    if sections.shape[2] != model.shape[1]:
        raise ValueError(
            f"model: expected {sections.shape[2]} sections, as in sections, got {model.shape[1]}"
        )
    difference = sections.astype(np.float64) - model.astype(np.float64)
    distance: NDArray[np.float64] = np.sqrt((difference**2).sum(axis=2)).sum(axis=1) / (3 * np.sqrt(2))
    return distance
