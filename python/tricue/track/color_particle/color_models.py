# SPDX-License-Identifier: MIT
"""The color models that the paper compares its ranks with: skin models and a histogram."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Singles
from tricue.kernels import Kernels
from tricue.track.color_particle.observation_model import (
    NO_MODEL,
    Samples,
    WindowSamples,
    blend,
    recognition_by_distance,
)
from tricue.track.color_particle.params import ColorParticleParams

HISTOGRAM_BINS = 16  # of each channel
MIN_CHROMA_VARIANCE = 4.0  # levels², a sensor's noise in a uniform color


def skin_distance(inside: Singles, around: Singles) -> Floats:
    """(N,) in [0, 1]: 1 minus the difference of the mean skin probabilities inside and around the windows."""
    difference = inside.mean(axis=1, dtype=np.float64) - around.mean(axis=1, dtype=np.float64)
    distance: Floats = 1 - np.clip(difference, 0, 1)
    return distance


class Histogram(NamedTuple):
    """The color histogram of figure 2, 16 bins per channel, with the Bhattacharyya distance."""

    histogram: Singles = NO_MODEL
    sharpness: float = 300.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "Histogram":
        return cls()

    def learn(self, k: Kernels, seen: WindowSamples, rate: float) -> "Histogram":
        return Histogram(blend(self.histogram, k.color_histogram(seen.inside, HISTOGRAM_BINS)[0], rate))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return k.bhattacharyya(k.color_histogram(inside, HISTOGRAM_BINS), self.histogram, 3)

    def recognition(self, k: Kernels, seen: WindowSamples, searching: bool = False) -> float:
        return recognition_by_distance(self, k, seen, unrelated=0.6)


class Region(NamedTuple):
    """Region-based: the explicit RGB rule of Peer et al. 2003. It learns nothing."""

    sharpness: float = 10.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "Region":
        return cls()

    def learn(self, k: Kernels, seen: WindowSamples, rate: float) -> "Region":
        return self

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return skin_distance(k.skin_rule(inside), k.skin_rule(around))

    def recognition(self, k: Kernels, seen: WindowSamples, searching: bool = False) -> float:
        return recognition_by_distance(self, k, seen, unrelated=1.0)


class Gaussian(NamedTuple):
    """Parametric: a Gaussian over the target's chrominance (Cb, Cr)."""

    mean: Floats
    covariance: Floats
    sharpness: float = 100.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "Gaussian":
        return cls(np.zeros(2), np.eye(2))

    def learn(self, k: Kernels, seen: WindowSamples, rate: float) -> "Gaussian":
        b, g, r = seen.inside[0].astype(np.float64)
        luma = 0.299 * r + 0.587 * g + 0.114 * b
        chroma = np.stack([128 + (b - luma) / 1.772, 128 + (r - luma) / 1.402])  # as in skin_gaussian
        covariance = np.cov(chroma, bias=True) + MIN_CHROMA_VARIANCE * np.eye(2)
        return Gaussian(blend(self.mean, chroma.mean(axis=1), rate), blend(self.covariance, covariance, rate))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        precision = np.linalg.inv(self.covariance)
        precision = (precision + precision.T) / 2  # inv's result is symmetric only up to rounding
        skin, other = (k.skin_gaussian(each, self.mean, precision) for each in (inside, around))
        return skin_distance(skin, other)

    def recognition(self, k: Kernels, seen: WindowSamples, searching: bool = False) -> float:
        return recognition_by_distance(self, k, seen, unrelated=1.0)


class Lookup(NamedTuple):
    """Non-parametric: a look-up table, the target's joint histogram scaled to a maximum of 1."""

    histogram: Singles = NO_MODEL
    table: Singles = NO_MODEL
    sharpness: float = 100.0

    @classmethod
    def create(cls, p: ColorParticleParams) -> "Lookup":
        return cls()

    def learn(self, k: Kernels, seen: WindowSamples, rate: float) -> "Lookup":
        histogram = blend(self.histogram, k.joint_histogram(seen.inside, HISTOGRAM_BINS)[0], rate)
        return Lookup(histogram, (histogram / histogram.max()).reshape(3 * [HISTOGRAM_BINS]))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return skin_distance(k.color_lookup(inside, self.table), k.color_lookup(around, self.table))

    def recognition(self, k: Kernels, seen: WindowSamples, searching: bool = False) -> float:
        return recognition_by_distance(self, k, seen, unrelated=1.0)
