# SPDX-License-Identifier: MIT
"""A head that was lost is looked for in the whole picture, at every distance: by color and depth."""

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.eyes import Eyes
from tricue.track.head_search import score
from tricue.track.head_view import NO_CHECK, Ellipse, Pair
from tricue.track.stereo_params import StereoHeadParams

Floats = NDArray[np.float64]

THIN = 3  # places from one to the next, of those looked at
NEARER = 0.85  # from one distance to the next


def find_again(
    k: Kernels, pair: Pair, eyes: Eyes, size: tuple[float, float], histogram: Floats, p: StereoHeadParams
) -> tuple[Ellipse, float] | None:
    """The ellipse and the disparity, pixels, most like a head of this size, (2,) metres, and of these colors."""
    step = pair.step * THIN
    height, width = pair.small[0].shape
    first, last = eyes.disparity(p.far) / pair.step, eyes.disparity(p.near) / pair.step
    found = k.sad_disparity(
        *pair.small,
        (0, 0, width, height),
        False,
        int(first),
        int(np.ceil(last)),
        p.window,
        p.uniqueness,
        p.prefilter,
        NO_CHECK,
    )[THIN // 2 :: THIN, THIN // 2 :: THIN]
    rows, columns = found.shape
    bins = k.color_bins(pair.left, (0, 0, columns * step, rows * step), p.bins, p.chroma, step)
    best: tuple[float, Ellipse, float] | None = None
    z = p.near
    while z < p.far:
        disparity = eyes.disparity(z)
        minor, major = (half / 2 * f / z for half, f in zip(size, eyes.rig[:2].tolist(), strict=True))
        off = abs(found - np.float32(disparity / pair.step)) <= max(
            p.coherent, (1 - NEARER) / 2 * disparity / pair.step
        )
        middle = np.array([columns / 2, rows / 2, minor / step, major / step])
        grid = (rows, columns, 1)
        if min(minor, major) / step > 1:
            scores = score(k.ellipse_search(bins, middle, grid, histogram, p.ring, off.view(np.uint8)), p)
            row, column = divmod(int(np.argmax(scores)), columns)
            if best is None or scores[row, column] > best[0]:
                x = (columns / 2 + column - columns // 2) * step
                y = (rows / 2 + row - rows // 2) * step
                best = float(scores[row, column]), (x, y, minor, major), disparity
        z /= NEARER
    return None if best is None else best[1:]
