# SPDX-License-Identifier: MIT
"""What the target looks like, and how likely a window of the image is to show it."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.color_contrast import ColorContrast
from tricue.track.color_params import ColorParticleParams
from tricue.track.observation import observation
from tricue.track.pattern import grid, ring

Floats = NDArray[Any]
Image = NDArray[np.uint8]

RING_SAMPLES = 64
FAINT = 0.1  # a color contrast under which colors can't recognise the target


@dataclass(frozen=True, slots=True)
class Judgement:
    """How well one window shows the target."""

    log_likelihood: float
    score: float


class Appearance:
    """The observation model and the colors against the surround, learnt together."""

    def __init__(self, p: ColorParticleParams) -> None:
        self.p = p
        self.model = observation(p)
        self.contrast = ColorContrast() if p.color_weight > 0 else None
        self.grid = grid(*p.grid, p.grid_reach)
        self.ring = ring(RING_SAMPLES, *p.ring)
        self.sharpness = self.model.sharpness if p.sharpness is None else p.sharpness

    def start(self, k: Kernels, image: Image, ellipse: Floats) -> None:
        """Forget all, learn the window."""
        self.learn(k, image, ellipse, 1.0, 1.0)
        if self.contrast:
            self.contrast.first = float(self.contrast.measure(k, *self._look(k, image, ellipse[None]))[0])

    def learn(self, k: Kernels, image: Image, ellipse: Floats, rate: float, color_rate: float) -> None:
        """Blend the window into the models."""
        window = ellipse[None]
        self.model.learn(k, *self._look(k, image, window), rate)
        if self.contrast:
            self.contrast.learn(k, image, window, color_rate)

    def log_likelihood(self, k: Kernels, image: Image, ellipses: Floats) -> Floats:
        """(N,) log p(y | x): equation (18), or its exponential form, times the color term."""
        distance, contrast = self._measure(k, image, ellipses)
        return self._log_likelihood(distance, contrast)

    def judge(self, k: Kernels, image: Image, ellipse: Floats) -> Judgement:
        """The likelihood at the estimate itself, and the score: the chance that one of both cues recognises the target."""
        distance, contrast = self._measure(k, image, ellipse[None])
        doubt = min(float(distance[0]) / self.model.unrelated, 1.0)
        if self.contrast:
            seen = float(contrast[0]) / max(self.contrast.first, FAINT)
            doubt *= 1 - min(max(seen, 0.0), 1.0)
        return Judgement(float(self._log_likelihood(distance, contrast)[0]), 1 - doubt)

    def _look(self, k: Kernels, image: Image, ellipses: Floats) -> tuple[Image, Image]:
        return k.sample_ellipses(image, ellipses, self.grid), k.sample_ellipses(image, ellipses, self.ring)

    def _measure(self, k: Kernels, image: Image, ellipses: Floats) -> tuple[Floats, Floats | float]:
        inside, around = self._look(k, image, ellipses)
        contrast = self.contrast.measure(k, inside, around) - self.contrast.first if self.contrast else 0.0
        return self.model.distance(k, inside, around), contrast

    def _log_likelihood(self, distance: Floats, contrast: Floats | float) -> Floats:
        colors = self.p.color_weight * contrast
        if self.p.likelihood == "linear":
            return np.log(np.maximum(1 - distance, 1e-12), dtype=np.float64) + colors
        return colors - self.sharpness * np.square(distance, dtype=np.float64)
