# SPDX-License-Identifier: MIT
"""What the target looks like, and how likely a window of the image is to show it."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid, ring
from tricue.track.color_particle.contrast import ColorContrast
from tricue.track.color_particle.observation import Observation, RankSpatial, observation
from tricue.track.color_particle.params import ColorParticleParams

Floats = NDArray[Any]
Image = NDArray[np.uint8]


class Look(NamedTuple):
    """The samples of N windows: (N, 3, n) on the grid inside, (N, 3, m) in the ring around."""

    inside: Image
    around: Image


class Appearance(NamedTuple):
    """The observation model and the colors against the surround, learned together."""

    model: Observation
    contrast: ColorContrast | None
    grid: Floats  # (n, 2) where windows are sampled, in semi-axes
    ring: Floats  # (m, 2) the same around them
    linear: bool  # whether the likelihood is (18) as printed
    sharpness: float

    @classmethod
    def of(cls, p: ColorParticleParams) -> "Appearance":
        """Of which nothing is known yet."""
        model = observation(p)
        return cls(
            model,
            ColorContrast(p.color_weight) if p.color_weight > 0 else None,
            grid(*p.grid, p.grid_reach),
            ring(p.ring_samples, *p.ring),
            p.likelihood == "linear",
            model.sharpness if p.sharpness is None else p.sharpness,
        )

    def look(self, k: Kernels, image: Image, ellipses: Floats) -> Look:
        """Read the windows of N ellipses."""
        return Look(
            k.sample_ellipses(image, ellipses, self.grid), k.sample_ellipses(image, ellipses, self.ring)
        )

    def log_likelihood(self, k: Kernels, image: Image, ellipses: Floats, searching: bool = False) -> Floats:
        """(N,) log p(y | x): equation (18), or its exponential form, times the color term."""
        distance, contrast = self.measure(k, image, ellipses, searching)
        if self.linear:
            contrast += np.log(np.maximum(1 - distance, 1e-12))
        else:
            contrast -= self.sharpness * distance * distance
        return contrast

    def measure(
        self, k: Kernels, image: Image, ellipses: Floats, searching: bool = False
    ) -> tuple[Floats, Floats]:
        """(N,) distances to the model, and (N,) of the color term; both in one pass where a kernel does."""
        if self.contrast and isinstance(self.model, RankSpatial):
            maps, table = self.model.maps, self.contrast.table
            distances, contrast = k.rank_contrast(image, ellipses, self.grid, self.ring, maps, table)
            return self.model.chosen(distances, searching), self.contrast.weight * contrast
        look = self.look(k, image, ellipses)
        distance = self.model.distance(k, *look, searching).astype(np.float64)
        return distance, self.contrast.log_likelihood(k, *look) if self.contrast else np.zeros(len(ellipses))

    def recognition(self, k: Kernels, look: Look, searching: bool = False) -> float:
        """How surely the first window shows the target, in [0, 1]."""
        return self.model.recognition(k, *look, searching)

    def learned(
        self, k: Kernels, image: Image, ellipse: Floats, look: Look, rate: float, color_rate: float
    ) -> "Appearance":
        """With the window of one ellipse (1, 4) blended into the models; rates of 1 start them."""
        contrast = self.contrast and self.contrast.learned(k, image, ellipse, color_rate)
        return self._replace(model=self.model.learned(k, *look, rate), contrast=contrast)
