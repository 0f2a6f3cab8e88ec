# SPDX-License-Identifier: MIT
"""How large the target is: its spatial ranks at eleven sizes, and where its colors end."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.fused.params import FusedParams
from tricue.track.fused.view import Image, Plane, Target

GRID = 12  # samples a side
COLORED = 0.5  # what the posterior counts for beside a channel's ranks


class Looks(NamedTuple):
    """What S steps of scale show: ranks (S, 3, n) and posterior (S, n) of the samples."""

    ranks: Plane
    posterior: Plane

    @property
    def channels(self) -> Plane:
        """(S, 4 n), the filter's."""
        flat = self.ranks.reshape(len(self.ranks), -1) - np.float32(0.5)
        return np.concatenate([flat, np.float32(COLORED) * (self.posterior - np.float32(0.5))], axis=1)


class ScaleExpert(NamedTuple):
    """A correlation filter over scales."""

    numerator: NDArray[np.complex64]
    denominator: NDArray[np.float32]
    label: NDArray[np.complex64]
    params: FusedParams

    @classmethod
    def start(cls, k: Kernels, looks: Looks, p: FusedParams) -> "ScaleExpert":
        """Learnt from the first frame."""
        channels = looks.channels.shape[1]
        offset = np.fft.fftfreq(p.scales, 1 / p.scales)
        label = np.fft.rfft(np.exp(-0.5 * (offset / p.scale_label) ** 2)).astype(np.complex64)
        none = np.zeros((len(label), channels), np.complex64)
        return cls(none, np.zeros(len(label), np.float32), label, p).learnt(k, looks, 1.0)

    def evidence(self, k: Kernels, looks: Looks) -> Plane:
        """(S,), about 1 at the right one."""
        return k.scale_response(looks.channels, self.numerator, self.denominator, self.params.ridge)

    def learnt(self, k: Kernels, looks: Looks, rate: float) -> "ScaleExpert":
        """With the looks, the middle one right, blended in."""
        learnt = k.scale_train(looks.channels, self.label, self.numerator, self.denominator, rate)
        return self._replace(numerator=learnt[0], denominator=learnt[1])


def factors(p: FusedParams) -> NDArray[np.float64]:
    """(S,) of the size, 1 in the middle."""
    steps: NDArray[np.float64] = np.power(p.scale_step, np.arange(p.scales) - p.scales // 2.0)
    return steps


def looks(
    k: Kernels, image: Image, target: Target, table: Plane, p: FusedParams, steps: NDArray[np.float64]
) -> Looks:
    """A target's place at every step of scale."""
    sizes = p.scale_reach * np.outer(steps, [target.width, target.height])
    windows = np.column_stack([np.array([target.x, target.y]) - sizes / 2, sizes])
    samples = k.sample_windows(image, windows, GRID, GRID)
    flat = np.ascontiguousarray(samples.reshape(len(samples), -1, 3).transpose(0, 2, 1))
    return Looks(k.color_ranks(flat), k.color_lookup(flat, table))


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
