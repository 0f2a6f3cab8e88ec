# SPDX-License-Identifier: MIT
"""The color histogram of a head: of the ellipse's cells at its depth (Moreno et al. 2002, section 3.1)."""

import math
from collections.abc import Sequence

import numpy as np

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse
from tricue.track.stereo_head.search_local import search_local
from tricue.track.stereo_head.search_region import SearchRegion

HAIR_CAP = 0.3  # of the head's height, from its top


def measure_first_histogram(
    k: Kernels, region: SearchRegion, ellipse: Ellipse, step: int, p: StereoHeadParams
) -> Floats:
    """The first model, (L,) with sum 1: that of the parameters, or the ellipse's mixed with its top's, the
    hair's.

    With more hair in the model, a head is still recognized from behind.
    """
    if p.head_colors is not None:
        return _fill(p.head_colors, p)
    x, y, minor, major = ellipse
    cap = (x, y - (1 - HAIR_CAP) * major, minor, HAIR_CAP * major)
    whole, hair = (_measure(k, region, each, step, p) for each in (ellipse, cap))
    return (1 - p.hair) * whole + p.hair * hair


def _fill(weights: Sequence[tuple[int, float]], p: StereoHeadParams) -> Floats:
    """A histogram (L,) with sum 1 from pairs (bin, weight)."""
    histogram = np.zeros(math.prod(p.bins))
    for index, weight in weights:
        histogram[index] = weight
    return np.asarray(histogram / histogram.sum())


def _measure(k: Kernels, region: SearchRegion, ellipse: Ellipse, step: int, p: StereoHeadParams) -> Floats:
    """The color histogram (L,) of an ellipse, as :func:`search_local` gives it for the best match."""
    anything = np.ones(math.prod(p.bins))
    return search_local(k, region, ellipse, anything, step, (0, 0), p)[1]
