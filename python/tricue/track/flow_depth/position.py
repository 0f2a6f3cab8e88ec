# SPDX-License-Identifier: MIT
"""The target's position in meters, with its covariance, from the center of its box and its disparity."""

import numpy as np

from tricue.arrays import Floats
from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.base.position_limit import MAX_SIGMA
from tricue.track.base.stereo_noise import measurement_variances
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.state import FlowDepthState

MIN_POSITION_DISPARITY = 1e-3  # pixels, of parallel cameras


def locate(
    k: Kernels, box: Box, state: FlowDepthState, p: FlowDepthParams
) -> tuple[Floats, Floats] | tuple[None, None]:
    """Position (3,), meters in the left camera's frame, and covariance (3, 3).

    None and None unless the disparity is above 0. While the target is missed, its velocity may change, so the
    covariance grows with the fourth power of the time, up to a standard deviation of MAX_SIGMA.
    """
    step = state.reduced.step
    disparity = state.disparity * step + state.geometry.offset
    if not disparity > MIN_POSITION_DISPARITY:
        return None, None
    x, y = box.center
    scale = step * state.reduced.scale
    place_noise, disparity_noise = scale * p.place_noise, scale * p.disparity_noise
    measured = np.array([[x - 0.5, y - 0.5, disparity]])
    variances = measurement_variances(place_noise, disparity_noise)
    points, covariances = k.back_project(measured, variances, state.geometry.camera, state.geometry.baseline)
    covariance = covariances[0]
    if state.missed_seconds:
        diagonal = covariance.ravel()[::4]
        diagonal += min(p.acceleration_noise * state.missed_seconds**2 / 2, MAX_SIGMA) ** 2
    return points[0], covariance
