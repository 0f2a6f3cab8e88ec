# SPDX-License-Identifier: MIT
"""What particles are compared by: the six observation models of the color particle tracker, behind one small
Protocol.

An observation sees samples only: ``inside`` (N, 3, n) on the window's grid and ``ring`` (N, 3, m) round it.
"""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.color_params import ColorParticleParams

Samples = NDArray[np.uint8]
Floats = NDArray[np.floating[Any]]

FLAT = 0.1  # a sum of squared deviations of ranks under which a window has no order to speak of


class Observation(Protocol):
    """A model of the target's look and the distance of other windows to it."""

    sharpness: float
    """What suits the exponential likelihood exp(-sharpness d²), by experiment."""

    def learn(self, k: Kernels, inside: Samples, ring: Samples, rate: float) -> None:
        """Blend the look of the first window into the model; rate 1 starts it."""

    def distance(self, k: Kernels, inside: Samples, ring: Samples) -> Floats:
        """(N,) distances in [0, 1]."""

    def recognition(self, k: Kernels, inside: Samples, ring: Samples) -> float:
        """How surely the first window shows the target, in [0, 1]; about 0 for a window that has nothing to
        do with it.
        """


def blend(old: Floats | None, new: Floats, rate: float) -> Floats:
    """The exponential average; ``new`` itself where there is nothing old."""
    return new if old is None or rate >= 1 else old + np.float32(rate) * (new - old)


def likeness(model: Observation, k: Kernels, inside: Samples, ring: Samples, unrelated: float) -> float:
    """1 minus the first window's distance, in units of about the distance of a window that doesn't show the
    target.
    """
    return max(1 - float(model.distance(k, inside[:1], ring[:1])[0]) / unrelated, 0.0)


class RankSpatial:
    """The order of corresponding pixels: what section III.B argues for in words. Keeps the first frame's map
    beside the model.
    """

    sharpness = 110.0

    def __init__(self, p: ColorParticleParams) -> None:
        self.weights = np.array([1 - p.anchor, p.anchor])
        self.maps: Floats = np.empty(0)

    def learn(self, k: Kernels, inside: Samples, ring: Samples, rate: float) -> None:
        ranks = k.color_ranks(inside[:1])
        if rate >= 1:
            self.maps = np.concatenate([ranks, ranks])
        else:
            self.maps[0] += np.float32(rate) * (ranks[0] - self.maps[0])

    def distance(self, k: Kernels, inside: Samples, ring: Samples) -> Floats:
        return k.rank_distance(inside, self.maps) @ self.weights

    def recognition(self, k: Kernels, inside: Samples, ring: Samples) -> float:
        """Spearman's rank correlation with the model; unlike by its distance, a flat window isn't near to it.

        Mid-ranks, and means of them, have a mean of 1/2: a sum of products of deviations is r m - N/4.
        """
        ranks, model = k.color_ranks(inside[:1])[0], self.maps[0]
        cross, own, usual = (float(np.vdot(a, b)) - ranks.size / 4 for a, b in ((ranks, model), (ranks, ranks), (model, model)))
        return max(cross, 0.0) / (own * usual) ** 0.5 if min(own, usual) > FLAT else 0.0


class RankSections:
    """Equations (19)-(29) as printed, each a^k of sum 1: how many levels each quantile spans."""

    sharpness = 60.0
    SECTIONS = 16

    def __init__(self, p: ColorParticleParams) -> None:
        self.sections: Floats | None = None

    def learn(self, k: Kernels, inside: Samples, ring: Samples, rate: float) -> None:
        self.sections = blend(self.sections, k.rank_sections(inside[:1], self.SECTIONS)[0], rate)

    def distance(self, k: Kernels, inside: Samples, ring: Samples) -> Floats:
        return k.section_distance(k.rank_sections(inside, self.SECTIONS), self.sections)

    def recognition(self, k: Kernels, inside: Samples, ring: Samples) -> float:
        return likeness(self, k, inside, ring, unrelated=0.3)


class Histogram:
    """The 16-bin color histogram of figure 2, Bhattacharyya distance."""

    sharpness = 40.0
    BINS = 16

    def __init__(self, p: ColorParticleParams) -> None:
        self.histogram: Floats | None = None

    def learn(self, k: Kernels, inside: Samples, ring: Samples, rate: float) -> None:
        self.histogram = blend(self.histogram, k.color_histogram(inside[:1], self.BINS)[0], rate)

    def distance(self, k: Kernels, inside: Samples, ring: Samples) -> Floats:
        return k.bhattacharyya(k.color_histogram(inside, self.BINS), self.histogram, 3)

    def recognition(self, k: Kernels, inside: Samples, ring: Samples) -> float:
        return likeness(self, k, inside, ring, unrelated=0.6)


def lack(inside: Floats, ring: Floats) -> Floats:
    """(N,) 1 minus how much more skin there is in the window than round it, at least 0, at most 1."""
    more: Floats = inside.mean(axis=1) - ring.mean(axis=1)
    return 1 - np.clip(more, 0, 1)


class Region:
    """Region-based: the explicit RGB rule of Peer et al. 2003. Learns nothing."""

    sharpness = 10.0

    def __init__(self, p: ColorParticleParams) -> None:
        pass

    def learn(self, k: Kernels, inside: Samples, ring: Samples, rate: float) -> None:
        pass

    def distance(self, k: Kernels, inside: Samples, ring: Samples) -> Floats:
        return lack(k.skin_rule(inside), k.skin_rule(ring))

    def recognition(self, k: Kernels, inside: Samples, ring: Samples) -> float:
        return likeness(self, k, inside, ring, unrelated=1.0)


class Gaussian:
    """Parametric: a Gaussian over the target's chrominance (Cb, Cr)."""

    sharpness = 10.0
    FLOOR = 4.0  # levels²; what sensors' noise leaves of a uniform color

    def __init__(self, p: ColorParticleParams) -> None:
        self.mean: Floats | None = None
        self.covariance: Floats | None = None

    def learn(self, k: Kernels, inside: Samples, ring: Samples, rate: float) -> None:
        b, g, r = inside[0].astype(np.float64)
        luma = 0.299 * r + 0.587 * g + 0.114 * b
        chroma = np.stack([(b - luma) * 0.564 + 128, (r - luma) * 0.713 + 128])
        self.mean = blend(self.mean, chroma.mean(axis=1), rate)
        self.covariance = blend(self.covariance, np.cov(chroma, bias=True) + self.FLOOR * np.eye(2), rate)

    def distance(self, k: Kernels, inside: Samples, ring: Samples) -> Floats:
        inverse = np.linalg.inv(self.covariance)
        precision = (inverse + inverse.T) / 2  # rounding leaves the inverse not quite symmetric
        skin, around = (k.skin_gaussian(each, self.mean, precision) for each in (inside, ring))
        return lack(skin, around)

    def recognition(self, k: Kernels, inside: Samples, ring: Samples) -> float:
        return likeness(self, k, inside, ring, unrelated=1.0)


class Lookup:
    """Non-parametric: a look-up table, the target's joint histogram scaled to a maximum of 1."""

    sharpness = 10.0
    BINS = 16

    def __init__(self, p: ColorParticleParams) -> None:
        self.histogram: Floats | None = None
        self.table: Floats = np.empty(0)

    def learn(self, k: Kernels, inside: Samples, ring: Samples, rate: float) -> None:
        self.histogram = blend(self.histogram, k.joint_histogram(inside[:1], self.BINS)[0], rate)
        self.table = (self.histogram / self.histogram.max()).reshape(3 * [self.BINS])

    def distance(self, k: Kernels, inside: Samples, ring: Samples) -> Floats:
        return lack(k.color_lookup(inside, self.table), k.color_lookup(ring, self.table))

    def recognition(self, k: Kernels, inside: Samples, ring: Samples) -> float:
        return likeness(self, k, inside, ring, unrelated=1.0)


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
    model: Observation = MODELS[p.observation](p)
    return model
