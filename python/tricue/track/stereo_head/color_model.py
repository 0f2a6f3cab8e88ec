# SPDX-License-Identifier: MIT
"""The color histogram of a head: of an ellipse's cells at its depth (Moreno et al. 2002, section 3.1)."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse
from tricue.track.stereo_head.search_region import SearchRegion

Floats = NDArray[np.float64]

NO_BIN = np.uint16(65535)
HAIR_CAP = 0.3  # of the head's height, from its top
MIN_COHERENT_CELLS = 8  # with fewer at the head's depth, all of the ellipse count


def measure_histogram(
    k: Kernels, region: SearchRegion, ellipse: Ellipse, step: int, p: StereoHeadParams
) -> Floats:
    """C of (2), (L,) of sum 1, or of zeros where the ellipse has no cell inside the image.

    With ``learn="coherent"`` only the cells at the head's depth count.
    """
    bins = region.bins
    if p.learn == "coherent":
        bins = np.where(region.coherent, bins, NO_BIN)
    counts = _count(k, bins, ellipse, region, step, p)
    if counts.sum() < MIN_COHERENT_CELLS:
        counts = _count(k, region.bins, ellipse, region, step, p)
    return np.asarray(counts / max(counts.sum(), 1.0))


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
    bins: NDArray[np.uint16],
    ellipse: Ellipse,
    region: SearchRegion,
    step: int,
    p: StereoHeadParams,
) -> Floats:
    """(L,) cells of each bin in an ellipse."""
    inside, _ = k.ellipse_histogram(bins, region.to_cells(ellipse, step)[None], math.prod(p.bins), 1.0)
    counts: Floats = inside[0].astype(np.float64)
    return counts
