# SPDX-License-Identifier: MIT
"""Learning of a correlation filter over scales."""

import numpy as np

from tricue.reference.base.checks import refuse
from tricue.reference.fuse.correlation_train import require_rate
from tricue.reference.fuse.scale_response import Complexes, Floats, require_scale_filter


def scale_train(
    looks: Floats, label: Complexes, numerator: Complexes, denominator: Floats, rate: float
) -> tuple[Complexes, Floats]:
    """Numerator (S // 2 + 1, D) and denominator (S // 2 + 1,) with new looks (S, D) blended in.

    As correlation_train along one dimension; a rate of 1 starts them. label (S // 2 + 1,) is the wanted
    answer's spectrum, its peak at 0.
    """
    require_scale_filter(looks, numerator, denominator)
    if label.shape != denominator.shape:
        refuse("label", f"shape {denominator.shape}", label.shape)
    require_rate(rate)
    spectrum = np.fft.rfft(looks.astype(np.float64), axis=0)
    energy = (abs(spectrum) ** 2).sum(axis=1)
    return (
        (numerator + rate * (label[:, None] * spectrum.conj() - numerator)).astype(np.complex64),
        (denominator + rate * (energy - denominator)).astype(np.float32),
    )
