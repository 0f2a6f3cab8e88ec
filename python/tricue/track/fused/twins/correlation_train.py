# SPDX-License-Identifier: MIT
"""Learning of a correlation filter with many channels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse


def correlation_train(
    cells: NDArray[np.float32],
    focus: NDArray[np.float32],
    label: NDArray[np.complex64],
    numerator: NDArray[np.complex64],
    denominator: NDArray[np.float32],
    rate: float,
    background: float,
) -> tuple[NDArray[np.complex64], NDArray[np.float32]]:
    """Numerator and denominator with new cells (K, R, C) blended in at a rate in [0, 1]; 1 starts them.

    Danelljan et al. 2014 (5): A_k = Y X̄_k and B = sum_k X_k X̄_k, the label Y (R, C // 2 + 1) being the
    spectrum of the wanted answer, its peak at (0, 0). X are the cells times the focus (R, C) on the target;
    what is left of them is to be answered by 0 and adds ``background`` times its energy to B, as in
    Mueller, Smith and Ghanem 2017 (7).
    """
    if not 0 <= rate <= 1:
        refuse("rate", "a number in [0, 1]", float(rate))
    if not background >= 0:
        refuse("background", "a number of at least 0", float(background))
    if focus.shape != cells.shape[1:]:
        refuse("focus", f"shape {cells.shape[1:]}", focus.shape)
    spectrum = np.fft.rfft2(cells * focus)
    own = label * spectrum.conj()
    energy = (spectrum.real**2 + spectrum.imag**2).sum(axis=0)
    if background > 0:
        other = np.fft.rfft2(cells * (1 - focus))
        energy += background * (other.real**2 + other.imag**2).sum(axis=0)
    if numerator.shape != own.shape:
        refuse("numerator", f"shape {own.shape}", numerator.shape)
    if denominator.shape != energy.shape:
        refuse("denominator", f"shape {energy.shape}", denominator.shape)
    return (
        (numerator + rate * (own - numerator)).astype(np.complex64),
        (denominator + rate * (energy - denominator)).astype(np.float32),
    )
