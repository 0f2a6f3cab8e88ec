# SPDX-License-Identifier: MIT
"""The disparity of a head, from an ellipse's pixels, within a range (Moreno et al. 2002, section 3.2)."""

import math
from typing import NamedTuple

import numpy as np

from tricue.kernels import Kernels
from tricue.track.base.shared_disparity import most_shared
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Disparities, Ellipse, PreparedPair
from tricue.track.stereo_head.stereo_geometry import StereoGeometry

MIN_MATCHED_PIXELS = 8  # of an ellipse
MIN_SEMI_AXIS = 1.75  # pixels, of an ellipse without its margin: enough of its pixels are left
MAX_CANDIDATE_DISPARITIES = 4000  # per search


class EllipseDisparity(NamedTuple):
    """The disparity (5) of an ellipse, pixels, and the share of the ellipse's pixels near it."""

    disparity: float
    share: float


def measure_disparity(
    k: Kernels, pair: PreparedPair, ellipse: Ellipse, limits: tuple[int, int], p: StereoHeadParams
) -> EllipseDisparity | None:
    """The disparity of an ellipse: the median or the mean (5) of its pixels.

    limits: lowest and highest disparity, pixels, inclusive. None if too few pixels are matched.
    """
    matching = pair.pixel_matching(p)
    inner = _without_margin(ellipse, matching[0], p)
    statistic = p.subpixel, p.disparity_statistic == "median", p.disparity_tolerance * pair.step
    disparity, matched, near = k.ellipse_disparity(
        pair.left, pair.right, np.array(inner), limits, matching, statistic
    )
    return None if matched < MIN_MATCHED_PIXELS else EllipseDisparity(disparity, near / _area(inner))


def find_initial_disparity(
    k: Kernels, pair: PreparedPair, ellipse: Ellipse, limits: tuple[int, int], p: StereoHeadParams
) -> EllipseDisparity | None:
    """The disparity of an ellipse when none is expected yet: the one that most matches share.

    Within wide limits, wrong matches would bias even a median. None if too few pixels are matched.
    """
    matched, area = _match(k, pair, ellipse, limits, p)
    if matched.size < MIN_MATCHED_PIXELS:
        return None
    best = most_shared(matched, p.disparity_tolerance * pair.step)
    shared = matched[best] if best.any() else matched
    return EllipseDisparity(float(np.median(shared)), np.count_nonzero(best) / area)


def limits_around(disparity: float, step: int, p: StereoHeadParams) -> tuple[int, int]:
    """The limits of the search around an expected disparity, pixels (4).

    For subpixel disparities they are wider, because the first and the last candidate have no fraction. They
    end 2000 pixels away, the most that one search allows.
    """
    below, above = p.disparities
    below = min(below * step, MAX_CANDIDATE_DISPARITIES // 2)
    above = min(above * step, MAX_CANDIDATE_DISPARITIES // 2)
    if not p.subpixel:
        return round(disparity) - below, round(disparity) + above
    return math.floor(disparity) - below, math.ceil(disparity) + above


def limits_between(geometry: StereoGeometry, near: float, far: float, step: int) -> tuple[int, int]:
    """The disparities of the distances from far to near, meters, in units of ``step`` pixels.

    They are limited by the image's width.
    """
    highest = min(geometry.shape[1] // step, MAX_CANDIDATE_DISPARITIES)
    first, last = (geometry.disparity(z) / step for z in (far, near))
    begin = min(math.floor(first), highest)
    return begin, max(begin, math.ceil(min(last, highest)))


def _match(
    k: Kernels, pair: PreparedPair, ellipse: Ellipse, limits: tuple[int, int], p: StereoHeadParams
) -> tuple[Disparities, float]:
    """The disparities (N,) found in an ellipse without its margin, and that ellipse's number of pixels."""
    x, y, minor, major = inner = _without_margin(ellipse, pair.pixel_window(p), p)
    region = (math.floor(x - minor), math.floor(y - major), math.ceil(x + minor), math.ceil(y + major))
    disparities = pair.disparities(k, region, limits, p, ellipse=True, cells=False)
    matched = disparities[np.isfinite(disparities)]
    if not p.subpixel:
        matched = np.ceil(matched - np.float32(0.5))  # of two equal costs the smaller disparity, as in (3)
    return matched, _area(inner)


def _without_margin(ellipse: Ellipse, window: int, p: StereoHeadParams) -> Ellipse:
    """The ellipse without its margin."""
    margin = p.ellipse_margin * window
    x, y, minor, major = ellipse
    return x, y, _shorten(minor, margin), _shorten(major, margin)


def _shorten(axis: float, margin: float) -> float:
    """A semi-axis without the margin, which takes at most half of it, and less of a short one."""
    return max(axis - margin, axis / 2, min(axis, MIN_SEMI_AXIS))


def _area(ellipse: Ellipse) -> float:
    """The number of pixels in an ellipse."""
    return math.pi * ellipse[2] * ellipse[3]
