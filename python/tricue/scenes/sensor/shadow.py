# SPDX-License-Identifier: MIT
"""The shadow of a depth camera: what its projector or second camera doesn't see."""

import numpy as np

from tricue.scenes.arrays import Array, Mask


def cast_shadow(depth: Array, fx: float, baseline: float) -> Mask:
    """The pixels (H, W) of an exact z-buffer that nearer surfaces hide from the projector.

    baseline: meters from the camera to the projector, positive to the right. A projector on the right casts
    shadows left of near things, one on the left (negative baseline) right of them.
    """
    if baseline < 0:
        return cast_shadow(depth[:, ::-1], fx, -baseline)[:, ::-1]
    # The projector sees a pixel at its column minus its disparity; a nearer surface shifts farther.
    seen = np.arange(depth.shape[1]) - fx * baseline / depth
    hiding = np.minimum.accumulate(seen[:, ::-1], axis=1)[:, ::-1]
    shadow = np.zeros(depth.shape, bool)
    shadow[:, :-1] = hiding[:, 1:] <= seen[:, :-1]
    return shadow
