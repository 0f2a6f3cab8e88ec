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


def factors(p: FusedParams) -> NDArray[np.float64]:
    """(S,) of the size, 1 in the middle."""
    return _powers(p.scale_step, p.scales)


@lru_cache(maxsize=8)
def _powers(step: float, count: int) -> NDArray[np.float64]:
    powers: NDArray[np.float64] = np.power(step, np.arange(count) - count // 2.0)
    return powers


def looks(sight: Sight, target: Target, table: Plane, p: FusedParams) -> Looks:
    """A target's place at every step of scale; table: (16, 16, 16) P(target | color)."""
    k, steps = sight.k, factors(p)
    windows = np.empty((len(steps), 4))
    windows[:, 2] = p.scale_reach * target.width * steps
    windows[:, 3] = p.scale_reach * target.height * steps
    windows[:, :2] = (target.x, target.y) - windows[:, 2:] / 2
    samples = k.sample_windows(sight.picture, windows, GRID, GRID)
    flat = np.ascontiguousarray(samples.reshape(len(samples), -1, 3).transpose(0, 2, 1))
    ranks = k.color_ranks(flat)
    colored = COLORED * (k.color_lookup(flat, table) - HALF)
    return Looks(ranks, np.concatenate([ranks.reshape(len(ranks), -1) - HALF, colored], axis=1))


def edges(
    k: Kernels, posterior: Plane, size: tuple[float, float], steps: NDArray[np.float64], level: float
) -> NDArray[np.float64]:
    """(S,) what the posterior adds up to above a level in boxes of every scale, of the first's area."""
    means = k.box_means(posterior, size[0] * steps, size[1] * steps)
    sums: NDArray[np.float64] = (means - level) * steps * steps
    return sums


def edge_level(k: Kernels, posterior: Plane, size: tuple[float, float], step: float) -> float:
    """The posterior along the target's edge, where boxes of both sizes next to it differ."""
    steps = np.array([1 / step, step])
    sums = edges(k, posterior, size, steps, 0.0)
    return float((sums[1] - sums[0]) / (steps[1] ** 2 - steps[0] ** 2))
