# SPDX-License-Identifier: MIT
"""The protocol of the six observation models, which weigh particles by the samples of their windows.

A model gets samples only: ``inside`` (N, 3, n) on the window's grid and ``around`` (N, 3, m) in its ring.
"""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels

Samples = NDArray[np.uint8]
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

NO_MODEL: Singles = np.empty(0, np.float32)  # before the first frame is learned


class ObservationModel(Protocol):
    """A model of the target's appearance; a value, which ``learn`` replaces."""

    @property
    def sharpness(self) -> float:
        """The default of the exponential likelihood exp(-sharpness d²), found by experiment."""

    def learn(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "ObservationModel":
        """Blend in the first window; a rate of 1 initializes the model."""

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        """(N,) distances of the windows to the model, in [0, 1].

        searching: for a lost target, to the most similar appearance that the model remembers.
        """

    def score(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        """Confidence, in [0, 1], that the first window shows the target; about 0 for unrelated windows."""


def blend(old: NDArray[Any], new: NDArray[Any], rate: float) -> NDArray[Any]:
    """The exponential moving average; a rate of 1 takes the new value alone."""
    return new if rate >= 1 else old + new.dtype.type(rate) * (new - old)


def distance_score(
    model: ObservationModel, k: Kernels, inside: Samples, around: Samples, unrelated: float
) -> float:
    """1 - d / unrelated, at least 0. unrelated: the typical distance of windows without the target."""
    return max(1 - float(model.distance(k, inside[:1], around[:1])[0]) / unrelated, 0.0)
