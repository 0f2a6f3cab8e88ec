# SPDX-License-Identifier: MIT
"""How much the target grew since the last frame, by the optical flow of its pixels."""

from typing import NamedTuple

import cv2

from tricue.track.fused.arrays import Image
from tricue.track.fused.window import INNER_SHARE, PATCH_PIXELS, Window

FLOW_REACH = 20  # patch pixels from the target's center, of the part in which flow is measured
FLOW_SIGMA = 1.0  # pixels, of the derivative filters
FLOW_LEVELS = 2  # of the pyramid
FLOW_POOL_RADIUS = 2  # pixels
MIN_FLOW_ANGLE, MIN_FLOW_CONTRAST = 0.05, 4.0  # of reliable flow
MIN_FLOW_PIXELS = 30
MAX_FLOW_RESIDUAL = 2.5  # standard deviations; pixels with a larger one are outliers
MAX_RIGID_RESIDUAL = 0.15  # patch pixels, standard deviation; with more the motion is no similarity
MAX_FLOW_GROWTH = 2  # times; more is no reliable measurement


class FlowPatch(NamedTuple):
    """(41, 41) gray around the target, which the next frame's flow starts from.

    pixel_size: image pixels per pixel of it.
    """

    gray: Image
    pixel_size: float

    @classmethod
    def cut(cls, window: Window, right: float, down: float) -> "FlowPatch":
        """The part around a target so many patch pixels off the window's center, moved into the patch."""
        i, j = (PATCH_PIXELS // 2 - FLOW_REACH + round(each) for each in (down, right))
        last = PATCH_PIXELS - 2 * FLOW_REACH - 1
        i, j = min(max(i, 0), last), min(max(j, 0), last)
        part = window.patch[i : i + 2 * FLOW_REACH + 1, j : j + 2 * FLOW_REACH + 1]
        return cls(cv2.cvtColor(part, cv2.COLOR_BGR2GRAY), window.pixel_size)  # type: ignore[arg-type]


def measure_growth(before: FlowPatch, now: FlowPatch, window: Window) -> float | None:
    """The ratio of the target's size to that in the last frame, by a similarity fitted to its pixels' flow.

    None where flow isn't reliable.
    """
    width, height = (min(INNER_SHARE * each / 2, FLOW_REACH - 1.0) for each in window.size)
    left, top = max(FLOW_REACH - round(width), 0), max(FLOW_REACH - round(height), 0)
    region = left, top, 2 * FLOW_REACH + 1 - left, 2 * FLOW_REACH + 1 - top
    k = window.observation.k
    u, v, _, _ = k.pyramid_flow(
        before.gray,
        now.gray,
        FLOW_SIGMA,
        FLOW_LEVELS,
        MIN_FLOW_ANGLE,
        MIN_FLOW_CONTRAST,
        region,
        FLOW_POOL_RADIUS,
    )
    shrunk, residual, _ = k.flow_scale(u, v, MAX_FLOW_RESIDUAL, MIN_FLOW_PIXELS)
    rigid = 1 / MAX_FLOW_GROWTH < shrunk < MAX_FLOW_GROWTH and residual < 2 * MAX_RIGID_RESIDUAL**2
    return now.pixel_size / before.pixel_size / shrunk if rigid else None
