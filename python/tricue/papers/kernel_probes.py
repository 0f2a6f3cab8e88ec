# SPDX-License-Identifier: MIT
"""Kernels with timing and with noise added to disparities, for running a tracker on them."""

from collections import defaultdict
from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.kernels import Kernels
from tricue.track.base.track import Track
from tricue.track.base.tracker import TrackerBase

KERNEL_MODULES = {
    "image_mean": "search",
    "head_cells": "search",
    "best_ellipse": "search",
    "color_bins": "search",
    "ellipse_search": "search",
    "learn_histogram": "search",
    "histogram_mean": "search",
    "shift_histogram": "search",
    "reduce_gray": "disparity",
    "sad_disparity": "disparity",
    "ellipse_disparity": "disparity",
    "back_project": "filter",
    "kalman_predict": "filter",
    "kalman_update": "filter",
}
"""The module of each kernel of the stereo head tracker, Moreno et al. 2002, figures 1 and 3(d)."""


class ProbedKernels:
    """A set of kernels with the same results that sums the time per module and may add noise.

    noise: standard deviation, pixels, of the noise added to each back-projected disparity. The stereo head
    tracker back-projects one disparity per frame, the one measured in the ellipse. Its search for the head
    and its gates see that disparity without the noise, and its filter doesn't know of the noise.
    """

    def __init__(self, kernels: Kernels, noise: float = 0.0, seed: int = 0) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self._kernels, self._noise, self._rng = kernels, noise, np.random.default_rng(seed)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        kernel: Callable[..., Any] = getattr(self._kernels, name)
        module = KERNEL_MODULES[name]

        def timed(*arguments: Any, **keywords: Any) -> Any:
            start = perf_counter()
            try:
                return kernel(*arguments, **keywords)
            finally:
                self.seconds[module] += perf_counter() - start

        setattr(self, name, timed)  # so that it is created only once
        return timed

    def back_project(self, pixels: NDArray[np.float64], *others: Any) -> Any:
        """Like the kernel, with noise added to the disparities, the last column of pixels (N, 3)."""
        perturbed = pixels + self._rng.normal(0, 1, pixels.shape) * [0.0, 0.0, self._noise]
        start = perf_counter()
        try:
            return self._kernels.back_project(perturbed, *others)
        finally:
            self.seconds[KERNEL_MODULES["back_project"]] += perf_counter() - start


class ProbedTracker:
    """A tracker on probed kernels; one without kernels, such as a baseline, runs unchanged, without times."""

    def __init__(self, tracker: Any, noise: float = 0.0, seed: int = 0) -> None:
        self._tracker = tracker
        self._kernels: ProbedKernels | None = None
        if isinstance(tracker, TrackerBase):
            self._kernels = tracker._k = ProbedKernels(tracker._k, noise, seed)

    def init(self, frame: Frame, box: Box) -> Track:
        track: Track = self._tracker.init(frame, box)
        self._updates: list[dict[str, float]] = []
        return track

    def update(self, frame: Frame) -> Track:
        if self._kernels is not None:
            self._kernels.seconds.clear()
        track: Track = self._tracker.update(frame)
        self._updates.append({} if self._kernels is None else dict(self._kernels.seconds))
        return track

    def seconds(self, updates: NDArray[np.float64]) -> dict[str, float]:
        """Seconds per update in each module, and outside them as "rest": medians over the updates since init.
        updates: (M - 1,) seconds of the whole updates.
        """
        names = sorted(set().union(*self._updates))
        spent = np.array([[each.get(name, 0.0) for name in names] for each in self._updates])
        rest = updates - spent.sum(axis=1)
        return dict(zip([*names, "rest"], np.median(np.c_[spent, rest], axis=0).tolist(), strict=True))
