# SPDX-License-Identifier: MIT
"""The place with the most evidence."""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Plane
from tricue.reference.base.checks import refuse
from tricue.reference.fuse.detail.parabola import parabola_offset


def evidence_peak(
    responses: Plane, contrast: Plane, filter_weight: float, contrast_weight: float
) -> NDArray[np.float64]:
    """Adds up the weighted planes, and interpolates around the maximum."""
    if not responses.size:
        refuse("responses", "at least one filter and cell", "none")
    if contrast.size and contrast.shape != responses.shape[1:]:
        refuse("contrast", f"shape {responses.shape[1:]}", contrast.shape)
    for name, weight in (("filter_weight", filter_weight), ("contrast_weight", contrast_weight)):
        if not math.isfinite(weight):
            refuse(name, "a finite number", weight)
    evidence = np.float32(filter_weight) * responses[0]
    if contrast.size:
        evidence += np.float32(contrast_weight) * contrast
    if not np.isfinite(evidence).all():
        refuse("evidence", "finite numbers", "others")
    rows, columns = evidence.shape
    row, column = divmod(int(evidence.argmax()), columns)
    near = np.s_[:, max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2]
    return np.array(
        [
            column + peak_offset(evidence[row], column) - columns // 2,
            row + peak_offset(evidence[:, column], row) - rows // 2,
            evidence[row, column],
            responses[0, row, column],
            contrast[row, column] if contrast.size else 0.0,
            *responses[near].max(axis=(1, 2)),
        ]
    )


def peak_offset(values: Plane, index: int) -> float:
    """Offset of a peak from the maximum, by a parabola through the maximum and its neighbors."""
    if not 0 < index < len(values) - 1:
        return 0.0
    return parabola_offset(*values[index - 1 : index + 2].tolist())
