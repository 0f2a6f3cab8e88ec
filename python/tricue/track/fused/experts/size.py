# SPDX-License-Identifier: MIT
"""How large the target is: its spatial ranks at eleven sizes, and where its colors end."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.fused.experts.filter import Filter, mixed
from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Plane, Sight
from tricue.track.fused.view import Target

GRID = 12  # samples a side
COLORED = np.float32(0.5)  # what the posterior counts for beside a channel's ranks
HALF = np.float32(0.5)


class Looks(NamedTuple):
    """What S steps of scale show: ranks (S, 3, n) and the filter's channels (S, 4 n), which are ranks and
    posterior.
    """

    ranks: Plane
    channels: Plane


class SizeExpert(NamedTuple):
    """A correlation filter over scales (Danelljan et al. 2014), on spatial ranks, which light doesn't change
    (Sabeti, Parvizi and Wu 2008).

    model, first, asked: numerator (S // 2 + 1, 4 n) and denominator (S // 2 + 1,), as they are learnt, of the
    first frame, and of both, which answer.
    """

    model: Filter
    first: Filter
    asked: Filter
    label: NDArray[np.complex64]
    params: FusedParams

    @classmethod
    def start(cls, k: Kernels, looks: Looks, p: FusedParams) -> "SizeExpert":
        """Learnt from the first frame."""
        channels = looks.channels.shape[1]
        offset = np.fft.fftfreq(p.scales, 1 / p.scales)
        label = np.fft.rfft(np.exp(-0.5 * (offset / p.scale_label) ** 2)).astype(np.complex64)
        none = np.zeros((len(label), channels), np.complex64), np.zeros(len(label), np.float32)
        first = k.scale_train(looks.channels, label, *none, 1.0)
        return cls(first, first, first, label, p)

    def evidence(self, k: Kernels, looks: Looks) -> Plane:
        """(S,), about 1 at the right one."""
        return k.scale_response(looks.channels, *self.asked, self.params.ridge)

    def learnt(self, k: Kernels, looks: Looks, rate: float) -> "SizeExpert":
        """With the looks, the middle one right, blended in."""
        now = k.scale_train(looks.channels, self.label, *self.model, rate)
        asked = mixed(now, self.first, self.params.scale_anchor)
        return SizeExpert(now, self.first, asked, self.label, self.params)


class _Steps(NamedTuple):
    """Of S steps of scale: factors of the size, 1 in the middle, and of the area; windows (S, 4) of a target
    of width and height 1 at (0, 0); the prior.
    """

    factors: NDArray[np.float64]
    areas: NDArray[np.float64]
    windows: NDArray[np.float64]
    prior: NDArray[np.float64]


@lru_cache(maxsize=8)
def _steps(count: int, step: float, reach: float, prior: float) -> _Steps:
    offset = np.arange(count) - count // 2.0
    factors: NDArray[np.float64] = np.power(step, offset)
    sides = reach * factors
    windows = np.stack([-sides / 2, -sides / 2, sides, sides], axis=1)
    return _Steps(factors, factors * factors, windows, -prior * offset * offset)


def steps(p: FusedParams) -> _Steps:
    """The steps of scale of some parameters."""
    return _steps(p.scales, p.scale_step, p.scale_reach, p.scale_prior)


def looks(sight: Sight, target: Target, table: Plane, p: FusedParams) -> Looks:
    """A target's place at every step of scale; table: (16, 16, 16) P(target | color)."""
    k, sizes = sight.k, (target.width, target.height)
    windows = steps(p).windows * (*sizes, *sizes)
    windows += (target.x, target.y, 0, 0)
    samples = k.sample_windows(sight.picture, windows, GRID, GRID)
    flat = np.ascontiguousarray(samples.reshape(p.scales, -1, 3).transpose(0, 2, 1))
    ranks = k.color_ranks(flat)
    channels = np.empty((p.scales, 4 * GRID * GRID), np.float32)
    np.subtract(ranks.reshape(p.scales, -1), HALF, out=channels[:, : 3 * GRID * GRID])
    colored = np.subtract(k.color_lookup(flat, table), HALF, out=channels[:, 3 * GRID * GRID :])
    colored *= COLORED
    return Looks(ranks, channels)


def edges(
    k: Kernels,
    posterior: Plane,
    middle: tuple[float, float],
    size: tuple[float, float],
    p: FusedParams,
    level: float,
) -> NDArray[np.float64]:
    """(S,) what the posterior adds up to above a level in boxes of every scale, of the first's area."""
    factors, areas, _, _ = steps(p)
    means = k.box_means(posterior, *middle, size[0] * factors, size[1] * factors)
    sums: NDArray[np.float64] = (means - level) * areas
    return sums


def edge_level(k: Kernels, posterior: Plane, size: tuple[float, float], step: float) -> float:
    """The posterior along the target's edge, where boxes of both sizes next to it differ."""
    factors = np.array([1 / step, step])
    rows, columns = posterior.shape
    inner, outer = k.box_means(posterior, columns / 2, rows / 2, size[0] * factors, size[1] * factors)
    return float((outer * step**2 - inner / step**2) / (step**2 - step**-2))
