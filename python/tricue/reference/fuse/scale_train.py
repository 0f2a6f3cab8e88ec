# SPDX-License-Identifier: MIT
"""Learning of a correlation filter over scales."""

import numpy as np

from tricue.reference.base.checks import refuse
from tricue.reference.fuse.correlation_train import require_rate
from tricue.reference.fuse.scale_response import Complexes, Floats, require_scale_filter


def scale_train(
    looks: Floats, label: Complexes, numerator: Complexes, denominator: Floats, rate: float
) -> tuple[Complexes, Floats]:
    """Takes the transforms of numpy.fft along the scales."""
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
