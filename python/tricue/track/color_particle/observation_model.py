# SPDX-License-Identifier: MIT
"""The protocol of the six observation models, which weigh particles by the samples of their windows.

Samples are ``inside`` (N, 3, n) on the window's grid and ``around`` (N, 3, m) in its ring. A model learns and
recognizes the observation of one window: its samples, or for ``RankSpatial`` their ranks.
"""

from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats, Singles
from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid
from tricue.track.color_particle.params import ColorParticleParams

Samples = NDArray[np.uint8]

NO_MODEL: Singles = np.empty(0, np.float32)  # before the first frame is learned


class WindowSamples(NamedTuple):
    """Pixels of N windows: (N, 3, n) on the grid inside each window, (N, 3, m) in the ring around it."""

    inside: Samples
    around: Samples


class ObservationModel(Protocol):
    """A model of the target's appearance; immutable, ``learn`` returns a new one."""

    @property
    def sharpness(self) -> float:
        """The default sharpness of the likelihood exp(-sharpness d²), found by experiment."""

    def learn(self, k: Kernels, seen: Any, rate: float) -> "ObservationModel":
        """Blend in the observation of one window; a rate of 1 replaces the model, which initializes it."""

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        """(N,) distances of the windows to the model, in [0, 1].

        searching: for a lost target; distances are then to the most similar appearance in the model's memory.
        """

    def recognition(self, k: Kernels, seen: Any, searching: bool = False) -> float:
        """The similarity, in [0, 1], of the observation to the model; about 0 for unrelated windows."""


def window_grid(p: ColorParticleParams) -> NDArray[np.float64]:
    """(n, 2): sample positions in the window, semi-axes."""
    places = grid(*p.grid, p.grid_reach)
    return places[np.hypot(*places.T) <= p.grid_reach] if p.window_shape == "ellipse" else places


def blend(old: NDArray[Any], new: NDArray[Any], rate: float) -> NDArray[Any]:
    """The exponential moving average; a rate of 1 gives the new value."""
    return new if rate >= 1 else old + new.dtype.type(rate) * (new - old)


def recognition_by_distance(
    model: ObservationModel, k: Kernels, seen: WindowSamples, unrelated: float
) -> float:
    """1 - d / unrelated, at least 0. unrelated: the typical distance of windows without the target."""
    return max(1 - float(model.distance(k, *seen)[0]) / unrelated, 0.0)
