# SPDX-License-Identifier: MIT
"""What all correlation filters have in common."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.params import Params, parameter
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.window import WINDOW_CELLS

Spectra = NDArray[np.complex64]

CHANNELS = 19  # of the cells: orientations, texture and colors


@dataclass(frozen=True, kw_only=True)
class FirstFrameParams(Params):
    """How much of the first frame the filters keep."""

    first_frame_weight: float = parameter(
        0.2,
        unit="-",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="share of the first frame's filter, for place and size",
        was="anchor",
    )


def label_spectrum(width: float) -> Spectra:
    """The spectrum of the desired response, a Gaussian at (0, 0); width: its standard deviation, cells."""
    offset = np.fft.fftfreq(WINDOW_CELLS, 1 / WINDOW_CELLS)
    profile = np.exp(-0.5 * (offset / width) ** 2)
    spectrum = np.fft.rfft2(np.outer(profile, profile))
    return np.ascontiguousarray(spectrum, np.complex64)  # NumPy 1 returns a transposed array
