# SPDX-License-Identifier: MIT
"""The target's size: its spatial ranks at eleven scales, and the edges of its posterior."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.fused.arrays import Floats, Plane
from tricue.track.fused.experts.correlation_filter import Filter, blend_filters
from tricue.track.fused.params import FusedParams
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation

SCALE_SAMPLES = 12  # on a side of the target's part
POSTERIOR_WEIGHT = np.float32(0.5)  # of the posterior beside a channel's ranks
CHANNEL_MEAN = np.float32(0.5)  # of ranks and posterior, subtracted


class ScaleSamples(NamedTuple):
    """A target's place sampled at S scales.

    ranks: (S, 3, n) of n samples. channels: (S, 4 n) that the filter reads, ranks and posterior.
    """

    ranks: Plane
    channels: Plane


class SizeExpert(NamedTuple):
    """A correlation filter over scales (Danelljan et al. 2014).

    It reads spatial ranks, which monotonic changes of light don't change (Sabeti, Parvizi and Wu 2008).
    learned, first, applied: numerator (S // 2 + 1, 4 n) and denominator (S // 2 + 1,), as they are learned,
    of the first frame, and a blend of both. label: spectrum of the desired response.
    """

    learned: Filter
    first: Filter
    applied: Filter
    label: NDArray[np.complex64]
    params: FusedParams

    @classmethod
    def from_samples(cls, k: Kernels, samples: ScaleSamples, p: FusedParams) -> "SizeExpert":
        """Learned from the first frame."""
        channels = samples.channels.shape[1]
        offset = np.fft.fftfreq(p.scales, 1 / p.scales)
        label = np.fft.rfft(np.exp(-0.5 * (offset / p.scale_label_width) ** 2)).astype(np.complex64)
        empty = np.zeros((len(label), channels), np.complex64), np.zeros(len(label), np.float32)
        first = k.scale_train(samples.channels, label, *empty, 1.0)
        return cls(first, first, first, label, p)

    def response(self, k: Kernels, samples: ScaleSamples) -> Plane:
        """(S,), about 1 at the target's scale."""
        return k.scale_response(samples.channels, *self.applied, self.params.ridge)

    def learn(self, k: Kernels, samples: ScaleSamples, rate: float) -> "SizeExpert":
        """The expert with samples blended in, of which the middle scale is the target's."""
        learned = k.scale_train(samples.channels, self.label, *self.learned, rate)
        applied = blend_filters(learned, self.first, self.params.scale_first_frame_weight)
        return SizeExpert(learned, self.first, applied, self.label, self.params)


class ScaleSteps(NamedTuple):
    """S steps of scale, the middle one with factor 1.

    factors: of the sides. areas: factors of the area. windows: (S, 4) sampled parts of a target of width and
    height 1 at (0, 0). prior: evidence against another size than predicted.
    """

    factors: Floats
    areas: Floats
    windows: Floats
    prior: Floats


@lru_cache(maxsize=8)
def _scale_steps(count: int, step: float, window: float, prior: float) -> ScaleSteps:
    offset = np.arange(count) - count // 2.0
    factors: Floats = np.power(step, offset)
    sides = window * factors
    windows = np.stack([-sides / 2, -sides / 2, sides, sides], axis=1)
    return ScaleSteps(factors, factors * factors, windows, -prior * offset * offset)


def scale_steps(p: FusedParams) -> ScaleSteps:
    """The steps of scale of some parameters."""
    return _scale_steps(p.scales, p.scale_step, p.scale_window, p.scale_prior)


def sample_scales(
    observation: TargetObservation, target: Target, table: Plane, p: FusedParams
) -> ScaleSamples:
    """Sample a target's place at every scale; table: (16, 16, 16) P(target | color)."""
    k, size = observation.k, (target.width, target.height)
    windows = scale_steps(p).windows * (*size, *size)
    windows += (target.x, target.y, 0, 0)
    samples = k.sample_windows(observation.picture, windows, SCALE_SAMPLES, SCALE_SAMPLES)
    flat = np.ascontiguousarray(samples.reshape(p.scales, -1, 3).transpose(0, 2, 1))
    ranks = k.color_ranks(flat)
    count = 3 * SCALE_SAMPLES * SCALE_SAMPLES
    channels = np.empty((p.scales, 4 * SCALE_SAMPLES * SCALE_SAMPLES), np.float32)
    np.subtract(ranks.reshape(p.scales, -1), CHANNEL_MEAN, out=channels[:, :count])
    posterior = np.subtract(k.color_lookup(flat, table), CHANNEL_MEAN, out=channels[:, count:])
    posterior *= POSTERIOR_WEIGHT
    return ScaleSamples(ranks, channels)


def edge_evidence(
    k: Kernels,
    posterior: Plane,
    center: tuple[float, float],
    size: tuple[float, float],
    p: FusedParams,
    level: float,
) -> Floats:
    """(S,) sums of the posterior less a level in the boxes of every scale, in areas of the middle box.

    It is largest where the box ends at the posterior's edge. center, size: pixels of the posterior.
    """
    factors, areas, _, _ = scale_steps(p)
    means = k.box_means(posterior, *center, size[0] * factors, size[1] * factors)
    sums: Floats = (means - level) * areas
    return sums


def edge_level(k: Kernels, posterior: Plane, size: tuple[float, float], step: float) -> float:
    """The posterior's mean along the target's edge: between the boxes one step smaller and larger."""
    factors = np.array([1 / step, step])
    rows, columns = posterior.shape
    inner, outer = k.box_means(posterior, columns / 2, rows / 2, size[0] * factors, size[1] * factors)
    return float((outer * step**2 - inner / step**2) / (step**2 - step**-2))
