# SPDX-License-Identifier: MIT
"""Learning of a correlation filter with many channels."""

import numpy as np

from tricue.reference.base.checks import refuse
from tricue.reference.fuse.correlation_response import Complexes, Floats, require_filter


def correlation_train(
    cells: Floats,
    label: Complexes,
    numerator: Complexes,
    denominator: Floats,
    rate: float,
) -> tuple[Complexes, Floats]:
    """Takes the transforms of numpy.fft, channel by channel."""
    require_filter(cells, numerator, denominator)
    require_rate(rate)
    if label.shape != denominator.shape:
        refuse("label", f"shape {denominator.shape}", label.shape)
    spectra = np.fft.rfft2(cells.astype(np.float64))
    energy = (abs(spectra) ** 2).sum(axis=0)
    return (  # contiguous, which the transforms of NumPy 1 are not
        np.ascontiguousarray(numerator + rate * (label * spectra.conj() - numerator), np.complex64),
        np.ascontiguousarray(denominator + rate * (energy - denominator), np.float32),
    )


def require_rate(rate: float) -> None:
    """Refuse what would forget more than all."""
    if not 0 <= rate <= 1:
        refuse("rate", "a number in [0, 1]", float(rate))
