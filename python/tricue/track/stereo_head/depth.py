# SPDX-License-Identifier: MIT
"""The disparity of a head, Moreno et al. 2002, section 3.2: of the pixels in an ellipse, in a range."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.stereo_geometry import StereoGeometry
from tricue.track.stereo_head.view import NO_CHECK, Ellipse, Pair

Singles = NDArray[np.float32]

WIDEST = 31  # window
LEAST = 8  # pixels with a disparity
MOST = 4000  # disparities at once


class Depth(NamedTuple):
    """The disparity (5), pixels, and the share of the ellipse's pixels that are about there."""

    disparity: float
    share: float


def depth_of(
    k: Kernels, pair: Pair, ellipse: Ellipse, span: tuple[int, int], p: StereoHeadParams
) -> Depth | None:
    """The disparity in an ellipse, pixels, in a span, ends included; None where nothing is matched."""
    seen, area = _matches(k, pair, ellipse, span, p)
    if seen.size < LEAST:
        return None
    disparity = _median(seen) if p.center == "median" else float(seen.mean())
    return Depth(disparity, np.count_nonzero(_together(seen, disparity, pair, p)) / area)


def first_depth(
    k: Kernels, pair: Pair, ellipse: Ellipse, span: tuple[int, int], p: StereoHeadParams
) -> Depth | None:
    """The same where nothing is expected yet: the disparity that most matches share, for in a wide span wrong
    ones pull even a median.
    """
    seen, area = _matches(k, pair, ellipse, span, p)
    if seen.size < LEAST:
        return None
    candidates = np.unique(np.round(seen))
    near = [_together(seen, candidate, pair, p) for candidate in candidates.tolist()]
    most = max(near, key=np.count_nonzero)
    shared = seen[most] if most.any() else seen
    return Depth(_median(shared), np.count_nonzero(most) / area)


def span_round(disparity: float, step: int, p: StereoHeadParams) -> tuple[int, int]:
    """(4): the disparities looked for round an expected one, pixels."""
    below, above = p.disparities
    return math.floor(disparity) - below * step, math.ceil(disparity) + above * step


def span_between(geometry: StereoGeometry, near: float, far: float, step: int) -> tuple[int, int]:
    """The disparities from far to near, metres, in places ``step`` wide, as far as a picture has them."""
    most = min(geometry.shape[1] // step, MOST)
    first, last = (geometry.disparity(z) / step for z in (far, near))
    begin = min(math.floor(first), most)
    return begin, max(begin, math.ceil(min(last, most)))


def _matches(
    k: Kernels, pair: Pair, ellipse: Ellipse, span: tuple[int, int], p: StereoHeadParams
) -> tuple[Singles, float]:
    """The disparities found in an ellipse without its rim, and how many pixels that has."""
    window = min(p.window + 2 * (pair.step - 1), WIDEST)
    x, y, minor, major = ellipse
    minor, major = (max(half - p.rim * window, half / 2) for half in (minor, major))
    region = (math.floor(x - minor), math.floor(y - major), math.ceil(x + minor), math.ceil(y + major))
    found = k.sad_disparity(*pair.grey, region, True, *span, window, p.uniqueness, p.prefilter, NO_CHECK)
    return found[np.isfinite(found)], math.pi * minor * major


def _together(seen: Singles, disparity: float, pair: Pair, p: StereoHeadParams) -> NDArray[np.bool_]:
    return np.asarray(np.abs(seen - np.float32(disparity)) <= np.float32(p.coherent * pair.step))


def _median(values: Singles) -> float:
    """As numpy.median, which takes five times as long for so few."""
    ordered, half = np.sort(values), values.size // 2
    return float(ordered[half]) if values.size % 2 else float(ordered[half - 1] + ordered[half]) / 2
