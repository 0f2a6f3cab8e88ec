# SPDX-License-Identifier: MIT
"""The measurement of a head in a stereo pair: best match, disparity, position and color."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.stereo_head.color_model import measure_first_histogram
from tricue.track.stereo_head.disparity import EllipseDisparity, limits_around, measure_disparity
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse, PreparedPair
from tricue.track.stereo_head.search_local import EllipseMatch, search_local
from tricue.track.stereo_head.search_region import crop_region
from tricue.track.stereo_head.stereo_geometry import Point, StereoGeometry

MIN_SCORE_LOSS = 0.02  # the least assumed difference of a mean score from 1


class HeadMeasurement(NamedTuple):
    """A measured head.

    match, depth: its best match and the disparity there. histogram: (L,) of its colors, C of equation (2).
    covariance: (3, 3) of the position, square meters.
    """

    match: EllipseMatch
    depth: EllipseDisparity
    histogram: Floats
    position: Point
    covariance: Floats

    def values(self, color: Floats) -> Floats:
        """(7,) the measurement, z of equation (8), with the mean color (3,) of the updated model."""
        return np.array([*self.position, *color.tolist(), self.match.intersection])

    def noise(self, p: StereoHeadParams) -> Floats:
        """(7, 7) the covariance of the measurement, R of section 4.1."""
        noise: Floats = _color_noise(p.color_noise, p.intersection_noise).copy()
        noise[:3, :3] = self.covariance
        return noise

    def inflated(self, mean_score: float, p: StereoHeadParams) -> "HeadMeasurement":
        """The same with a larger position covariance, if the score is below the running mean.

        The noise by the paper's polynomial (9) isn't changed.
        """
        # Rounded so that both sets of kernels, whose scores differ by 1e-6, give the same track.
        factor = round((1 - self.match.score) / max(1 - mean_score, MIN_SCORE_LOSS), 2)
        if factor <= 1 or p.noise_model == "polynomial":
            return self
        return self._replace(covariance=factor * self.covariance)


def measure(
    k: Kernels,
    pair: PreparedPair,
    geometry: StereoGeometry,
    ellipse: Ellipse,
    disparity: float,
    model: Floats | None,
    p: StereoHeadParams,
) -> HeadMeasurement | None:
    """Measure the head near an ellipse and a disparity, pixels.

    model: (L,) the color model to search for. Without one the match is the ellipse itself, and its colors
    become the first model. None if nothing is matched, or the distance isn't between near and far.
    """
    region = crop_region(k, pair, ellipse, disparity, p)
    if model is None:
        histogram = measure_first_histogram(k, region, ellipse, pair.step, p)
        match, _ = search_local(k, region, ellipse, histogram, pair.step, (0, 0), p)
    else:
        match, histogram = search_local(k, region, ellipse, model, pair.step, p.search, p)
    depth = measure_disparity(k, pair, match.ellipse, limits_around(disparity, pair.step, p), p)
    if depth is None:
        return None
    point, covariance = geometry.triangulate(k, *match.ellipse[:2], depth.disparity, pair.step, p)
    if not p.near <= point[2] <= p.far:  # also for NaN, from a disparity of 0
        return None
    return HeadMeasurement(match, depth, histogram, point, covariance)


@lru_cache(maxsize=16)
def _color_noise(color: tuple[float, float, float], intersection: float) -> Floats:
    """The covariance (7, 7) of a measurement, without the position's part."""
    return np.diag([0.0, 0.0, 0.0, *(each**2 for each in color), intersection**2])
