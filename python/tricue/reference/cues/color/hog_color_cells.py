# SPDX-License-Identifier: MIT
"""Features of a correlation filter: oriented gradients, texture and colors of a patch, in 2x2-pixel cells."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse

Planes = NDArray[np.float32]

FAINT = np.float32(102)  # levels: blocks with less contrast are noise, which normalization mustn't amplify
MAX_SHARE = np.float32(0.2)  # of a block's contrast, for one orientation in one cell
TEXTURE = np.float32(0.2357)


def hog_color_cells(patch: NDArray[np.uint8], taper: Planes) -> Planes:
    """Distributes the gradients over bins and cells, and normalizes each cell by four blocks."""
    rows, columns = taper.shape
    if taper.size < 1:
        refuse("taper", "at least one cell", "none")
    if patch.shape != (2 * rows, 2 * columns, 3):
        refuse("patch", f"shape {(2 * rows, 2 * columns, 3)}, twice the taper's", patch.shape)
    levels = patch.astype(np.float32)
    colors = levels[::2] + levels[1::2]
    colors = (colors[:, ::2] + colors[:, 1::2]).transpose(2, 0, 1)
    means = (colors.sum(axis=(1, 2), dtype=np.float64) / (1020 * taper.size)).astype(np.float32)
    colors = colors / np.float32(1020) - means[:, None, None]
    return np.concatenate([_normalized(_bilinear(_orientations(levels))), colors]) * taper


def _orientations(levels: Planes) -> Planes:
    """(8, 2R, 2C): bin k holds gradients toward 45 k degrees, x right and y down."""
    wide = np.pad(levels, ((1, 1), (1, 1), (0, 0)), mode="edge")
    down, right = wide[2:, 1:-1] - wide[:-2, 1:-1], wide[1:-1, 2:] - wide[1:-1, :-2]
    strongest = np.argmax(down * down + right * right, axis=2)[..., None]
    gy, gx = (np.take_along_axis(each, strongest, 2)[..., 0] for each in (down, right))
    ay, ax, length = abs(gy), abs(gx), np.sqrt(gy * gy + gx * gx)
    # Within an octant, the ratio of the components replaces the angle: this saves the arctangent.
    diagonal = np.minimum(ax, ay) / np.maximum(np.maximum(ax, ay), 1) * length
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


def _bilinear(planes: Planes) -> Planes:
    """(8, R, C): planes (8, 2R, 2C) summed over cells; each pixel contributes to the four cells around it."""
    wide = np.pad(planes, ((0, 0), (1, 1), (1, 1)))
    rows = (wide[:, :-2:2] + wide[:, 3::2]) + 3 * (wide[:, 1:-1:2] + wide[:, 2::2])
    sums = (rows[:, :, :-2:2] + rows[:, :, 3::2]) + 3 * (rows[:, :, 1:-1:2] + rows[:, :, 2::2])
    cells: Planes = sums / np.float32(16)
    return cells


def _normalized(signed: Planes) -> Planes:
    """(16, R, C): 8 signed and 4 unsigned orientations, normalized and clipped, and 4 channels of texture."""
    unsigned = signed[:4] + signed[4:]
    energy = np.pad(_sum(unsigned * unsigned), 1, mode="edge")
    columns = energy[:-1] + energy[1:]
    scale = 1 / np.sqrt(columns[:, :-1] + columns[:, 1:] + FAINT * FAINT)
    blocks = np.stack([scale[:-1, :-1], scale[:-1, 1:], scale[1:, :-1], scale[1:, 1:]])[:, None]
    shares = np.minimum(np.concatenate([signed, unsigned]) * blocks, MAX_SHARE)  # (4, 12, R, C)
    texture = TEXTURE * _sum(shares[:, :8].swapaxes(0, 1))
    return np.concatenate([_sum(shares) / 2, texture])


def _sum(planes: Planes) -> Planes:
    """The sum over the first axis, in the native kernel's order."""
    total: Planes = planes[0]
    for plane in planes[1:]:
        total = total + plane
    return total
