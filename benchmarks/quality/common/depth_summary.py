# SPDX-License-Identifier: MIT
"""The errors of positions along z, and whether their covariance fits these errors."""

from typing import NamedTuple

import numpy as np

from benchmarks.quality.common.confidence_summary import ON_TARGET_OVERLAP
from benchmarks.quality.common.frame_results import Array, FrameResults


class DepthSummary(NamedTuple):
    """Statistics of pooled frames with a position and a known true depth; NaN without such frames."""

    error: float
    """Median error of all these frames, meters."""
    error_on_target: float
    """Median error of those that are TRACKED on the target, meters; so are all numbers below."""
    bias: float
    """Median of the found minus the true z, meters."""
    sigma: float
    """Median standard deviation by the covariance, meters."""
    within_one: float
    """Share with an error of at most one standard deviation; 0.683 for a calibrated normal distribution."""
    within_two: float
    """Share with an error of at most two; 0.954 for such a distribution."""


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
