# SPDX-License-Identifier: MIT
"""The measurement of a head in a stereo pair: its best match, its disparity, its position and color."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.color_model import measure_first_histogram
from tricue.track.stereo_head.disparity import EllipseDisparity, limits_around, measure_disparity
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse, PreparedPair
from tricue.track.stereo_head.search_local import EllipseMatch, search_local
from tricue.track.stereo_head.search_region import crop_region
from tricue.track.stereo_head.stereo_geometry import Point, StereoGeometry

Floats = NDArray[np.float64]

MIN_SCORE_LOSS = 0.02  # how far a mean score is taken to be below 1, at least


class HeadMeasurement(NamedTuple):
    """A measured head.

    match, depth: its best match and the disparity there. histogram: (L,) its colors, C of (2).
    noise: (7, 7) covariance of the measurement of (8).
    """

    match: EllipseMatch
    depth: EllipseDisparity
    histogram: Floats
    position: Point
    noise: Floats

    def values(self, color: Floats) -> Floats:
        """(7,) the measurement of (8), with the mean color (3,) of the updated model."""
        return np.array([*self.position, *color.tolist(), self.match.intersection])

    def inflated(self, mean_score: float, p: StereoHeadParams) -> "HeadMeasurement":
        """The same with a larger covariance of the position, where the score is below the running mean.

        The noise by the paper's polynomial of the distance, (9), stays as it is.
        """
        # Rounded, so that both sets of kernels, whose scores differ by 1e-6, give the same track.
        factor = round((1 - self.match.score) / max(1 - mean_score, MIN_SCORE_LOSS), 2)
        if factor <= 1 or p.noise_model == "polynomial":
            return self
        noise = self.noise.copy()
        noise[:3, :3] *= factor
        return self._replace(noise=noise)


def measure(
    k: Kernels,
    pair: PreparedPair,
    geometry: StereoGeometry,
    ellipse: Ellipse,
    disparity: float,
    model: Floats | None,
    p: StereoHeadParams,
) -> HeadMeasurement | None:
    """Measure the head around an ellipse, at about a disparity, pixels.

    model: (L,) the color model to search for. Without one the match is the ellipse itself, and its colors
    are the first model. None where nothing is matched, or at a distance outside near to far.
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
    if not p.near <= point[2] <= p.far:  # also of NaN, from a disparity of 0
        return None
    noise = _color_noise(p.color_noise, p.intersection_noise).copy()
    noise[:3, :3] = covariance
    return HeadMeasurement(match, depth, histogram, point, noise)


@lru_cache(maxsize=16)
def _color_noise(color: tuple[float, float, float], intersection: float) -> Floats:
    """(7, 7) covariance of a measurement without that of the position."""
    return np.diag([0.0, 0.0, 0.0, *(each**2 for each in color), intersection**2])
