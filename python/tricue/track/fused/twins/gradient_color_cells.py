# SPDX-License-Identifier: MIT
"""Orientations and colors of a patch in cells of 2x2, as a correlation filter reads them."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse

Planes = NDArray[np.float32]

FAINT = 32.0  # levels: gradients of a block under it are noise, and aren't blown up to full contrast
MOST = 0.4  # of a block's contrast in one orientation of one cell


def gradient_color_cells(patch: NDArray[np.uint8], taper: Planes) -> Planes:
    """(11, R, C) of a BGR patch (2R, 2C, 3), times taper (R, C).

    Eight signed orientations (Dalal and Triggs 2005: of the channel with the strongest gradient, shared out
    between the two nearest, over the contrast of the 3x3 cells around, cut off), then B, G, R in [0, 1]
    without their mean over the patch.
    """
    rows, columns = taper.shape
    if patch.shape != (2 * rows, 2 * columns, 3):
        refuse("patch", f"shape {(2 * rows, 2 * columns, 3)}, twice the taper's", patch.shape)
    levels = patch.astype(np.float32)
    colors = _cells(levels.transpose(2, 0, 1)) / np.float32(4 * 255)
    colors -= colors.mean(axis=(1, 2), keepdims=True)
    return np.concatenate([_orientations(levels), colors]) * taper


def _orientations(levels: Planes) -> Planes:
    """(8, R, C): bin k stands for gradients towards 45 k degrees, x right and y down."""
    wide = np.pad(levels, ((1, 1), (1, 1), (0, 0)), mode="edge")
    down, right = wide[2:, 1:-1] - wide[:-2, 1:-1], wide[1:-1, 2:] - wide[1:-1, :-2]
    strongest = np.argmax(down * down + right * right, axis=2)[..., None]
    gy, gx = (np.take_along_axis(each, strongest, 2)[..., 0] for each in (down, right))
    ay, ax = np.abs(gy), np.abs(gx)
    # Within an octant the ratio of the sides stands for the angle: no arctangent.
    diagonal = np.minimum(ax, ay) * np.hypot(ax, ay) / np.maximum(np.maximum(ax, ay), 1e-9)
    straight = np.hypot(ax, ay) - diagonal
    flat = ax >= ay
    bins = np.stack(
        [
            straight * (flat & (gx >= 0)),
            diagonal * ((gx >= 0) & (gy >= 0)),
            straight * (~flat & (gy >= 0)),
            diagonal * ((gx < 0) & (gy >= 0)),
            straight * (flat & (gx < 0)),
            diagonal * ((gx < 0) & (gy < 0)),
            straight * (~flat & (gy < 0)),
            diagonal * ((gx >= 0) & (gy < 0)),
        ]
    )
    cells = _cells(bins)
    energy = np.pad((cells * cells).sum(axis=0), 1, mode="edge")
    block = energy[:-2] + energy[1:-1] + energy[2:]
    block = block[:, :-2] + block[:, 1:-1] + block[:, 2:]
    normal: Planes = np.minimum(cells / np.sqrt(block + np.float32(FAINT**2)), np.float32(MOST))
    return normal


def _cells(planes: Planes) -> Planes:
    """(K, 2R, 2C) summed in cells of 2x2: (K, R, C)."""
    count, rows, columns = planes.shape
    sums: Planes = planes.reshape(count, rows // 2, 2, columns // 2, 2).sum(axis=(2, 4))
    return sums
