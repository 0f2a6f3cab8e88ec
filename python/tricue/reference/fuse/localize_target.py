# SPDX-License-Identifier: MIT
"""A target's place in a patch."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Image, Plane
from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.box_contrast import box_contrast
from tricue.reference.cues.color.color_posterior import color_posterior
from tricue.reference.cues.color.hog_color_cells import hog_color_cells
from tricue.reference.cues.color.joint_histogram import joint_histogram
from tricue.reference.fuse.combine_posteriors import combine_posteriors
from tricue.reference.fuse.correlation_response import correlation_response
from tricue.reference.fuse.evidence_peak import evidence_peak


def localize_target(
    patch: Image,
    taper: Plane,
    appearance: tuple[NDArray[np.complex64], Plane, Floats],
    other: Plane,
    search: tuple[float, float, float, float, float, float, float],
) -> tuple[Floats, Plane]:
    """Calls the twins of its parts, and adds two features of the place."""
    filters, table, roots = appearance
    width, height, surround_size, surround_weight, filter_weight, contrast_weight, inner = search
    if len(other) and other.shape != patch.shape[:2]:
        refuse("other", "the patch's rows and columns", f"{other.shape[0]}, {other.shape[1]}")
    for name, number in (("width", width), ("height", height), ("inner", inner)):
        if not 0 < number < math.inf:
            refuse(name, "a finite number above 0", float(number))
    bins = round(len(roots) ** (1 / 3))
    if bins not in (1, 2, 4, 8, 16, 32, 64) or bins**3 != len(roots):
        refuse("roots", "(B³,), B a power of two up to 64", len(roots))
    responses = correlation_response(hog_color_cells(patch, taper), filters)
    posterior = color_posterior(patch, table) if table.size else other
    if table.size and other.size:
        posterior = combine_posteriors(posterior, other)
    contrast = (
        box_contrast(posterior, width, height, surround_size, surround_weight)
        if posterior.size
        else posterior
    )
    peak = evidence_peak(responses, contrast, filter_weight, contrast_weight)
    rows = _span(patch.shape[0], 2 * peak[1], inner * height)
    columns = _span(patch.shape[1], 2 * peak[0], inner * width)
    samples = patch[rows, columns].reshape(1, -1, 3).transpose(0, 2, 1)
    similarity = np.sqrt(joint_histogram(samples, bins)[0].astype(float)) @ roots
    return np.array([*peak, _sharpness(responses[0].astype(float), peak[5]), similarity]), responses


def _sharpness(response: Floats, peak: Any) -> float:
    mean, power = response.mean(), (response**2).mean()
    return float((peak - mean) / max(math.sqrt(max(power - mean * mean, 0.0)), 1e-6))


def _span(size: int, offset: float, length: float) -> slice:
    """The pixels of an axis under a length; offset: of its middle from the patch's, pixels."""
    center = size / 2 + offset
    first = min(max(round(center - length / 2), 0), size - 1)
    return slice(first, max(min(round(center + length / 2), size), first + 1))
