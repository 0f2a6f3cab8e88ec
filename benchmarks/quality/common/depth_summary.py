# SPDX-License-Identifier: MIT
"""How far positions are off along z, and whether their covariance says so."""

from typing import NamedTuple

import numpy as np

from benchmarks.quality.common.confidence_summary import ON_TARGET_OVERLAP
from benchmarks.quality.common.frame_results import Array, FrameResults


class DepthSummary(NamedTuple):
    """Of pooled frames whose true depth is known and that have a position; NaN where there is none."""

    error: float
    """Median, meters, of all of them."""
    error_on_target: float
    """Median, meters, of those that are TRACKED on the target, as all numbers below."""
    bias: float
    """Median of the found minus the true z, meters."""
    sigma: float
    """Median standard deviation, meters, that the covariance has."""
    within_one: float
    """Share with an error of at most one standard deviation; 0.683 for a calibrated normal distribution."""
    within_two: float
    """Share with an error of at most two; 0.954 for that."""


def summarize_depth(frames: FrameResults) -> DepthSummary:
    """The summary of some frames."""
    errors, sigmas = frames.depth_errors, frames.depth_sigmas
    chosen = frames.tracked & (frames.overlaps > ON_TARGET_OVERLAP) & ~np.isnan(errors) & ~np.isnan(sigmas)
    right, sigma = errors[chosen], sigmas[chosen]
    return DepthSummary(
        error=_median(np.abs(errors[~np.isnan(errors)])),
        error_on_target=_median(np.abs(right)),
        bias=_median(right),
        sigma=_median(sigma),
        within_one=_share_within(right, sigma),
        within_two=_share_within(right, 2 * sigma),
    )


def _median(values: Array) -> float:
    return float(np.median(values)) if values.size else float("nan")


def _share_within(errors: Array, limits: Array) -> float:
    return float((np.abs(errors) <= limits).mean()) if errors.size else float("nan")
