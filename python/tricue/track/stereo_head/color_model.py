# SPDX-License-Identifier: MIT
"""The color histogram of a head: of an ellipse's cells at its depth (Moreno et al. 2002, section 3.1)."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse, Image
from tricue.track.stereo_head.search_region import SearchRegion

Floats = NDArray[np.float64]

HAIR_CAP = 0.3  # of the head's height, from its top
MIN_COHERENT_CELLS = 8  # with fewer at the head's depth, all of the ellipse count


def measure_histogram(
    k: Kernels, region: SearchRegion, ellipse: Ellipse, step: int, p: StereoHeadParams
) -> Floats:
    """C of (2), (L,) of sum 1, or of zeros where the ellipse has no cell inside the image.

    With ``learn="coherent"`` only the cells at the head's depth count.
    """
    counts = _count(k, region, ellipse, step, region.coherent if p.learn == "coherent" else None, p)
    total = int(counts.sum())
    if total < MIN_COHERENT_CELLS:
        counts = _count(k, region, ellipse, step, None, p)
        total = int(counts.sum())
    return counts / float(max(total, 1))


def measure_first_histogram(
    k: Kernels, region: SearchRegion, ellipse: Ellipse, step: int, p: StereoHeadParams
) -> Floats:
    """The first model, (L,) of sum 1: that of the parameters, or the ellipse mixed with the hair at its top.

    With more hair in the model, a head is still recognized from behind.
    """
    if p.head_colors is not None:
        return _fill(p.head_colors, p)
    x, y, minor, major = ellipse
    cap = (x, y - (1 - HAIR_CAP) * major, minor, HAIR_CAP * major)
    whole, hair = (measure_histogram(k, region, each, step, p) for each in (ellipse, cap))
    return (1 - p.hair) * whole + p.hair * hair


def _fill(weights: Sequence[tuple[int, float]], p: StereoHeadParams) -> Floats:
    """(L,) of sum 1 of (bin, weight)."""
    histogram = np.zeros(math.prod(p.bins))
    for index, weight in weights:
        histogram[index] = weight
    return np.asarray(histogram / histogram.sum())


def _count(
    k: Kernels,
    region: SearchRegion,
    ellipse: Ellipse,
    step: int,
    mask: Image | None,
    p: StereoHeadParams,
) -> NDArray[np.int32]:
    """(L,) cells of each bin in an ellipse, of those that a mask marks, if any."""
    cells = region.to_cells(ellipse, step)[None]
    inside, _ = k.ellipse_histogram(region.bins, cells, math.prod(p.bins), 1.0, mask)
    counts: NDArray[np.int32] = inside[0]
    return counts
