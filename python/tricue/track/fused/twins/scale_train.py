# SPDX-License-Identifier: MIT
"""Learning of a correlation filter over scales."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse


def scale_train(
    looks: NDArray[np.float32],
    label: NDArray[np.complex64],
    numerator: NDArray[np.complex64],
    denominator: NDArray[np.float32],
    rate: float,
) -> tuple[NDArray[np.complex64], NDArray[np.float32]]:
    """Numerator (D, S) and denominator (S,) with new looks (S, D) blended in; a rate of 1 starts them.

    As :func:`correlation_train` along one dimension; label (S,) is the wanted answer's spectrum.
    """
    if not 0 <= rate <= 1:
        refuse("rate", "a number in [0, 1]", float(rate))
    spectrum = np.fft.fft(looks.T, axis=1)
    own = label * spectrum.conj()
    energy = (spectrum.real**2 + spectrum.imag**2).sum(axis=0)
    if numerator.shape != own.shape:
        refuse("numerator", f"shape {own.shape}", numerator.shape)
    if denominator.shape != energy.shape:
        refuse("denominator", f"shape {energy.shape}", denominator.shape)
    return (
        (numerator + rate * (own - numerator)).astype(np.complex64),
        (denominator + rate * (energy - denominator)).astype(np.float32),
    )
