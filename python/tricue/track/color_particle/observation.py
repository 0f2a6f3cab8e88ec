# SPDX-License-Identifier: MIT
"""What particles are compared by: the six observation models of the color particle tracker, as one Protocol.

An observation sees samples only: ``inside`` (N, 3, n) on the window's grid and ``around`` (N, 3, m) round it.
"""

import math
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.color_particle.params import ColorParticleParams

Samples = NDArray[np.uint8]
Floats = NDArray[np.float64]
Model = NDArray[np.float32]

UNKNOWN: Model = np.empty(0, np.float32)
SECTIONS = 16  # quantiles of the printed color ranks
BINS = 16  # of each channel's histogram
MIN_VARIANCE = 4.0  # levels²; what a sensor's noise leaves of a uniform color
MIN_RANK_SPREAD = 0.1  # sum of squared deviations of ranks, under which there is no order to speak of


class Observation(Protocol):
    """A model of the target's look and the distance of other windows to it."""

    @property
    def sharpness(self) -> float:
        """What suits the exponential likelihood exp(-sharpness d²), by experiment."""

    def learned(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "Observation":
        """With the look of the first window blended in; a rate of 1 starts the model."""

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        """(N,) distances in [0, 1]; of a lost target to the nearest look that the model remembers."""

    def recognition(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        """How surely the first window shows the target, in [0, 1]; about 0 for any that doesn't."""


def blended(old: NDArray[Any], new: NDArray[Any], rate: float) -> NDArray[Any]:
    """The exponential average."""
    return new if rate >= 1 else old + new.dtype.type(rate) * (new - old)


def likeness(model: Observation, k: Kernels, inside: Samples, around: Samples, unrelated: float) -> float:
    """1 - d / unrelated, at least 0; unrelated: about the distance of windows that don't show the target."""
    return max(1 - float(model.distance(k, inside[:1], around[:1])[0]) / unrelated, 0.0)


def lack(inside: Model, around: Model) -> Floats:
    """(N,) 1 minus how much more skin there is in the window than round it, in [0, 1]."""
    more = inside.mean(axis=1, dtype=np.float64) - around.mean(axis=1, dtype=np.float64)
    less: Floats = 1 - np.clip(more, 0, 1)
    return less


def correlation(a: Model, b: Model) -> float:
    """Of two rank maps, at least 0. Their mean is 1/2, so sum(a b) - N/4 is that of their deviations."""
    a, b = a.ravel(), b.ravel()
    both, own, other = (float(x.dot(y)) - a.size / 4 for x, y in ((a, b), (a, a), (b, b)))
    return min(max(both, 0.0) / math.sqrt(own * other), 1.0) if min(own, other) > MIN_RANK_SPREAD else 0.0


class RankSpatial(NamedTuple):
    """The order of corresponding pixels: what section III.B argues for in words.

    Keeps the first frame's rank map beside the model, so that errors don't add up.
    """

    weights: Floats  # (2,) of the learned map and of the first frame's
    maps: Model = UNKNOWN  # (2, 3, n) both
    sharpness: float = 110.0

    @classmethod
    def of(cls, p: ColorParticleParams) -> "RankSpatial":
        return cls(np.array([1 - p.anchor, p.anchor]))

    def learned(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "RankSpatial":
        ranks = k.color_ranks(inside[:1])
        if rate >= 1:
            return self._replace(maps=np.concatenate([ranks, ranks]))
        maps = self.maps.copy()
        maps[0] += np.float32(rate) * (ranks[0] - maps[0])
        return self._replace(maps=maps)

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return self.chosen(k.rank_distance(inside, self.maps), searching)

    def chosen(self, distances: Floats, searching: bool) -> Floats:
        """(N,) what counts of the distances (N, 2) to both maps."""
        chosen: Floats = distances.min(axis=1) if searching else distances @ self.weights
        return chosen

    def recognition(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        """Spearman's rank correlation: a flat window has none, though its distance is small."""
        ranks = k.color_ranks(inside[:1])[0]
        looks = self.maps if searching else self.maps[:1]
        return max(correlation(ranks, look) for look in looks)


class RankSections(NamedTuple):
    """Equations (19)-(29) as printed, each a^k of sum 1: how many levels each quantile spans."""

    sections: Model = UNKNOWN
    sharpness: float = 400.0

    @classmethod
    def of(cls, p: ColorParticleParams) -> "RankSections":
        return cls()

    def learned(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "RankSections":
        return RankSections(blended(self.sections, k.rank_sections(inside[:1], SECTIONS)[0], rate))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return k.section_distance(k.rank_sections(inside, SECTIONS), self.sections)

    def recognition(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        return likeness(self, k, inside, around, unrelated=0.3)


class Histogram(NamedTuple):
    """The 16-bin color histogram of figure 2, Bhattacharyya distance."""

    histogram: Model = UNKNOWN
    sharpness: float = 300.0

    @classmethod
    def of(cls, p: ColorParticleParams) -> "Histogram":
        return cls()

    def learned(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "Histogram":
        return Histogram(blended(self.histogram, k.color_histogram(inside[:1], BINS)[0], rate))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return k.bhattacharyya(k.color_histogram(inside, BINS), self.histogram, 3)

    def recognition(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        return likeness(self, k, inside, around, unrelated=0.6)


class Region(NamedTuple):
    """Region-based: the explicit RGB rule of Peer et al. 2003. Learns nothing."""

    sharpness: float = 10.0

    @classmethod
    def of(cls, p: ColorParticleParams) -> "Region":
        return cls()

    def learned(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "Region":
        return self

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return lack(k.skin_rule(inside), k.skin_rule(around))

    def recognition(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        return likeness(self, k, inside, around, unrelated=1.0)


class Gaussian(NamedTuple):
    """Parametric: a Gaussian over the target's chrominance (Cb, Cr)."""

    mean: Floats
    covariance: Floats
    sharpness: float = 100.0

    @classmethod
    def of(cls, p: ColorParticleParams) -> "Gaussian":
        return cls(np.zeros(2), np.eye(2))

    def learned(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "Gaussian":
        b, g, r = inside[0].astype(np.float64)
        luma = 0.299 * r + 0.587 * g + 0.114 * b
        chroma = np.stack([(b - luma) * 0.564 + 128, (r - luma) * 0.713 + 128])
        covariance = np.cov(chroma, bias=True) + MIN_VARIANCE * np.eye(2)
        return Gaussian(
            blended(self.mean, chroma.mean(axis=1), rate), blended(self.covariance, covariance, rate)
        )

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        precision = np.linalg.inv(self.covariance)
        precision = (precision + precision.T) / 2  # inv leaves it symmetric but for rounding
        skin, other = (k.skin_gaussian(each, self.mean, precision) for each in (inside, around))
        return lack(skin, other)

    def recognition(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        return likeness(self, k, inside, around, unrelated=1.0)


class Lookup(NamedTuple):
    """Non-parametric: a look-up table, the target's joint histogram scaled to a maximum of 1."""

    histogram: Model = UNKNOWN
    table: Model = UNKNOWN
    sharpness: float = 100.0

    @classmethod
    def of(cls, p: ColorParticleParams) -> "Lookup":
        return cls()

    def learned(self, k: Kernels, inside: Samples, around: Samples, rate: float) -> "Lookup":
        histogram = blended(self.histogram, k.joint_histogram(inside[:1], BINS)[0], rate)
        return Lookup(histogram, (histogram / histogram.max()).reshape(3 * [BINS]))

    def distance(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> Floats:
        return lack(k.color_lookup(inside, self.table), k.color_lookup(around, self.table))

    def recognition(self, k: Kernels, inside: Samples, around: Samples, searching: bool = False) -> float:
        return likeness(self, k, inside, around, unrelated=1.0)


MODELS: dict[str, type[Any]] = {
    "region": Region,
    "gaussian": Gaussian,
    "lookup": Lookup,
    "histogram": Histogram,
    "rank-sections": RankSections,
    "rank-spatial": RankSpatial,
}


def observation(p: ColorParticleParams) -> Observation:
    """A new model of the kind that the parameters name."""
    model: Observation = MODELS[p.observation].of(p)
    return model
