# SPDX-License-Identifier: MIT
"""Pixels without depth: how many, by brightness, and how wide they are beside near edges."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
MIN_STEP = 0.1
"""The smallest difference between two depths at an edge, as a share of the nearer one."""
MAX_DARK, MIN_BRIGHT = 60, 200
"""Gray levels of 255."""
MIN_FIELD_SHARE = 0.1
"""Share of a row or column that has depth, if it is in the depth camera's field of view."""
MIN_PARALLAX = 80.0
"""Pixels of disparity per meter of baseline between both surfaces; far away, noise makes smaller steps."""
MAX_GAP = 60
"""Pixels without depth between two surfaces; longer ones have other causes than an edge."""


class HoleShares(NamedTuple):
    """Shares of pixels without depth: of all in the field of view, and of dark, medium and bright ones."""

    all: float
    dark: float
    medium: float
    bright: float


class Steps(NamedTuple):
    """Places (n,) where depth jumps between neighbors in a row, or across a gap in it.

    gap: pixels without depth between them. near_left: whether the nearer surface is on the left. near, far:
    meters.
    """

    gap: NDArray[np.intp]
    near_left: Mask
    near: Array
    far: Array


class Shadow(NamedTuple):
    """Holes beside near objects, at their left or right edges.

    steps: their number. share: of the steps, those with a gap of two pixels or more. width: the gaps' median
    width, pixels. baseline: median of gap / (fx (1/near - 1/far)), meters: that between the camera and the
    projector (or second camera) whose view the object blocks.
    """

    steps: int
    share: float
    width: float
    baseline: float


def field_of_view(measured: Mask) -> tuple[slice, slice]:
    """The rows and columns from the first to the last with enough depth. measured: (N, H, W)."""
    often = measured.mean(axis=0)
    spans = []
    for axis in (1, 0):
        seen = np.flatnonzero(often.mean(axis=axis) > MIN_FIELD_SHARE)
        spans.append(slice(int(seen[0]), int(seen[-1]) + 1) if len(seen) else slice(0, 0))
    return spans[0], spans[1]


def hole_shares(measured: Mask, gray: NDArray[np.uint8]) -> HoleShares:
    """The shares by brightness; NaN without such pixels. measured, gray: of the same shape."""
    dark, bright = gray < MAX_DARK, gray > MIN_BRIGHT
    return HoleShares(*(_share(~measured[kept]) for kept in (gray >= 0, dark, ~dark & ~bright, bright)))


def find_steps(depth: Array) -> Steps:
    """The steps along the rows of a depth image (H, W), NaN where nothing was measured."""
    rows, columns = np.nonzero(np.isfinite(depth))
    z = depth[rows, columns]
    gap = np.diff(columns) - 1
    left, right = z[:-1], z[1:]
    near, far = np.minimum(left, right), np.maximum(left, right)
    chosen = (np.diff(rows) == 0) & (gap <= MAX_GAP) & (far - near > MIN_STEP * near)
    return Steps(gap[chosen], (left < right)[chosen], near[chosen], far[chosen])


def pool_steps(parts: list[Steps]) -> Steps:
    """The steps of several images."""
    return Steps(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def measure_shadow(steps: Steps, at_left: bool, fx: float) -> Shadow:
    """The shadow at the left or the right edges of near objects."""
    own = (steps.near_left != at_left) & (fx * (1 / steps.near - 1 / steps.far) > MIN_PARALLAX)
    gap, near, far = steps.gap[own], steps.near[own], steps.far[own]
    if not len(gap):
        return Shadow(0, *[float("nan")] * 3)
    wide = gap >= 2
    width = float(np.median(gap[wide])) if wide.any() else 0.0
    baseline = float(np.median(gap / (fx * (1 / near - 1 / far))))
    return Shadow(len(gap), float(wide.mean()), width, baseline)


def fill_holes(depth: Array) -> Array:
    """The depth with holes filled along rows by the farther neighbor, as the background is in the shadow."""
    known = np.isfinite(depth)
    columns = np.arange(depth.shape[1])
    before = np.maximum.accumulate(np.where(known, columns, -1), axis=1)
    after = np.minimum.accumulate(np.where(known, columns, depth.shape[1])[:, ::-1], axis=1)[:, ::-1]
    rows = np.arange(depth.shape[0])[:, None]
    left = np.where(before >= 0, depth[rows, np.maximum(before, 0)], np.nan)
    right = np.where(after < depth.shape[1], depth[rows, np.minimum(after, depth.shape[1] - 1)], np.nan)
    return np.asarray(np.fmax(left, right))


def _share(flags: Mask) -> float:
    return float(flags.mean()) if flags.size else float("nan")
