# SPDX-License-Identifier: MIT
"""Learning of a multi-channel correlation filter."""

import numpy as np

from tricue.reference.base.arrays import Singles
from tricue.reference.base.checks import refuse
from tricue.reference.fuse.correlation_response import Complexes, require_filter


def correlation_train(
    cells: Singles,
    label: Complexes,
    numerator: Complexes,
    denominator: Singles,
    rate: float,
) -> tuple[Complexes, Singles]:
    """Computes the spectra with numpy.fft, and blends numerator and denominator."""
    require_filter(cells, numerator, denominator)
    require_rate(rate)
    if label.shape != denominator.shape:
        refuse("label", f"shape {denominator.shape}", label.shape)
    spectra = np.fft.rfft2(cells.astype(np.float64))
    energy = (abs(spectra) ** 2).sum(axis=0)
    return (  # contiguous, as NumPy 1 returns transposed arrays
        np.ascontiguousarray(numerator + rate * (label * spectra.conj() - numerator), np.complex64),
        np.ascontiguousarray(denominator + rate * (energy - denominator), np.float32),
    )


def require_rate(rate: float) -> None:
    """Refuse a learning rate outside [0, 1]."""
    if not 0 <= rate <= 1:
        refuse("rate", "a number in [0, 1]", float(rate))
