# SPDX-License-Identifier: MIT
"""A head measured in a pair: its place by color and depth, its disparity, and what both say in metres."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.depth import Depth, depth_of, span_round
from tricue.track.stereo_head.filter import INTERSECTION_NOISE, MEASURED
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.search import Place, best_place, first_histogram, histogram_of
from tricue.track.stereo_head.stereo_geometry import StereoGeometry
from tricue.track.stereo_head.view import Ellipse, Pair, look

Floats = NDArray[np.float64]

SURE = 0.02  # of a place's score, that even the best lack


class Measured(NamedTuple):
    """The place and the depth of a head, its colors C (L,), and the measurement of (8), (7,), with its
    covariance (7, 7).
    """

    place: Place
    depth: Depth
    colors: Floats
    values: Floats
    noise: Floats

    def doubted(self, usual: float, p: StereoHeadParams) -> "Measured":
        """The same, its position the less certain the less its place is like the model than usual.

        Not where the noise is the paper's polynomial of the distance, (9).
        """
        # Rounded, so that both sets of kernels, whose scores differ by 1e-6, give the same track.
        doubt = round((1 - self.place.score) / max(1 - usual, SURE), 2)
        if doubt <= 1 or p.noise == "polynomial":
            return self
        noise = self.noise.copy()
        noise[:3, :3] *= doubt
        return self._replace(noise=noise)


def measure(
    k: Kernels,
    pair: Pair,
    geometry: StereoGeometry,
    ellipse: Ellipse,
    disparity: float,
    histogram: Floats | None,
    p: StereoHeadParams,
) -> Measured | None:
    """Look for the head round an ellipse, at about a disparity, pixels; None where nothing has one that a
    head between near and far has.

    Without a histogram the place is the ellipse itself, and its colors are the model.
    """
    view = look(k, pair, ellipse, disparity, p)
    if histogram is None:
        colors = first_histogram(k, view, ellipse, pair.step, p)
        place = best_place(k, view, ellipse, colors, pair.step, (0, 0), p)
    else:
        place = best_place(k, view, ellipse, histogram, pair.step, p.search, p)
        colors = histogram_of(k, view, place.ellipse, pair.step, p)
    depth = depth_of(k, pair, place.ellipse, span_round(disparity, pair.step, p), p)
    if depth is None:
        return None
    point, covariance = geometry.point(k, *place.ellipse[:2], depth.disparity, pair.step, p)
    if not p.near <= point[2] <= p.far:  # NaN, too, where the disparity is none
        return None
    noise = np.zeros((MEASURED, MEASURED))
    noise[:3, :3] = covariance
    noise[range(3, MEASURED), range(3, MEASURED)] = [p.color_noise**2] * 3 + [INTERSECTION_NOISE**2]
    mean = k.histogram_mean(colors, p.bins, p.chroma)
    return Measured(place, depth, colors, np.array([*point, *mean, place.intersection]), noise)
