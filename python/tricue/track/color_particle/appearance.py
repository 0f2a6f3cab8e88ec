# SPDX-License-Identifier: MIT
"""The target's appearance: the likelihood that a window of the image shows it, and how it is learned."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid, ring
from tricue.track.color_particle.color_contrast import ColorContrast
from tricue.track.color_particle.color_models import Gaussian, Histogram, Lookup, Region
from tricue.track.color_particle.observation_model import ObservationModel
from tricue.track.color_particle.params import ColorParticleParams
from tricue.track.color_particle.rank_models import RankSections, RankSpatial

Floats = NDArray[Any]
Image = NDArray[np.uint8]

OBSERVATION_MODELS: dict[str, type[Any]] = {
    "region": Region,
    "gaussian": Gaussian,
    "lookup": Lookup,
    "histogram": Histogram,
    "rank-sections": RankSections,
    "rank-spatial": RankSpatial,
}
MIN_LINEAR_LIKELIHOOD = 1e-12  # in its logarithm


class WindowSamples(NamedTuple):
    """Pixels of N windows: (N, 3, n) on the grid inside each window, (N, 3, m) in the ring around it."""

    inside: Image
    around: Image


class Appearance(NamedTuple):
    """The observation model and the color contrast, which are learned together."""

    model: ObservationModel
    contrast: ColorContrast | None
    grid: Floats  # (n, 2) sample positions in the window, semi-axes
    ring: Floats  # (m, 2) sample positions around it, semi-axes
    linear: bool  # whether the likelihood is (18) as printed
    sharpness: float

    @classmethod
    def create(cls, p: ColorParticleParams) -> "Appearance":
        """Models that have learned nothing yet."""
        model: ObservationModel = OBSERVATION_MODELS[p.observation].create(p)
        window = grid(*p.grid, p.grid_reach)
        if p.window_shape == "ellipse":
            window = window[np.hypot(*window.T) <= p.grid_reach]
        return cls(
            model,
            ColorContrast(p.color_weight) if p.color_weight > 0 else None,
            window,
            ring(p.ring_samples, *p.ring),
            p.likelihood == "linear",
            model.sharpness if p.sharpness is None else p.sharpness,
        )

    def sample(self, k: Kernels, image: Image, ellipses: Floats) -> WindowSamples:
        """Sample the windows of ellipses (N, 4)."""
        return WindowSamples(
            k.sample_ellipses(image, ellipses, self.grid), k.sample_ellipses(image, ellipses, self.ring)
        )

    def log_likelihood(self, k: Kernels, image: Image, ellipses: Floats, searching: bool = False) -> Floats:
        """(N,) log p(y | x), nats: equation (18), or its exponential form, times the color contrast term."""
        model, contrast = self.model, self.contrast
        if contrast and isinstance(model, RankSpatial) and not self.linear:  # one kernel does it all
            return k.rank_likelihood(
                image,
                ellipses,
                self.grid,
                self.ring,
                model.maps,
                model.weights,
                searching,
                contrast.table,
                self.sharpness,
                contrast.weight,
            )
        samples = self.sample(k, image, ellipses)
        distance = model.distance(k, *samples, searching).astype(np.float64)
        if self.linear:
            log_likelihood: Floats = np.log(np.maximum(1 - distance, MIN_LINEAR_LIKELIHOOD))
        else:
            log_likelihood = -self.sharpness * distance * distance
        return log_likelihood + contrast.log_likelihood(k, *samples) if contrast else log_likelihood

    def score(self, k: Kernels, samples: WindowSamples, searching: bool = False) -> float:
        """Confidence, in [0, 1], that the first window shows the target."""
        return self.model.score(k, *samples, searching)

    def learn(
        self,
        k: Kernels,
        image: Image,
        ellipse: Floats,
        samples: WindowSamples,
        rate: float,
        color_rate: float,
    ) -> "Appearance":
        """Blend the window of one ellipse (1, 4) into both models; rates of 1 initialize them."""
        contrast = self.contrast and self.contrast.learn(k, image, ellipse, color_rate)
        model = self.model.learn(k, *samples, rate)
        return Appearance(model, contrast, self.grid, self.ring, self.linear, self.sharpness)
