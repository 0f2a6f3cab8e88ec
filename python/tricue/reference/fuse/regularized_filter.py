# SPDX-License-Identifier: MIT
"""Learning of a correlation filter that is 0 outside a mask, and near the previous filter."""

import numpy as np

from tricue.reference.base.arrays import Singles
from tricue.reference.base.checks import refuse
from tricue.reference.fuse.correlation_response import Complexes, require_cells


def regularized_filter(
    cells: Singles,
    mask: Singles,
    label: Complexes,
    previous: Complexes,
    temporal_weight: float,
    penalty: float,
) -> Complexes:
    """Uses numpy.fft, and the papers' closed-form inverse of each frequency's matrix."""
    _require_arguments(cells, mask, label, previous, temporal_weight, penalty)
    spectrum = np.fft.rfft2(cells.astype(np.float64))
    energy = (abs(spectrum) ** 2).sum(axis=0)
    temporal, step = temporal_weight * mask.size, penalty * mask.size
    base = spectrum.conj() * label + temporal * previous
    mirrored = np.roll(mask[::-1, ::-1], 1, axis=(0, 1))  # at -y, -x
    cropped = dual = np.zeros_like(spectrum)
    for _ in range(2):
        wanted = base + step * (cropped - dual)
        common = (spectrum * wanted).sum(axis=0) / (energy + step + temporal)
        free = (wanted - spectrum.conj() * common) / (step + temporal)
        cropped = np.fft.rfft2(np.fft.irfft2(free + dual, mask.shape) * mirrored)
        dual = dual + free - cropped
        step *= 10
    return np.ascontiguousarray(cropped, np.complex64)  # NumPy 1 returns transposed arrays


def _require_arguments(
    cells: Singles,
    mask: Singles,
    label: Complexes,
    previous: Complexes,
    temporal_weight: float,
    penalty: float,
) -> None:
    require_cells(cells)
    channels, rows, columns = cells.shape
    half = (rows, columns // 2 + 1)
    for name, array, shape in (
        ("mask", mask, (rows, columns)),
        ("label", label, half),
        ("previous", previous, (channels, *half)),
    ):
        if array.shape != shape:
            refuse(name, f"shape {shape}", array.shape)
    if not 0 <= temporal_weight < np.inf:
        refuse("temporal_weight", "a finite number, not negative", float(temporal_weight))
    if not 0 < penalty < np.inf:
        refuse("penalty", "a finite number above 0", float(penalty))
