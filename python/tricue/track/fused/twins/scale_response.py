# SPDX-License-Identifier: MIT
"""The answer of a correlation filter over scales."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse


def scale_response(
    looks: NDArray[np.float32],
    numerator: NDArray[np.complex64],
    denominator: NDArray[np.float32],
    ridge: float,
) -> NDArray[np.float32]:
    """(S,): how much the looks (S, D) of a target at S steps of scale, shifted, are as those learnt.

    Danelljan et al. 2014, section 3.2: one dimension along the scales, D channels; the middle one, S // 2, is
    no change. numerator: (D, S), denominator: (S,); λ is ridge times its mean.
    """
    count, channels = looks.shape
    if numerator.shape != (channels, count):
        refuse("numerator", f"shape {(channels, count)}", numerator.shape)
    if denominator.shape != (count,):
        refuse("denominator", f"shape {(count,)}", denominator.shape)
    product = (numerator * np.fft.fft(looks.T, axis=1)).sum(axis=0)
    answer = np.fft.ifft(product / (denominator + ridge * max(float(denominator.mean()), 1e-12))).real
    return np.fft.fftshift(answer).astype(np.float32)
