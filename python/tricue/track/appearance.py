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

    def learn(self, k: Kernels, image: Image, ellipse: Floats, rate: float, color_rate: float) -> None:
        """Blend the window into the models; rates of 1 start them."""
        window = ellipse[None]
        self.model.learn(k, *self._look(k, image, window), rate)
        if self.contrast:
            self.contrast.learn(k, image, window, color_rate)

    def log_likelihood(self, k: Kernels, image: Image, ellipses: Floats) -> Floats:
        """(N,) log p(y | x): equation (18), or its exponential form, times the color term."""
        return self._log_likelihood(k, *self._look(k, image, ellipses))

    def judge(self, k: Kernels, image: Image, ellipse: Floats) -> Judgement:
        """The likelihood at the estimate itself, and how surely the model recognises the target there."""
        inside, around = self._look(k, image, ellipse[None])
        likelihood = self._log_likelihood(k, inside, around)
        return Judgement(float(likelihood[0]), self.model.recognition(k, inside, around))

    def _look(self, k: Kernels, image: Image, ellipses: Floats) -> tuple[Image, Image]:
        return k.sample_ellipses(image, ellipses, self.grid), k.sample_ellipses(image, ellipses, self.ring)

    def _log_likelihood(self, k: Kernels, inside: Image, around: Image) -> Floats:
        distance = self.model.distance(k, inside, around)
        if self.p.likelihood == "linear":
            likelihood = np.log(np.maximum(1 - distance, 1e-12), dtype=np.float64)
        else:
            likelihood = -self.sharpness * np.square(distance, dtype=np.float64)
        if self.contrast:
            likelihood += self.p.color_weight * self.contrast.measure(k, inside, around)
        return likelihood
