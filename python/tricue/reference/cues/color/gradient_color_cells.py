# SPDX-License-Identifier: MIT
"""Orientations and colors of a patch in cells of 2x2, as a correlation filter reads them."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse

Planes = NDArray[np.float32]

FAINT = np.float32(
    32
)  # levels: gradients of a block under it are noise, and aren't blown up to full contrast
MAX_SHARE = np.float32(0.4)  # of a block's contrast in one orientation of one cell


def gradient_color_cells(patch: NDArray[np.uint8], taper: Planes) -> Planes:
    """Spreads the gradients over the orientations, sums them over cells, and normalizes the sums."""
    rows, columns = taper.shape
    if taper.size < 1:
        refuse("taper", "at least one cell", "none")
    if patch.shape != (2 * rows, 2 * columns, 3):
        refuse("patch", f"shape {(2 * rows, 2 * columns, 3)}, twice the taper's", patch.shape)
    levels = patch.astype(np.float32)
    colors = _cells(levels.transpose(2, 0, 1))
    means = (colors.sum(axis=(1, 2), dtype=np.float64) / (1020 * taper.size)).astype(np.float32)
    colors = colors / np.float32(1020) - means[:, None, None]
    return np.concatenate([_normalized(_cells(_orientations(levels))), colors]) * taper


def _orientations(levels: Planes) -> Planes:
    """(8, 2R, 2C): bin k stands for gradients towards 45 k degrees, x right and y down."""
    wide = np.pad(levels, ((1, 1), (1, 1), (0, 0)), mode="edge")
    down, right = wide[2:, 1:-1] - wide[:-2, 1:-1], wide[1:-1, 2:] - wide[1:-1, :-2]
    strongest = np.argmax(down * down + right * right, axis=2)[..., None]
    gy, gx = (np.take_along_axis(each, strongest, 2)[..., 0] for each in (down, right))
    ay, ax, length = abs(gy), abs(gx), np.sqrt(gy * gy + gx * gx)
    # Within an octant the ratio of the sides stands for the angle: no arctangent.
    diagonal = np.minimum(ax, ay) * length / np.maximum(np.maximum(ax, ay), 1)
    straight = length - diagonal
    flat = ax >= ay
    bins: Planes = np.stack(
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
    return bins


def _normalized(cells: Planes) -> Planes:
    """Cells (8, R, C) over the contrast of the 3x3 around each, cut off."""
    energy = np.zeros_like(cells[0])
    for plane in cells:
        energy += plane * plane
    energy = np.pad(energy, 1, mode="edge")
    block = energy[:-2] + energy[1:-1] + energy[2:]
    block = block[:, :-2] + block[:, 1:-1] + block[:, 2:]
    scale = 1 / np.sqrt(block + FAINT * FAINT)
    normal: Planes = np.minimum(cells * scale, MAX_SHARE)
    return normal


def _cells(planes: Planes) -> Planes:
    """(K, 2R, 2C) summed in cells of 2x2: (K, R, C)."""
    columns = planes[:, ::2] + planes[:, 1::2]
    sums: Planes = columns[:, :, ::2] + columns[:, :, 1::2]
    return sums
