# SPDX-License-Identifier: MIT
"""The target's position in metres, with its covariance: from the middle of its box, and its disparity."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.state import FollowState

Floats = NDArray[np.float64]
LEAST = 1e-3  # pixels of disparity


def located(
    k: Kernels, box: Box, state: FollowState, p: FlowDepthParams
) -> tuple[Floats, Floats] | tuple[None, None]:
    """Position (3,), metres in the left camera's frame, and covariance (3, 3); None where the disparity
    isn't above 0.

    A target that isn't seen may have changed its speed: its covariance grows with the fourth power of the
    time.
    """
    step = state.view.step
    disparity = state.disparity * step + state.lens.shift
    if not disparity > LEAST:
        return None, None
    x, y = box.center
    place, depth = (step * state.view.scale * each for each in (p.place_noise, p.disparity_noise))
    measured = np.array([[x - 0.5, y - 0.5, disparity]])
    variances = np.array([place**2, place**2, depth**2])
    points, covariances = k.back_project(measured, variances, state.lens.camera, state.lens.baseline)
    drift = (p.agility * state.missed**2 / 2) ** 2
    return points[0], covariances[0] + drift * np.eye(3)
