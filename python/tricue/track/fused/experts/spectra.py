# SPDX-License-Identifier: MIT
"""What the correlation filters of place and size have in common."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.params import Params, parameter
from tricue.track.fused.sources import OURS
from tricue.track.fused.window import WINDOW_CELLS

Spectra = NDArray[np.complex64]


@dataclass(frozen=True, kw_only=True)
class FirstFrameParams(Params):
    """What both filters keep of the first frame."""

    first_frame_weight: float = parameter(
        0.2,
        unit="-",
        source=OURS,
        low=0,
        high=1,
        doc="share of the first frame's filter, for place and size",
        was="anchor",
    )


def blend_first_frame(learned: NDArray[Any], first: NDArray[Any], p: FirstFrameParams) -> NDArray[Any]:
    """A filter as it is learned with a share of the first frame's, against forgetting."""
    old, blended = learned.view(np.float32), first.view(np.float32) - learned.view(np.float32)
    blended *= np.float32(p.first_frame_weight)
    blended += old
    return blended.view(learned.dtype)


def label_spectrum(width: float) -> Spectra:
    """The spectrum of the desired response: a Gaussian at (0, 0) with that standard deviation in cells."""
    offset = np.fft.fftfreq(WINDOW_CELLS, 1 / WINDOW_CELLS)
    profile = np.exp(-0.5 * (offset / width) ** 2)
    spectrum = np.fft.rfft2(np.outer(profile, profile))
    return np.ascontiguousarray(spectrum, np.complex64)  # of NumPy 1 it is transposed
